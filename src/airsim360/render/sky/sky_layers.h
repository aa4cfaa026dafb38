// What the sunlit atmosphere leaves out: the night sky, and how much light a closed sky gives.
#pragma once

#include "airsim360/math/vector.h"
#include "airsim360/render/sky/sky_table.h"

namespace airsim360::internal {

/// Share of the sun's irradiance that the moon gives outside the atmosphere, by the lit share of its disc:
/// magnitudes -26.74 and -12.74; a half moon gives a twelfth of a full one (Allen, Astrophysical Quantities).
float MoonShare(double phase);

/// Radiance of the moonless night sky: airglow, zodiacal light and faint stars (22 mag/arcsec^2 at the
/// zenith, 1.7e-4 cd/m^2, brighter towards the horizon after van Rhijn), and the glow of a town whose lamps burn:
/// `town` of that of large cities (18 mag/arcsec^2, 6.8e-3 cd/m^2, at the zenith over the middle; six times that at the horizon).
Vec3f NightGlow(Vec3f direction, float town);

/// Colour of the light of a town's lamps, of about the luminance one.
inline constexpr Vec3f kTownLight{1.30f, 0.98f, 0.72f};

/// Adds the stars of the upper hemisphere down to magnitude 6.5: about 4,500 at invented places, their number
/// growing as 10^(0.5 m), each with the illuminance of its magnitude (2.54e-6 lx for 0).
void AddStars(SkyTable& table);

/// Illuminance of level ground under a thick overcast sky, in units: 300 + 21000 sin(elevation) lux
/// (Krochmann 1963), below the horizon in proportion to `clear`, that of a clear sky.
float OvercastIlluminance(float sun_z, float clear);

}  // namespace airsim360::internal
