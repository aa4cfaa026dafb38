#include "airsim360/app/flags/camera_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/log.h"
#include "airsim360/base/parallel.h"
#include "airsim360/math/median.h"
#include "airsim360/sensors/surface_label.h"
#include "airsim360/trace/whereabouts.h"

namespace airsim360 {
namespace {

std::string Text(Vec3d p) {
  char text[96];
  std::snprintf(text, sizeof text, "%.6g, %.6g, %.6g", p.x, p.y, p.z);
  return text;
}

std::string NameOf(const Scene& scene, EntityId entity) {
  return entity == kNoEntity ? "something solid" : "'" + scene.entity(entity).name + "'";
}

// "the camera at 1, 2, 3", with the frame where there are several.
std::string CameraText(const Flight& flight, size_t frame, Vec3d p) {
  const std::string place = "the camera at " + Text(p);
  return flight.shots.size() > 1 ? "frame " + std::to_string(frame) + ": " + place : place;
}

std::string OutsideText(const Scene& scene) {
  return " is outside of '" + scene.name + "', which has no sky and reaches from " + Text(VecCast<double>(scene.bounds.min)) + " to " +
         Text(VecCast<double>(scene.bounds.max));
}

}  // namespace

void CheckStart(const RayTracer& tracer, Vec3d p_W, const std::string& what) {
  const Whereabouts found = FindWhereabouts(tracer, p_W);
  const std::string place = what + ": " + Text(p_W);
  if (found.kind == Whereabouts::Kind::kOutside) throw InputError(place + OutsideText(tracer.scene()));
  if (found.kind == Whereabouts::Kind::kInside)
    throw InputError(place + " is inside " + NameOf(tracer.scene(), LabelOf(tracer, found.surface).entity));
}

void CheckCameraPlaces(const RayTracer& tracer, const DatasetSpec& spec, const Flight& flight) {
  const std::vector<View> views = Views(spec);
  std::vector<Whereabouts> found(flight.shots.size() * views.size());
  const auto place = [&](size_t i) { return CameraPose(views[i % views.size()], flight.shots[i / views.size()].body.X_WB).p; };
  ParallelFor(static_cast<int64_t>(found.size()), [&](int64_t i) {
    const auto k = static_cast<size_t>(i);
    // The faces of a cube are in one place.
    const bool repeated = k % views.size() > 0 && place(k) == place(k - 1);
    if (!repeated) found[k] = FindWhereabouts(tracer, place(k));
  });
  size_t inside = 0, first = 0;
  for (size_t i = 0; i < found.size(); ++i) {
    const Scene& scene = tracer.scene();
    if (found[i].kind == Whereabouts::Kind::kOutside) {
      throw InputError(CameraText(flight, i / views.size(), place(i)) + OutsideText(scene));
    }
    if (found[i].kind == Whereabouts::Kind::kInside && inside++ == 0) first = i;
  }
  if (inside == 0) return;
  const std::string more = inside > 1 ? ", and " + std::to_string(inside - 1) + " more" : "";
  LogWarning(CameraText(flight, first / views.size(), place(first)) + " is inside " +
             NameOf(tracer.scene(), LabelOf(tracer, found[first].surface).entity) + more + ": pictures show it from within");
}

void CheckFlowSteps(const RayTracer& tracer, const DatasetSpec& spec, const Flight& flight) {
  constexpr size_t kFrames = 32;
  constexpr int kDirections = 96;
  if (!spec.products.flow || flight.shots.size() < 2) return;
  std::vector<double> steps, ranges;
  for (size_t i = 0; i + 1 < flight.shots.size(); ++i) steps.push_back(Norm(flight.shots[i + 1].body.X_WB.p - flight.shots[i].body.X_WB.p));
  // Ranges of some frames, evenly over the flight, in directions of equal solid angle.
  const size_t frames = std::min(kFrames, flight.shots.size());
  for (size_t k = 0; k < frames; ++k) {
    const Vec3f p = VecCast<float>(flight.shots[k * flight.shots.size() / frames].body.X_WB.p);
    for (int i = 0; i < kDirections; ++i) {
      const double z = 1 - (2.0 * i + 1) / kDirections, r = std::sqrt(1 - z * z), angle = i * std::numbers::phi * 2 * std::numbers::pi;
      const Vec3d direction{r * std::cos(angle), r * std::sin(angle), z};
      if (const auto hit = tracer.Intersect(p, VecCast<float>(direction))) ranges.push_back(static_cast<double>(hit->distance));
    }
  }
  if (ranges.empty()) return;
  const double step = UpperMedian(steps), range = UpperMedian(ranges);
  if (step < 0.5 * range) return;
  char text[240];
  std::snprintf(text, sizeof text,
                "--products flow: consecutive frames are %.3g m apart and what they show is %.3g m away (medians): little of one "
                "is in the next; take them closer together with --fps 10, and as many as you want with --frames",
                step, range);
  LogWarning(text);
}

}  // namespace airsim360
