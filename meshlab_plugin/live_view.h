// Live relighting in MeshLab's viewer, whatever release of MeshLab calls it.
#pragma once

#include <QObject>
#include <QPoint>
#include <QPointer>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "meshlab_plugin/bridge.h"
#include "meshlab_plugin/light_choice.h"
#include "meshlab_plugin/live_drawing.h"

class MeshDocument;

namespace shbake::meshlab {

class LightPanel;

/// One view: its controls, and for each layer what is drawn. Radiance is computed on the processor and only when the
/// light or the layer has changed: turning the camera costs nothing, and the number of coefficients is not limited by
/// what a graphics card takes as attributes.
class LiveView : public QObject {
 public:
  LiveView();
  ~LiveView() override;

  /// Draws the visible layers with OpenGL's current view; the context must be that of all earlier calls.
  void render(MeshDocument& document);
  /// Gives back what the graphics card holds. The context must be current.
  void release();

  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Layer;

  void showPanel();
  void update();
  Layer& layerOf(MeshModel& model);
  void light(Layer& layer);
  void adjustExposure();

  QPointer<LightPanel> panel_;
  std::unique_ptr<LiveProgram> program_;
  std::map<int, std::unique_ptr<Layer>> layers_;  // by MeshModel::id()
  LightMaker lights_;
  std::optional<QPoint> dragged_;  // where the mouse was when it last turned the light
  unsigned turn_ = 1;              // counts changes of the light
  double exposure_ = 0;
  std::string exposed_;  // the light, turned away, for which exposure_ was found
  std::string told_;
};

}  // namespace shbake::meshlab
