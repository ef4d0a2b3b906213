// MeshLab 2020.09's calls handed to LiveView.
#include "meshlab_plugin/api_2020_09/render_shrelight.h"

QList<QAction*> RenderShRelight::actions() {
  if (actions_.isEmpty()) actions_ << new QAction(QStringLiteral("SH Relight"), this);
  return actions_;
}

void RenderShRelight::Init(QAction*, MeshDocument&, RenderingData&, GLArea*) {
  view_ = std::make_unique<shbake::meshlab::LiveView>();
}

void RenderShRelight::Render(QAction*, MeshDocument& document, RenderingData&, GLArea*) {
  if (view_) view_->render(document);
}

void RenderShRelight::Finalize(QAction*, MeshDocument*, GLArea*) {
  if (!view_) return;
  view_->release();
  view_.reset();
}

MESHLAB_PLUGIN_NAME_EXPORTER(RenderShRelight)
