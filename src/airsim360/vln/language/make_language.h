// Language data with proofs: captions, referring expressions and questions about what panoramas and cameras of a world show.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/stage/stage.h"

namespace airsim360 {

inline constexpr const char* kLanguageKinds[] = {"caption", "refer", "vqa"};

struct LanguageOptions {
  std::string kind = "vqa";
  int64_t count = 1000;
  int width = 1024;  ///< of panoramas, pixels; a camera's picture is half as wide and square
};

struct LanguageSummary {
  int64_t items = 0, pictures = 0, lookouts = 0;
  std::vector<std::pair<std::string, int64_t>> by_type = {};
};

/// InputError naming the flag of an option that makes no sense.
void CheckLanguageOptions(const LanguageOptions& options);

/// Gives `line` one item after another, as docs/guide/language.md has them. The same options give the same lines, whatever
/// the number of threads. InputError for options that make no sense and a world that names nothing; RuntimeError if the world
/// does not give so many items.
LanguageSummary MakeLanguage(Stage& stage, const LanguageOptions& options, const std::function<void(const std::string& line)>& line);

/// A picture that items name.
struct LanguagePicture {
  std::string file;  ///< beside the items: "pictures/…jpg"
  bool panorama = true;
  Vec3d position;
  double yaw_deg = 0, azimuth_deg = 0;
  int width = 0, height = 0;
  std::string world;
  uint64_t world_seed = 0;
};
/// All pictures that the items of a file name, each once, in their order. InputError "FILE:LINE.field: …".
std::vector<LanguagePicture> PicturesOf(const std::filesystem::path& items);
/// Draws them below `folder` as JPEG files; what is there already stays. `jpeg`: of one picture.
void DrawPictures(Stage& stage, const std::vector<LanguagePicture>& pictures, const RenderSettings& settings,
                  const std::filesystem::path& folder);

}  // namespace airsim360
