// The filter and format plugin for MeshLab 2021.05 and later.
#pragma once

#include <QObject>

#include "meshlab_plugin/api.h"
#include "meshlab_plugin/filters.h"

/// Its methods are MeshLab's; what they do is shbake::meshlab::Filters.
class FilterShbake : public QObject, public FilterPlugin, public IOPlugin {
  Q_OBJECT
  MESHLAB_PLUGIN_IID_EXPORTER(FILTER_PLUGIN_IID)
  Q_INTERFACES(FilterPlugin IOPlugin)

 public:
  FilterShbake();

  QString pluginName() const override { return QStringLiteral("shbake"); }
  QString vendor() const override { return QStringLiteral("shbake"); }
  QString filterName(ActionIDType id) const override;
  QString pythonFilterName(ActionIDType id) const override;
  QString filterInfo(ActionIDType id) const override;
  FilterClass getClass(const QAction* action) const override;
  FilterArity filterArity(const QAction*) const override { return SINGLE_MESH; }
  int postCondition(const QAction* action) const override;
  RichParameterList initParameterList(const QAction* action, const MeshDocument& document) override;
  std::map<std::string, QVariant> applyFilter(const QAction* action, const RichParameterList& parameters,
                                              MeshDocument& document, unsigned int& postConditions,
                                              vcg::CallBackPos* callback) override;

  std::list<FileFormat> importFormats() const override;
  std::list<FileFormat> exportFormats() const override;
  void exportMaskCapability(const QString& format, int& capability, int& defaults) const override;
#if SHBAKE_MESHLAB_API >= 202107
  RichParameterList initSaveParameter(const QString& format, const MeshModel& layer) const override;
#else
  void initSaveParameter(const QString& format, const MeshModel& layer, RichParameterList& parameters) override;
#endif
  void open(const QString& format, const QString& path, MeshModel& layer, int& mask,
            const RichParameterList& parameters, vcg::CallBackPos* callback) override;
  void save(const QString& format, const QString& path, MeshModel& layer, int mask, const RichParameterList& parameters,
            vcg::CallBackPos* callback) override;

 private:
  shbake::meshlab::Filters filters_;
};
