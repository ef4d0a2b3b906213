// MeshLab 2020.09's calls handed to Filters. No exception leaves: this release would end.
#include "meshlab_plugin/api_2020_09/filter_shbake.h"

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

/// Calls `work`; nothing, or why it failed.
template <class Work>
std::string failureOf(Work&& work) {
  try {
    work();
    return {};
  } catch (const std::exception& failure) {
    return describeFailure(failure);
  }
}

}  // namespace

FilterShbake::FilterShbake() {
  for (std::size_t id = 0; id < filterTexts().size(); ++id) {
    typeList << static_cast<int>(id);
    actionList << new QAction(filterName(static_cast<int>(id)), this);
  }
}

QString FilterShbake::filterName(FilterIDType id) const {
  return filterTexts().at(static_cast<std::size_t>(id)).name;
}

QString FilterShbake::filterInfo(FilterIDType id) const {
  return filterTexts().at(static_cast<std::size_t>(id)).help;
}

MeshFilterInterface::FilterClass FilterShbake::getClass(QAction* action) {
  return filterOf(ID(action)) == Filter::refine ? MeshFilterInterface::Remeshing : MeshFilterInterface::Quality;
}

int FilterShbake::postCondition(QAction* action) const {
  return changesOf(filterOf(ID(action)));
}

void FilterShbake::initParameterSet(QAction* action, MeshDocument& document, RichParameterList& parameters) {
  declareParameters(filterOf(ID(action)), document.mm(), parameters);
}

bool FilterShbake::applyFilter(QAction* action, MeshDocument& document, const RichParameterList& parameters,
                               vcg::CallBackPos* callback) {
  const Filter filter = filterOf(ID(action));
  const std::string failure = failureOf([&] {
    std::vector<std::string> lines;
    if (filter == Filter::relight) {
      lines = filters_.apply(filter, document, parameters, goOn);
    } else {
      ProgressWindow window(action->text());
      lines = filters_.apply(filter, document, parameters, watchWith(window, callback));
    }
    for (const std::string& line : lines) MeshFilterInterface::Log(line);
  });
  // The message is for the window; meshlabserver prints nothing but the log.
  MeshFilterInterface::errorMessage = QString::fromStdString(failure).toHtmlEscaped();
  if (!failure.empty()) MeshFilterInterface::Log(failure);
  return failure.empty();
}

QList<MeshIOInterface::Format> FilterShbake::importFormats() const {
  return {Format(kFormatDescription, kFormatExtension)};
}

QList<MeshIOInterface::Format> FilterShbake::exportFormats() const {
  return importFormats();
}

void FilterShbake::GetExportMaskCapability(QString&, int& capability, int& defaults) const {
  capability = defaults = kFormatMask;
}

void FilterShbake::initSaveParameter(const QString&, MeshModel&, RichParameterList& parameters) {
  declareFormat(parameters);
}

bool FilterShbake::open(const QString&, const QString& path, MeshModel& layer, int& mask, const RichParameterList&,
                        vcg::CallBackPos* callback, QWidget*) {
  const std::string failure = failureOf([&] {
    ProgressWindow window(QStringLiteral("Opening a baked mesh"));
    mask = filters_.load(wholePath(path), layer, watchWith(window, callback));
  });
  return reported(failure);
}

bool FilterShbake::save(const QString&, const QString& path, MeshModel& layer, const int,
                        const RichParameterList& parameters, vcg::CallBackPos* callback, QWidget*) {
  const std::string failure = failureOf([&] {
    ProgressWindow window(QStringLiteral("Saving a baked mesh"));
    filters_.save(wholePath(path), layer, formatIsAscii(parameters), watchWith(window, callback));
  });
  return reported(failure);
}

bool FilterShbake::reported(const std::string& failure) {
  MeshIOInterface::errorMessage = QString::fromStdString(failure).toHtmlEscaped();
  if (failure.empty()) return true;
  // The window shows the message; meshlabserver prints neither it nor the log of a file.
  qWarning("%s", failure.c_str());
  return false;
}

MESHLAB_PLUGIN_NAME_EXPORTER(FilterShbake)
