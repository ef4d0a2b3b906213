// Vertex buffers and the two small shaders of the live view.
#include "meshlab_plugin/live_drawing.h"

#include <QMatrix4x4>
#include <QOpenGLBuffer>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QOpenGLShaderProgram>
#include <cmath>
#include <limits>

namespace shbake::meshlab {
namespace {

constexpr const char* kVertexShader = R"(#version 120
attribute vec3 position;
attribute vec3 radiance;
uniform mat4 transform;
varying vec3 light;
void main() {
  light = radiance;
  gl_Position = transform * vec4(position, 1.0);
})";

// IEC 61966-2-1, as base/srgb.h has it.
constexpr const char* kFragmentShader = R"(#version 120
uniform float gain;
varying vec3 light;
void main() {
  vec3 c = clamp(light * gain, 0.0, 1.0);
  vec3 curved = 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055;
  gl_FragColor = vec4(mix(12.92 * c, curved, step(vec3(0.0031308), c)), 1.0);
})";

void fill(QOpenGLBuffer& buffer, const void* data, std::size_t bytes) {
  if (bytes > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw Error({.cause = "the mesh is too large for the live view", .remedy = "use SH Relight instead"});
  }
  if (!buffer.isCreated() && !buffer.create()) {
    throw Error({.cause = "the graphics driver gives no vertex buffers", .remedy = "use SH Relight instead"});
  }
  buffer.bind();
  buffer.allocate(data, static_cast<int>(bytes));
  buffer.release();
}

}  // namespace

struct LayerDrawing::Buffers {
  QOpenGLBuffer positions{QOpenGLBuffer::VertexBuffer}, radiance{QOpenGLBuffer::VertexBuffer};
  QOpenGLBuffer corners{QOpenGLBuffer::IndexBuffer};
  int cornerCount = 0;
};

struct LiveProgram::Shaders {
  QOpenGLShaderProgram program;
};

LayerDrawing::LayerDrawing(const LayerSurface& surface) : buffers_(std::make_unique<Buffers>()) {
  buffers_->cornerCount = static_cast<int>(3 * surface.triangles.size());
  fill(buffers_->positions, surface.positions.data(), surface.positions.size() * sizeof(Vec3f));
  fill(buffers_->corners, surface.triangles.data(), surface.triangles.size() * sizeof(Triangle));
}

LayerDrawing::~LayerDrawing() = default;

void LayerDrawing::setRadiance(const std::vector<Rgb>& radiance) {
  fill(buffers_->radiance, radiance.data(), radiance.size() * sizeof(Rgb));
}

LiveProgram::LiveProgram() : shaders_(std::make_unique<Shaders>()) {
  QOpenGLShaderProgram& program = shaders_->program;
  const bool linked = program.addShaderFromSourceCode(QOpenGLShader::Vertex, kVertexShader) &&
                      program.addShaderFromSourceCode(QOpenGLShader::Fragment, kFragmentShader) && program.link();
  if (linked) return;
  throw Error({.cause = "the graphics driver refuses the shaders: " + program.log().toStdString(),
               .remedy = "use SH Relight instead"});
}

LiveProgram::~LiveProgram() = default;

void LiveProgram::draw(LayerDrawing& drawing, const std::array<float, 16>& transform, double exposure) {
  QMatrix4x4 projection, view, layer;
  glGetFloatv(GL_PROJECTION_MATRIX, projection.data());
  glGetFloatv(GL_MODELVIEW_MATRIX, view.data());
  std::copy(transform.begin(), transform.end(), layer.data());

  QOpenGLShaderProgram& program = shaders_->program;
  program.bind();
  program.setUniformValue("transform", projection * view * layer);
  program.setUniformValue("gain", static_cast<float>(std::exp2(exposure)));
  const auto attach = [&program](QOpenGLBuffer& buffer, const char* name) {
    buffer.bind();
    program.setAttributeBuffer(name, GL_FLOAT, 0, 3);
    program.enableAttributeArray(name);
    buffer.release();
  };
  LayerDrawing::Buffers& buffers = *drawing.buffers_;
  attach(buffers.positions, "position");
  attach(buffers.radiance, "radiance");
  buffers.corners.bind();
  glDrawElements(GL_TRIANGLES, buffers.cornerCount, GL_UNSIGNED_INT, nullptr);
  buffers.corners.release();
  program.disableAttributeArray("position");
  program.disableAttributeArray("radiance");
  program.release();
}

}  // namespace shbake::meshlab
