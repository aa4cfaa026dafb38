// Sun, sky and weather by words: the `environment:` of world files and the flags of commands.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/base/config.h"
#include "airsim360/scene/environment.h"

namespace airsim360 {

/// A sky picture: .hdr/.pic (Radiance) or .exr, twice as wide as high, at most 2^26 pixels. Its name holds
/// the file's name and hash. InputError naming the file otherwise.
std::shared_ptr<const SkyPicture> LoadSkyPicture(const std::filesystem::path& file);

/// Sets the sun's place of a time and place given as texts ("2026-06-21T14:30+02:00", "52.5,13.4"); both or
/// none. InputError naming the text.
void SetSunByTime(std::string_view time, std::string_view place, Environment& environment);

/// The `environment:` of a world file. Presets keep some values of the world's own environment, which is
/// known only once the world is read: so a file's words are kept, and laid over it then.
class EnvironmentWords {
 public:
  /// Names the fields; `folder` is where relative paths start. InputError for what could not be laid over
  /// anything.
  void Visit(ConfigVisitor& v, const std::filesystem::path& folder);
  /// `base` with what the file says: `weather`, then `clouds`, before the other fields; date and place before sun angles.
  Environment Over(Environment base) const;

 private:
  std::string weather_, clouds_, date_, time_, cloud_type_, lamps_;
  double latitude_ = 0, longitude_ = 0;
  std::vector<double> numbers_;  // of EnvironmentFields(); not a number: not said
  std::shared_ptr<const SkyPicture> hdri_;
};

/// What a command line says of the environment; empty = nothing.
struct EnvironmentFlags {
  std::string weather = {}, sun = {}, time = {}, place = {}, hdri = {}, settings = {}, clouds = {}, sky_seed = {};
};

/// `base` with what the flags say, in the order weather, clouds, time, sun, hdri, sky_seed, settings ("name=value,…").
/// InputError naming the flag.
Environment ApplyFlags(const EnvironmentFlags& flags, const Environment& base);

}  // namespace airsim360
