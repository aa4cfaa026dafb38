#include "airsim360/opening/world_environment.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/hash.h"
#include "airsim360/image/codecs.h"
#include "airsim360/scene/sun_position.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kMaxPictureFile = uint64_t{1} << 30;
constexpr int64_t kMaxPicturePixels = int64_t{1} << 26;

// Adds to an InputError where it came from.
template <class Action>
void Naming(const std::string& where, const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    throw InputError(where + ": " + error.what());
  }
}

bool ParseWholeNumber(std::string_view text, double& value) {
  const auto [at, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && at == text.data() + text.size();
}

Lamps ParseLamps(const std::string& text) { return ParseChoice<Lamps>("lamps", text, kLampsNames); }

CloudType ParseCloudType(const std::string& text) { return ParseChoice<CloudType>("cloud_type", text, kCloudTypeNames); }

// "AZ,EL" in degrees.
void SetSun(const std::string& text, Environment& environment) {
  const size_t comma = text.find(',');
  if (comma == std::string::npos || !ParseWholeNumber(std::string_view(text).substr(0, comma), environment.sun_azimuth_deg) ||
      !ParseWholeNumber(std::string_view(text).substr(comma + 1), environment.sun_elevation_deg)) {
    throw InputError("'" + text + "' is not azimuth,elevation in degrees, for example 215,48");
  }
}

// "name=value,name=value".
void ApplySettings(std::string_view text, Environment& environment) {
  std::set<std::string> given;
  for (bool more = !text.empty(); more;) {
    const size_t comma = text.find(',');
    more = comma != std::string_view::npos;
    const std::string_view item = text.substr(0, comma);
    text.remove_prefix(more ? comma + 1 : text.size());
    const size_t equals = item.find('=');
    if (equals == std::string_view::npos) throw InputError("'" + std::string(item) + "' is not name=value");
    const std::string name(item.substr(0, equals)), value(item.substr(equals + 1));
    if (!given.insert(name).second) throw InputError(name + ": is there twice");
    if (name == "lamps") {
      environment.lamps = ParseLamps(value);
      continue;
    }
    if (name == "cloud_type") {
      environment.cloud_type = ParseCloudType(value);
      continue;
    }
    const auto& fields = EnvironmentFields();
    const auto field = std::find_if(fields.begin(), fields.end(), [&](const auto& f) { return f.name == name; });
    if (field == fields.end()) {
      std::vector<std::string> names = {"lamps", "cloud_type"};
      for (const EnvironmentField& f : fields) names.emplace_back(f.name);
      throw InputError(UnknownChoiceMessage("setting", name, names));
    }
    if (!ParseWholeNumber(value, environment.*field->value)) throw InputError(name + ": '" + value + "' is not a number");
  }
}

// A pixel that is no number, or a sky without light, would be black without a word. Filters leave small negative values.
void CheckLight(const Image<Rgb32f>& picture, const std::string& file) {
  bool light = false;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const auto& p = picture(x, y);
      for (const float c : {p.r, p.g, p.b}) {
        if (!std::isfinite(c)) {
          throw InputError(file + ": pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") holds " +
                           (std::isnan(c) ? "nan" : "inf") + ", not a finite number");
        }
        light = light || c > 0;
      }
    }
  }
  if (!light) throw InputError(file + ": no pixel has light: a sky picture holds linear light above 0");
}

}  // namespace

std::shared_ptr<const SkyPicture> LoadSkyPicture(const fs::path& file) {
  std::string extension = file.extension();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const bool radiance = extension == ".hdr" || extension == ".pic";
  if (!radiance && extension != ".exr") throw InputError(file.string() + ": a sky picture is a .hdr, .pic or .exr file");
  const Bytes bytes = ReadFile(file, kMaxPictureFile);
  auto picture = std::make_shared<SkyPicture>();
  picture->name = file.filename().string() + " sha256:" + Sha256Hex(bytes);
  picture->pixels = radiance ? DecodeRadianceHdr(bytes, file.string()) : DecodeExrRgb(bytes, file.string());
  const int64_t width = picture->pixels.width(), height = picture->pixels.height();
  if (width != 2 * height || width < 8 || width * height > kMaxPicturePixels) {
    throw InputError(file.string() + ": " + std::to_string(width) + "x" + std::to_string(height) +
                     " is not a whole sky, twice as wide as high, of at most 2^26 pixels");
  }
  CheckLight(picture->pixels, file.string());
  return picture;
}

void SetSunByTime(std::string_view time, std::string_view place, Environment& environment) {
  if (time.empty() && place.empty()) return;
  if (time.empty() || place.empty()) throw InputError("a time needs a place, and a place a time");
  const SunAngles sun = SunPosition(ParseTime(time), ParsePlace(place));
  environment.sun_azimuth_deg = sun.azimuth_deg;
  environment.sun_elevation_deg = sun.elevation_deg;
}

void EnvironmentWords::Visit(ConfigVisitor& v, const fs::path& folder) {
  v.Field("weather", "a preset: day, sunset, overcast, fog, night, rain, snow, …", weather_);
  v.Field("clouds", "a preset: clear, humilis, broken, overcast, cirrus, haze, …", clouds_);
  v.Field("date", "2026-06-21", date_);
  v.Field("time", "14:30+02:00", time_);
  v.Field("latitude", "degrees north", latitude_, -90, 90);
  v.Field("longitude", "degrees east", longitude_, -180, 180);
  numbers_.assign(EnvironmentFields().size(), std::nan(""));
  for (size_t i = 0; i < numbers_.size(); ++i) {
    const EnvironmentField& field = EnvironmentFields()[i];
    v.Field(field.name, field.help, numbers_[i], field.low, field.high);
  }
  v.Field("cloud_type", "of the low clouds: auto, humilis, mediocris, congestus, stratocumulus, stratus", cloud_type_);
  v.Field("lamps", "auto, on or off", lamps_);
  std::string hdri;
  v.Field("hdri", "a sky picture, .hdr or .exr", hdri);
  if (!hdri.empty()) hdri_ = LoadSkyPicture(folder / hdri);
}

Environment EnvironmentWords::Over(Environment base) const {
  if (date_.empty() != time_.empty()) throw InputError("environment: date and time belong together");
  Environment environment = weather_.empty() ? std::move(base) : ParseEnvironmentPreset(weather_, base);
  if (!clouds_.empty()) environment = ParseCloudPreset(clouds_, environment);
  // Date and place give the sun, unless its angles follow.
  if (!date_.empty()) SetSunByTime(date_ + "T" + time_, std::to_string(latitude_) + "," + std::to_string(longitude_), environment);
  for (size_t i = 0; i < numbers_.size(); ++i) {
    if (!std::isnan(numbers_[i])) environment.*EnvironmentFields()[i].value = numbers_[i];
  }
  if (!cloud_type_.empty()) environment.cloud_type = ParseCloudType(cloud_type_);
  if (!lamps_.empty()) environment.lamps = ParseLamps(lamps_);
  if (hdri_) environment.hdri = hdri_;
  ValidateEnvironment(environment, "environment");
  return environment;
}

Environment ApplyFlags(const EnvironmentFlags& flags, const Environment& base) {
  Environment environment = base;
  if (!flags.weather.empty()) Naming("--weather", [&] { environment = ParseEnvironmentPreset(flags.weather, base); });
  if (!flags.clouds.empty()) Naming("--clouds", [&] { environment = ParseCloudPreset(flags.clouds, environment); });
  Naming("--time, --place", [&] { SetSunByTime(flags.time, flags.place, environment); });
  if (!flags.sun.empty()) {
    Naming("--sun", [&] { SetSun(flags.sun, environment); });
    ValidateEnvironment(environment, "--sun");
  }
  if (!flags.hdri.empty()) Naming("--hdri", [&] { environment.hdri = LoadSkyPicture(flags.hdri); });
  if (!flags.sky_seed.empty() && !ParseWholeNumber(flags.sky_seed, environment.sky_seed))
    throw InputError("--sky-seed: '" + flags.sky_seed + "' is not a whole number from 0 to 4294967295");
  ValidateEnvironment(environment, "--sky-seed");
  Naming("--environment", [&] { ApplySettings(flags.settings, environment); });
  ValidateEnvironment(environment, "--environment");
  return environment;
}

}  // namespace airsim360
