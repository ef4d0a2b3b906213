// Layers of the live view kept up to date with the document, and the light with its controls.
#include "meshlab_plugin/live_view.h"

#include <QApplication>
#include <QMainWindow>
#include <QMouseEvent>
#include <algorithm>
#include <cstring>
#include <exception>
#include <utility>

#include "meshlab_plugin/api.h"
#include "meshlab_plugin/filters.h"
#include "meshlab_plugin/light_panel.h"

namespace shbake::meshlab {
namespace {

/// Albedo with which layers are shown that have not been baked.
constexpr float kPlainAlbedo = 0.8f;
/// Degrees that the light turns for one pixel of dragging.
constexpr double kDegreesPerPixel = 1;

std::vector<QWidget*> viewers() {
  std::vector<QWidget*> found;
  for (QWidget* widget : QApplication::allWidgets()) {
    if (widget->inherits("GLArea")) found.push_back(widget);
  }
  return found;
}

/// The light without its rotation, so that turning it does not change the exposure.
std::string describe(const LightChoice& choice) {
  return std::to_string(static_cast<int>(choice.kind)) + " " + choice.file + " " + std::to_string(choice.sunAltitude) +
         " " + std::to_string(choice.sunIrradiance) + " " + std::to_string(choice.ground);
}

}  // namespace

/// What is kept of a layer.
struct LiveView::Layer {
  LayerState state;  ///< of the layer when it was read
  TransferSet transfer;
  sh::Matrix3d turn;           ///< from the axes of the bake to those in which the layer stands
  std::vector<Vec3f> normals;  ///< in world axes, of a layer that is not baked
  std::vector<double> areas;   ///< that belong to each vertex, in the layer's own units
  std::unique_ptr<LayerDrawing> drawing;
  std::vector<Rgb> radiance;
  std::string problem;  ///< why it is shown without its transfer; empty where it is not
  unsigned litFor = 0;  ///< the turn of the light that `radiance` belongs to
};

LiveView::LiveView() {
  showPanel();
  for (QWidget* viewer : viewers()) viewer->installEventFilter(this);
}

LiveView::~LiveView() {
  delete panel_;
}

void LiveView::showPanel() {
  QWidget* parent = QApplication::activeWindow();
  panel_ = new LightPanel(parent, [this] {
    ++turn_;
    update();
  });
  panel_->show();
}

void LiveView::update() {
  for (QWidget* viewer : viewers()) viewer->update();
}

void LiveView::release() {
  layers_.clear();
  program_.reset();
}

bool LiveView::eventFilter(QObject* watched, QEvent* event) {
  const auto kind = event->type();
  if (kind == QEvent::MouseButtonRelease) dragged_.reset();
  if (kind != QEvent::MouseMove && kind != QEvent::MouseButtonPress) return QObject::eventFilter(watched, event);
  const auto* mouse = static_cast<QMouseEvent*>(event);
  const bool turning = (mouse->buttons() & Qt::LeftButton) != 0 && (mouse->modifiers() & Qt::ControlModifier) != 0 &&
                       (mouse->modifiers() & Qt::ShiftModifier) != 0;
  if (!turning || panel_.isNull()) return QObject::eventFilter(watched, event);
  if (dragged_) {
    const QPoint by = mouse->pos() - *dragged_;
    panel_->drag(kDegreesPerPixel * by.x(), -kDegreesPerPixel * by.y());
  }
  dragged_ = mouse->pos();
  return true;  // MeshLab would turn a light of its own
}

LiveView::Layer& LiveView::layerOf(MeshModel& model) {
  std::unique_ptr<Layer>& layer = layers_[model.id()];
  const LayerState state = stateOf(model);
  if (layer && layer->state == state) return *layer;
  layer = std::make_unique<Layer>();
  layer->state = state;
  LayerSurface surface = readSurface(model);
  layer->drawing = std::make_unique<LayerDrawing>(surface);
  try {
    if (holdsTransfer(model)) {
      StoredTransfer stored = readTransfer(model);
      layer->transfer = std::move(stored.transfer);
      layer->turn = stored.turn;
    } else {
      layer->problem = model.label().toStdString() + ": not baked, shown without shadows";
    }
  } catch (const Error& failure) {
    layer->problem = failure.what();
  }
  if (layer->transfer.order == 0) layer->normals = readLayer(model).mesh.vertexNormals;
  Mesh mesh;
  for (const Vec3f& p : surface.positions) mesh.positions.emplace_back(p);
  mesh.triangles = std::move(surface.triangles);
  layer->areas = vertexAreas(mesh);
  return *layer;
}

void LiveView::light(Layer& layer) {
  if (layer.litFor == turn_) return;
  const Parallel parallel;
  Progress progress;
  std::vector<std::string> notes;
  const int order = layer.transfer.order > 0 ? layer.transfer.order : 3;
  Light light = lights_.make(panel_ ? panel_->choice() : LightChoice{}, order, parallel, progress, notes);
  if (layer.turn != sh::Matrix3d{}) light = rotated(light, sh::transposed(layer.turn));
  if (layer.transfer.order > 0) {
    layer.radiance = relight(layer.transfer, light, {}, parallel);
  } else {
    layer.radiance.clear();
    const double share = static_cast<double>(kPlainAlbedo) / std::acos(-1.0);
    for (const Vec3f& n : layer.normals) layer.radiance.emplace_back(irradianceAt(light, normalized(Vec3d(n))) * share);
  }
  layer.drawing->setRadiance(layer.radiance);
  layer.litFor = turn_;
}

void LiveView::adjustExposure() {
  const std::string now = panel_ ? describe(panel_->choice()) : std::string();
  if (now == exposed_ && !exposed_.empty()) return;
  std::vector<Rgb> radiance;
  std::vector<double> areas;
  for (const auto& [id, layer] : layers_) {
    if (layer->litFor != turn_) continue;
    radiance.insert(radiance.end(), layer->radiance.begin(), layer->radiance.end());
    areas.insert(areas.end(), layer->areas.begin(), layer->areas.end());
  }
  exposure_ = automaticExposure(radiance, areas);
  exposed_ = now;
}

void LiveView::render(MeshDocument& document) {
  std::string words;
  try {
    if (!program_) program_ = std::make_unique<LiveProgram>();
    std::vector<std::pair<MeshModel*, Layer*>> shown;
    for (MeshModel* model : layersOf(document)) {
      if (!model->isVisible() || model->cm.fn == 0) continue;
      Layer& layer = layerOf(*model);
      light(layer);
      if (words.empty()) words = layer.problem;
      shown.emplace_back(model, &layer);
    }
    adjustExposure();
    const double exposure = exposure_ + (panel_ ? panel_->exposure() : 0);
    for (const auto& [model, layer] : shown) program_->draw(*layer->drawing, columnMajorTransform(*model), exposure);
  } catch (const std::exception& failure) {
    words = describeFailure(failure);
  }
  if (words == told_ || panel_.isNull()) return;
  told_ = words;
  panel_->say(words.empty() ? QStringLiteral("Ctrl+Shift and drag in the view to turn the light.")
                            : QString::fromStdString(words));
}

}  // namespace shbake::meshlab
