// The filter and format plugin for MeshLab 2020.09.
#pragma once

#include <QObject>

#include "meshlab_plugin/api.h"
#include "meshlab_plugin/filters.h"

/// Its methods are MeshLab's; what they do is shbake::meshlab::Filters.
class FilterShbake : public QObject, public MeshFilterInterface, public MeshIOInterface {
  Q_OBJECT
  MESHLAB_PLUGIN_IID_EXPORTER(MESH_FILTER_INTERFACE_IID)
  Q_INTERFACES(MeshFilterInterface MeshIOInterface)

 public:
  using FilterIDType = MeshFilterInterface::FilterIDType;

  FilterShbake();

  QString pluginName() const override { return QStringLiteral("shbake"); }
  QString filterName(FilterIDType id) const override;
  QString filterInfo(FilterIDType id) const override;
  FilterClass getClass(QAction* action) override;
  FILTER_ARITY filterArity(QAction*) const override { return SINGLE_MESH; }
  int postCondition(QAction* action) const override;
  void initParameterSet(QAction* action, MeshDocument& document, RichParameterList& parameters) override;
  bool applyFilter(QAction* action, MeshDocument& document, const RichParameterList& parameters,
                   vcg::CallBackPos* callback) override;

  QList<Format> importFormats() const override;
  QList<Format> exportFormats() const override;
  void GetExportMaskCapability(QString& format, int& capability, int& defaults) const override;
  void initSaveParameter(const QString& format, MeshModel& layer, RichParameterList& parameters) override;
  bool open(const QString& format, const QString& path, MeshModel& layer, int& mask, const RichParameterList&,
            vcg::CallBackPos* callback, QWidget*) override;
  bool save(const QString& format, const QString& path, MeshModel& layer, int mask, const RichParameterList& parameters,
            vcg::CallBackPos* callback, QWidget*) override;

 private:
  /// Hands on why a file could not be read or written; true where there is nothing to tell.
  bool reported(const std::string& failure);

  shbake::meshlab::Filters filters_;
};
