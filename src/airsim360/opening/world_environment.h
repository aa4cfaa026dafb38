// Sun, sky and weather by words: the `environment:` of world files and the flags of commands.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "airsim360/base/config.h"
#include "airsim360/scene/environment.h"

namespace airsim360 {

/// A sky picture: .hdr/.pic (Radiance) or .exr, twice as wide as high, at most 2^26 pixels. Its name holds
/// the file's name and hash. InputError naming the file otherwise.
std::shared_ptr<const SkyPicture> LoadSkyPicture(const std::filesystem::path& file);

/// Sets the sun's place of a time and place given as texts ("2026-06-21T14:30+02:00", "52.5,13.4"); both or
/// none. InputError naming the text.
void SetSunByTime(std::string_view time, std::string_view place, Environment& environment);

/// The fields of `environment:` in a world file, over the values of `environment`; `folder` is where relative
/// paths start. A `weather` counts before the other fields, date and place before sun angles.
void VisitEnvironment(ConfigVisitor& v, const std::filesystem::path& folder, Environment& environment);

/// What a command line says of the environment; empty = nothing.
struct EnvironmentFlags {
  std::string weather = {}, sun = {}, time = {}, place = {}, hdri = {}, settings = {};
};

/// `base` with what the flags say, in the order weather, time, sun, hdri, settings ("name=value,…").
/// InputError naming the flag.
Environment ApplyFlags(const EnvironmentFlags& flags, const Environment& base);

}  // namespace airsim360
