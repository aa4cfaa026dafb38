#include "airsim360/eval/files/step_video.h"

#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/image/codecs.h"
#include "airsim360/image/palette_png.h"

namespace airsim360 {

StepFrame ReadStepFrame(const std::filesystem::path& path, const StepClasses& classes, bool truth) {
  const Bytes bytes = ReadFile(path);
  const PngKind kind = ReadPngKind(bytes, path.string());
  if (kind.channels != 3 || kind.bit_depth != 8 || IsPalettePng(bytes, path.string()))
    throw InputError(path.string() + ": is no 8-bit RGB PNG as STEP has them (red is the class, 256 green + blue the instance)");
  const Image<Rgba8> image = DecodeRgba8(bytes, path.string());
  StepFrame frame;
  frame.ids.width = image.width();
  frame.ids.height = image.height();
  frame.ids.ids.reserve(image.size());
  frame.blue.reserve(image.size());
  std::set<uint32_t> seen;
  size_t zero = 0, numbered = 0;  // of class 0; of them those with a number in blue
  for (const Rgba8 p : image.pixels()) {
    if (p.r != classes.ignored && p.r >= classes.count)
      throw InputError(path.string() + ": class " + std::to_string(p.r) + " is not among the " + std::to_string(classes.count) +
                       " classes (--classes; red is the class: are the channels the other way round?)");
    const bool thing = classes.things.contains(p.r);
    const uint32_t instance = thing ? 256u * p.g + p.b : 0;
    zero += p.r == 0;
    numbered += p.r == 0 && p.g == 0 && p.b > 0;
    frame.blue.push_back(p.b);
    frame.ids.ids.push_back(p.r == classes.ignored ? 0 : (p.r + 1u) << 16 | instance);
    if (frame.ids.ids.size() < 2 || frame.ids.ids.back() != frame.ids.ids[frame.ids.ids.size() - 2]) seen.insert(frame.ids.ids.back());
  }
  // Nearly all of a picture in the other order seems to be of class 0, and its classes stand in blue.
  frame.reversed = !classes.things.contains(0) && 10 * zero > 7 * image.size() && 10 * numbered > 4 * image.size();
  seen.erase(0);
  for (const uint32_t id : seen) {
    const size_t category = (id >> 16) - 1;
    frame.segments.push_back({id, category, truth && (id & 0xffff) == 0 && classes.things.contains(static_cast<int>(category))});
  }
  return frame;
}

LikelyMistake ChannelMistake(const StepFrame& prediction, const StepFrame& truth) {
  constexpr size_t kLeastPixels = 64;
  size_t pixels = 0, red = 0, blue = 0;
  for (size_t i = 0; i < truth.ids.ids.size(); ++i) {
    const uint32_t category = truth.ids.ids[i] >> 16;  // the class + 1, 0 = ignored
    if (category < 2) continue;
    ++pixels;
    red += prediction.ids.ids[i] >> 16 == category;
    blue += prediction.blue[i] + 1u == category;
  }
  if (pixels < kLeastPixels || 10 * blue <= 3 * pixels || blue <= 3 * red) return {};
  return {"blue says what the class is, not red: write the channels the other way round (cv2 takes blue, green, red)",
          static_cast<double>(blue) >= internal::kNearlyAll * static_cast<double>(pixels)};
}

}  // namespace airsim360
