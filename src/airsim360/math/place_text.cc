#include "airsim360/math/place_text.h"

#include <cctype>
#include <charconv>
#include <cmath>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

// Degrees of "60.1708N": positive north and east; `axis` becomes 'N' or 'E'.
std::optional<double> Degrees(std::string_view text, char& axis) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  if (text.size() < 2) return std::nullopt;
  const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(text.back())));
  if (letter != 'N' && letter != 'S' && letter != 'E' && letter != 'W') return std::nullopt;
  double value = 0;
  const char* const end = text.data() + text.size() - 1;
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  axis = letter == 'N' || letter == 'S' ? 'N' : 'E';
  return letter == 'S' || letter == 'W' ? -value : value;
}

}  // namespace

std::optional<GeoPoint> ParseLatitudeLongitude(std::string_view one, std::string_view two, const std::string& what) {
  char axis[2] = {};
  const auto first = Degrees(one, axis[0]), second = Degrees(two, axis[1]);
  if (!first && !second) return std::nullopt;
  const double latitude = axis[0] == 'N' ? first.value_or(0) : second.value_or(0),
               longitude = axis[0] == 'N' ? second.value_or(0) : first.value_or(0);
  if (!first || !second || axis[0] == axis[1] || std::abs(latitude) > 90 || std::abs(longitude) > 180)
    throw InputError(what + " is not a latitude and a longitude in degrees, for example 60.1708N,24.9375E");
  return GeoPoint{latitude, longitude, 0};
}

}  // namespace airsim360
