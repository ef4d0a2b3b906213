// Calls of MeshLab 2021.05 and later handed to LiveView.
#include "meshlab_plugin/api_2021_05/render_shrelight.h"

QList<QAction*> RenderShRelight::actions() {
  if (actions_.isEmpty()) actions_ << new QAction(QStringLiteral("SH Relight"), this);
  return actions_;
}

void RenderShRelight::init(QAction*, MeshDocument&, RenderingData&, GLArea*) {
  view_ = std::make_unique<shbake::meshlab::LiveView>();
}

void RenderShRelight::render(QAction*, MeshDocument& document, RenderingData&, GLArea*) {
  if (view_) view_->render(document);
}

void RenderShRelight::finalize(QAction*, MeshDocument*, GLArea*) {
  if (!view_) return;
  view_->release();
  view_.reset();
}

MESHLAB_PLUGIN_NAME_EXPORTER(RenderShRelight)
