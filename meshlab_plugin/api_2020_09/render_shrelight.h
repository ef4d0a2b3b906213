// The plugin for live relighting in the viewer of MeshLab 2020.09.
#pragma once

#include <QObject>
#include <memory>

#include "meshlab_plugin/api.h"
#include "meshlab_plugin/live_view.h"

/// Its methods are MeshLab's; what they do is shbake::meshlab::LiveView.
class RenderShRelight : public QObject, public MeshRenderInterface {
  Q_OBJECT
  MESHLAB_PLUGIN_IID_EXPORTER(MESH_RENDER_INTERFACE_IID)
  Q_INTERFACES(MeshRenderInterface)

 public:
  using RenderingData = MLSceneGLSharedDataContext::PerMeshRenderingDataMap;

  QString pluginName() const override { return QStringLiteral("shbake live view"); }
  QList<QAction*> actions() override;
  bool isSupported() override { return true; }
  void Init(QAction*, MeshDocument&, RenderingData&, GLArea*) override;
  void Render(QAction*, MeshDocument& document, RenderingData&, GLArea*) override;
  void Finalize(QAction*, MeshDocument*, GLArea*) override;

 private:
  QList<QAction*> actions_;
  std::unique_ptr<shbake::meshlab::LiveView> view_;
};
