// The plugin for live relighting in the viewer of MeshLab 2021.05 and later.
#pragma once

#include <common/plugins/interfaces/render_plugin.h>

#include <QObject>
#include <memory>

#include "meshlab_plugin/api.h"
#include "meshlab_plugin/live_view.h"

/// Its methods are MeshLab's; what they do is shbake::meshlab::LiveView.
class RenderShRelight : public QObject, public RenderPlugin {
  Q_OBJECT
  MESHLAB_PLUGIN_IID_EXPORTER(RENDER_PLUGIN_IID)
  Q_INTERFACES(RenderPlugin)

 public:
  using RenderingData = MLSceneGLSharedDataContext::PerMeshRenderingDataMap;

  QString pluginName() const override { return QStringLiteral("shbake live view"); }
  QString vendor() const override { return QStringLiteral("shbake"); }
  QList<QAction*> actions() override;
  bool isSupported() override { return true; }
  void init(QAction*, MeshDocument&, RenderingData&, GLArea*) override;
  void render(QAction*, MeshDocument& document, RenderingData&, GLArea*) override;
  void finalize(QAction*, MeshDocument*, GLArea*) override;

 private:
  QList<QAction*> actions_;
  std::unique_ptr<shbake::meshlab::LiveView> view_;
};
