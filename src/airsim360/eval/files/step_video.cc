#include "airsim360/eval/files/step_video.h"

#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/image/codecs.h"

namespace airsim360 {

StepFrame ReadStepFrame(const std::filesystem::path& path, const StepClasses& classes, bool truth) {
  const Image<Rgba8> image = DecodeRgba8(ReadFile(path), path.string());
  StepFrame frame;
  frame.ids.width = image.width();
  frame.ids.height = image.height();
  frame.ids.ids.reserve(image.size());
  std::set<uint32_t> seen;
  for (const Rgba8 p : image.pixels()) {
    if (p.r != classes.ignored && p.r >= classes.count)
      throw InputError(path.string() + ": class " + std::to_string(p.r) + " is not among the " + std::to_string(classes.count) +
                       " classes (--classes)");
    const uint32_t instance = classes.things.contains(p.r) ? 256u * p.g + p.b : 0;
    frame.ids.ids.push_back(p.r == classes.ignored ? 0 : (p.r + 1u) << 16 | instance);
    if (frame.ids.ids.size() < 2 || frame.ids.ids.back() != frame.ids.ids[frame.ids.ids.size() - 2]) seen.insert(frame.ids.ids.back());
  }
  seen.erase(0);
  for (const uint32_t id : seen) {
    const size_t category = (id >> 16) - 1;
    frame.segments.push_back({id, category, truth && (id & 0xffff) == 0 && classes.things.contains(static_cast<int>(category))});
  }
  return frame;
}

}  // namespace airsim360
