// Calls of MeshLab 2021.05 and later handed to Filters. Failures leave as MLException, which it shows as a message.
#include "meshlab_plugin/api_2021_05/filter_shbake.h"

#include <common/mlexception.h>

#include <QFileInfo>

#include "meshlab_plugin/parameters.h"
#include "meshlab_plugin/progress_window.h"

namespace {

using namespace shbake::meshlab;

Filter filterOf(int id) {
  return filterTexts().at(static_cast<std::size_t>(id)).filter;
}

/// MeshLab goes to the folder of a file before it asks a plugin to read it, and leaves again.
std::string wholePath(const QString& path) {
  return QFileInfo(path).absoluteFilePath().toStdString();
}

/// Shows progress in a window of its own and in MeshLab's status bar.
Watch watchWith(ProgressWindow& window, vcg::CallBackPos* callback) {
  return [&window, callback](int percent, const std::string& text) {
    if (callback != nullptr) callback(percent, text.c_str());
    return window.show(percent, text);
  };
}

/// Relighting takes a moment, and its sliders must not be moved within it: nothing is shown, no click handled.
bool goOn(int, const std::string&) {
  return true;
}

template <class Work>
auto withMessages(Work&& work) {
  try {
    return work();
  } catch (const std::exception& failure) {
    throw MLException(QString::fromStdString(describeFailure(failure)));
  }
}

}  // namespace

FilterShbake::FilterShbake() {
  for (std::size_t id = 0; id < filterTexts().size(); ++id) {
    typeList.push_back(static_cast<int>(id));
    actionList.push_back(new QAction(filterName(static_cast<int>(id)), this));
  }
}

QString FilterShbake::filterName(ActionIDType id) const {
  return filterTexts().at(static_cast<std::size_t>(id)).name;
}

QString FilterShbake::pythonFilterName(ActionIDType id) const {
  return filterTexts().at(static_cast<std::size_t>(id)).pythonName;
}

QString FilterShbake::filterInfo(ActionIDType id) const {
  return filterTexts().at(static_cast<std::size_t>(id)).help;
}

FilterPlugin::FilterClass FilterShbake::getClass(const QAction* action) const {
  return filterOf(ID(action)) == Filter::refine ? FilterPlugin::Remeshing : FilterPlugin::Quality;
}

int FilterShbake::postCondition(const QAction* action) const {
  return changesOf(filterOf(ID(action)));
}

RichParameterList FilterShbake::initParameterList(const QAction* action, const MeshDocument& document) {
  RichParameterList parameters;
  declareParameters(filterOf(ID(action)), document.mm(), parameters);
  return parameters;
}

std::map<std::string, QVariant> FilterShbake::applyFilter(const QAction* action, const RichParameterList& parameters,
                                                          MeshDocument& document, unsigned int&,
                                                          vcg::CallBackPos* callback) {
  const Filter filter = filterOf(ID(action));
  const std::vector<std::string> lines = withMessages([&] {
    if (filter == Filter::relight) return filters_.apply(filter, document, parameters, goOn);
    ProgressWindow window(action->text());
    return filters_.apply(filter, document, parameters, watchWith(window, callback));
  });
  for (const std::string& line : lines) log(line);
  return {};
}

std::list<FileFormat> FilterShbake::importFormats() const {
  return {FileFormat(kFormatDescription, QString(kFormatExtension))};
}

std::list<FileFormat> FilterShbake::exportFormats() const {
  return importFormats();
}

void FilterShbake::exportMaskCapability(const QString&, int& capability, int& defaults) const {
  capability = defaults = kFormatMask;
}

#if SHBAKE_MESHLAB_API >= 202107
RichParameterList FilterShbake::initSaveParameter(const QString&, const MeshModel&) const {
  RichParameterList parameters;
  declareFormat(parameters);
  return parameters;
}
#else
void FilterShbake::initSaveParameter(const QString&, const MeshModel&, RichParameterList& parameters) {
  declareFormat(parameters);
}
#endif

void FilterShbake::open(const QString&, const QString& path, MeshModel& layer, int& mask, const RichParameterList&,
                        vcg::CallBackPos* callback) {
  mask = withMessages([&] {
    ProgressWindow window(QStringLiteral("Opening a baked mesh"));
    return filters_.load(wholePath(path), layer, watchWith(window, callback));
  });
}

void FilterShbake::save(const QString&, const QString& path, MeshModel& layer, const int,
                        const RichParameterList& parameters, vcg::CallBackPos* callback) {
  withMessages([&] {
    ProgressWindow window(QStringLiteral("Saving a baked mesh"));
    filters_.save(wholePath(path), layer, formatIsAscii(parameters), watchWith(window, callback));
  });
}

MESHLAB_PLUGIN_NAME_EXPORTER(FilterShbake)
