#include <cmath>
#include <cstdio>

#include "airsim360/base/error.h"
#include "airsim360/image/codecs_internal.h"

namespace airsim360::internal {
namespace {

std::string Property(const char* name, const std::string& value) {
  return std::string("   <GPano:") + name + ">" + value + "</GPano:" + name + ">\n";
}

// Shortest of fixed notation with six decimals: 0.1 arc seconds, without trailing zeros.
std::string Degrees(double value) {
  if (!std::isfinite(value)) throw InputError("GPano: pose is not finite");
  char text[400];
  std::snprintf(text, sizeof text, "%.6f", value);
  std::string s = text;
  s.erase(s.find_last_not_of('0') + 1);
  if (s.back() == '.') s.pop_back();
  return s == "-0" ? "0" : s;
}

}  // namespace

std::string GPanoXmp(const GPano& gpano, int width, int height) {
  const std::string w = std::to_string(width), h = std::to_string(height);
  // The heading is a compass bearing in [0, 360).
  double heading = std::fmod(gpano.heading_deg, 360.0);
  if (heading < 0) heading += 360.0;
  if (heading >= 359.9999995) heading = 0;
  return std::string("<?xpacket begin=\"\xEF\xBB\xBF\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n") +
         "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n"
         " <rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n"
         "  <rdf:Description rdf:about=\"\" xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\">\n" +
         Property("UsePanoramaViewer", "True") + Property("ProjectionType", "equirectangular") + Property("FullPanoWidthPixels", w) +
         Property("FullPanoHeightPixels", h) + Property("CroppedAreaImageWidthPixels", w) + Property("CroppedAreaImageHeightPixels", h) +
         Property("CroppedAreaLeftPixels", "0") + Property("CroppedAreaTopPixels", "0") + Property("PoseHeadingDegrees", Degrees(heading)) +
         Property("PosePitchDegrees", Degrees(gpano.pitch_deg)) + Property("PoseRollDegrees", Degrees(gpano.roll_deg)) +
         "  </rdf:Description>\n"
         " </rdf:RDF>\n"
         "</x:xmpmeta>\n"
         "<?xpacket end=\"r\"?>";
}

}  // namespace airsim360::internal
