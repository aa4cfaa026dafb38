#include <algorithm>
#include <array>
#include <string_view>

#include "airsim360/base/nearest_name.h"

namespace airsim360::internal {
namespace {

// Rows of words that users take for each other, apart by spaces, with a space at both ends. What is compared
// is lower case, letters and digits alone, singular. A row helps only where one of its words is a choice, so
// that rows of different fields (pictures, weather, flags) may share words; the first row that helps wins.
constexpr auto kRows = std::to_array<std::string_view>({
    // Pictures.
    " range depth distance dist zdepth depthmap ",
    " semantic seg segmentation semseg label class category mask ",
    " entity instance object panoptic instancesegmentation ",
    " rgb color colour image picture photo ",
    " flow opticalflow motionvector ",
    " normal surfacenormal ",
    " position xyz point pointcloud coordinate ",
    " albedo basecolor basecolour diffuse ",
    " erp pano panorama 360 equirect equirectangular spherical sphere latlong ",
    " pinhole perspective rectilinear ",
    " cube cubemap skybox ",
    " fisheye wideangle ",
    // Light and weather.
    " clear sunny fine cloudless bluesky ",
    " day noon midday daytime afternoon ",
    " morning dawn sunrise ",
    " golden goldenhour ",
    " sunset evening ",
    " dusk twilight ",
    " night dark midnight nighttime ",
    " overcast cloudy cloud grey gray ",
    " fog foggy ",
    " mist misty haze hazy ",
    " rain rainy raining wet drizzle ",
    " storm stormy thunderstorm thunder ",
    " snow snowy snowing blizzard ",
    " winter frost icy ",
    // Sensors.
    " gnss gps ",
    " imu accelerometer gyroscope gyro ",
    " magnetometer compass ",
    " barometer altimeter ",
    // Quality and devices.
    " fast low draft preview quick ",
    " high best good hq ",
    " reference ultra pathtracer pathtraced offline ",
    " vulkan gpu cuda nvidia ",
    // Worlds.
    " newyorkcity nyc manhattan ",
    " sfcity sanfrancisco ",
    " apartment flat home ",
    " carpark parking garage ",
    // Commands.
    " world list ls map scene ",
    " collect generate record dataset ",
    " render capture screenshot snapshot ",
    " fly flight simulate run ",
    " serve server airsim rpc ",
    " verify check validate ",
    " eval evaluate metric score ",
    " doctor diagnose status info ",
    " view viewer show open display gui ",
    " video movie mp4 encode ",
    " plan trajectory path ",
    // Tasks of a flight.
    " goto moveto flyto move go ",
    " return rtl rth home ",
    " hover wait hold loiter sleep pause ",
    " takeoff launch start ",
    " land landing ",
    // Flags and keys.
    " out output outdir outputdir outputfolder destination save ",
    " size resolution res dimension width ",
    " frame count num nframe numframe ",
    " fps framerate rate ",
    " vmax maxspeed maxvelocity maxvel topspeed speed ",
    " amax maxacceleration maxaccel maxacc acceleration ",
    " world map scene level ",
    " pose position camera viewpoint location ",
    " people pedestrian human person crowd walker ",
    " tier quality preset ",
    " sample spp ",
    " fov fieldofview hfov vfov ",
    " drone vehicle uav robot quadrotor quadcopter multirotor ",
    " script mission task command ",
    " waypoint route ",
    " clearance margin safetymargin ",
    " from start begin ",
    " to goal end target ",
    " dt timestep step period ",
    " height altitude elevation ",
    " yaw heading ",
    " thread core cpu job worker ",
    " seed randomseed rng ",
    " host address bind ip ",
    " lockstep sync synchronous ",
    " realtime wallclock ",
    " minimise minimize objective ",
    " time date datetime hour ",
    " setting config configuration ",
});

}  // namespace

bool SameMeaning(std::string_view a, std::string_view b) {
  const auto holds = [](std::string_view row, std::string_view word) {
    for (size_t at = row.find(word); at != std::string_view::npos; at = row.find(word, at + 1)) {
      if (row[at - 1] == ' ' && row[at + word.size()] == ' ') return true;
    }
    return false;
  };
  return !a.empty() && !b.empty() && std::ranges::any_of(kRows, [&](std::string_view row) { return holds(row, a) && holds(row, b); });
}

}  // namespace airsim360::internal
