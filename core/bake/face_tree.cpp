// The faces of a scene in Embree.
#include "bake/face_tree.h"

#include <embree3/rtcore.h>
#include <sys/types.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>
#include <string>

#include "bake/contact.h"
#include "bake/face_twins.h"
#include "bake/flush_denormals.h"
#include "base/error.h"
#include "base/loop_order.h"

namespace shbake {
namespace {

float longestEdgeOf(const LightingPoints& points) {
  float longest2 = 0;
  for (const Triangle& t : points.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f edge = points.positions[t[k]] - points.positions[t[(k + 1) % 3]];
      longest2 = std::max(longest2, dot(edge, edge));
    }
  }
  return std::sqrt(longest2);
}

[[noreturn]] void fail(RTCError code, const char* text) {
  if (code == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (code == RTC_ERROR_CANCELLED) throw cancelledError();
  throw Error({.cause = std::string("Embree cannot build the scene: ") + text});
}

/// Builds what rays are traced in, on the threads of `parallel`; errors come through the device's function for them.
void build(RTCScene scene, const Parallel& parallel, Progress& progress) {
  struct Watch {
    Progress& progress;
    LoopOrder order{0};
  } watch{progress};
  // Embree calls it from a loop of its own.
  rtcSetSceneProgressMonitorFunction(
      scene,
      [](void* user, double) {
        Watch& w = *static_cast<Watch*>(user);
        const LoopOrder::Block block(w.order);
        return w.progress.tryAdvance(0);
      },
      &watch);
  // Joined from our own threads: a device with a number of threads would set a limit for the whole process.
  parallel.forBlocks(1, 1, [&](std::size_t, std::size_t, int) { rtcJoinCommitScene(scene); });
  rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
}

}  // namespace

struct FaceTree::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<Vec3f> padded;  // a copy of the positions where these have no room behind them
  std::vector<std::uint32_t> twins;
  double contact = 0;
  float longestEdge = 0;
  bool hasPackets = false;
  std::atomic<std::ptrdiff_t> embreeBytes{0};
  RTCError error = RTC_ERROR_NONE;
  std::string errorText;

  ~State() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  void makeDevice();
  void attach(const LightingPoints& points);
};

void FaceTree::State::makeDevice() {
  device = rtcNewDevice(nullptr);
  if (device == nullptr) fail(rtcGetDeviceError(nullptr), "no device");
  rtcSetDeviceErrorFunction(
      device,
      [](void* user, RTCError code, const char* text) {
        auto* state = static_cast<State*>(user);
        state->error = code;
        // Who stopped the work needs no words about it.
        if (code != RTC_ERROR_CANCELLED) state->errorText = text == nullptr ? "" : text;
      },
      this);
  rtcSetDeviceMemoryMonitorFunction(
      device,
      [](void* user, ssize_t bytes, bool) {
        static_cast<State*>(user)->embreeBytes += bytes;
        return true;
      },
      this);
  hasPackets = rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
}

void FaceTree::State::attach(const LightingPoints& points) {
  // Embree loads positions as four floats, the last one's fourth from behind the array.
  const bool hasRoom = points.positions.capacity() > points.positions.size();
  if (!hasRoom) {
    padded.reserve(points.positions.size() + 1);
    padded = points.positions;
  }
  const Vec3f* positions = hasRoom ? points.positions.data() : padded.data();
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions, 0, sizeof(Vec3f),
                             points.positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, points.faces.data(), 0,
                             sizeof(Triangle), points.faces.size());
  rtcCommitGeometry(geometry);
  scene = rtcNewScene(device);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  // Which rays need the filter that leaves out own faces is told with the rays.
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

FaceTree::FaceTree(const LightingPoints& points, const Parallel& parallel, Progress& progress)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.contact = contactDistance(points);
  s.longestEdge = longestEdgeOf(points);
  s.twins = faceTwins(points, progress);
  const FlushDenormals flush;
  s.makeDevice();
  s.attach(points);
  progress.begin("building", 0, "faces");
  build(s.scene, parallel, progress);
  if (s.error != RTC_ERROR_NONE) fail(s.error, s.errorText.c_str());
  progress.end();
}

FaceTree::~FaceTree() = default;

RTCSceneTy* FaceTree::scene() const {
  return state_->scene;
}

bool FaceTree::hasPackets() const {
  return state_->hasPackets;
}

double FaceTree::contact() const {
  return state_->contact;
}

float FaceTree::longestEdge() const {
  return state_->longestEdge;
}

const std::vector<std::uint32_t>& FaceTree::twins() const {
  return state_->twins;
}

std::size_t FaceTree::bytes() const {
  const State& s = *state_;
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, s.embreeBytes)) + s.padded.capacity() * sizeof(Vec3f) +
         s.twins.capacity() * sizeof(std::uint32_t);
}

}  // namespace shbake
