#include "airsim360/scene/environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/scene/sun_position.h"

namespace airsim360 {
namespace {

std::string ErrorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Environment, EveryPresetIsValidAndTheDefaultIsDay) {
  for (const std::string& name : EnvironmentPresetNames()) {
    EXPECT_NO_THROW(ValidateEnvironment(ParseEnvironmentPreset(name), name)) << name;
  }
  EXPECT_EQ(DescribeEnvironment(ParseEnvironmentPreset("day")), "");
}

TEST(Environment, RefusesWhatIsOutOfRangeAndNamesTheNearest) {
  for (const EnvironmentField& field : EnvironmentFields()) {
    Environment e;
    e.*field.value = field.high * 2 + 1;
    const std::string error = ErrorOf([&] { ValidateEnvironment(e, "here"); });
    EXPECT_EQ(error.rfind("here: " + std::string(field.name), 0), 0u) << error;
    e.*field.value = std::nan("");
    EXPECT_NE(ErrorOf([&] { ValidateEnvironment(e, "here"); }), "no error") << field.name;
  }
  Environment e;
  e.visibility_m = 3;
  EXPECT_NE(ErrorOf([&] { ValidateEnvironment(e, "x"); }).find("nearest is 20"), std::string::npos);
}

TEST(Environment, AWrongPresetNamesTheNearest) {
  EXPECT_NE(ErrorOf([] { ParseEnvironmentPreset("sunsat"); }).find("did you mean 'sunset'"), std::string::npos);
}

TEST(Environment, PresetsKeepTheMoonAndAirOfTheWorld) {
  Environment base;
  base.turbidity = 4, base.moon_phase = 0.2;
  const Environment e = ParseEnvironmentPreset("rain", base);
  EXPECT_EQ(e.turbidity, 4);
  EXPECT_EQ(e.moon_phase, 0.2);
  EXPECT_GT(e.rain_mm_h, 0);
}

TEST(Environment, DescriptionTellsEnvironmentsApart) {
  Environment e;
  e.cloud_cover = 0.5, e.lamps = Lamps::kOn;
  EXPECT_EQ(DescribeEnvironment(e), "cloud_cover=0.5,lamps=on");
}

TEST(Environment, LampsBurnBelowThreeDegrees) {
  Environment e;
  EXPECT_FALSE(e.lamps_on());
  e.sun_elevation_deg = 2;
  EXPECT_TRUE(e.lamps_on());
  e.lamps = Lamps::kOff;
  EXPECT_FALSE(e.lamps_on());
}

TEST(SunPosition, AgreesWithTheExampleOfTheSolarPositionAlgorithm) {
  // Reda & Andreas, NREL/TP-560-34302 (2003), appendix A.5: zenith 50.11162, azimuth 194.34024 degrees, at
  // 820 hPa and 11 C, where refraction is a fifth smaller (0.003 degrees).
  const SunAngles sun = SunPosition(ParseTime("2003-10-17T12:30:30-07:00"), {39.742476, -105.1786});
  EXPECT_NEAR(sun.azimuth_deg, 194.34024, 0.02);
  EXPECT_NEAR(sun.elevation_deg, 90 - 50.11162, 0.02);
}

TEST(SunPosition, AgreesWithMeeusExample25a) {
  // 1992 October 13.0 TD: declination -7.78507 degrees. Where the sun culminates, elevation follows from it;
  // at the pole it is the declination itself, lifted by refraction when up. From the south pole the sun is
  // up.
  const SunAngles pole = SunPosition({1992, 10, 13, -59.0 / 3600}, {-90, 0});
  EXPECT_NEAR(pole.elevation_deg, 7.78507 + 0.115, 0.02);
}

TEST(SunPosition, StandsOverTheTropicAtTheSolstice) {
  // Solstice of 2024: June 20, 20:51 UTC; obliquity 23.4361 degrees. Northward of the pole the sun never
  // sets.
  const SunAngles sun = SunPosition(ParseTime("2024-06-20T20:51Z"), {90, 0});
  EXPECT_NEAR(sun.elevation_deg, 23.4361 + 0.038, 0.02);
}

TEST(SunPosition, SetsWhenAlmanacsSay) {
  // Equinox of 2024 (March 20, 03:06 UTC): at the equator and longitude 0 the sun's centre is seen on the
  // horizon about 18:07:30 - 2.3 min (refraction 34' = 2.27 minutes of time after 18:07:30 - 2.27...).
  // The equation of time is -7.4 minutes, so true sunset of the centre is at 18:07.4 UTC.
  const SunAngles sun = SunPosition(ParseTime("2024-03-20T18:07:26Z"), {0, 0});
  EXPECT_NEAR(sun.elevation_deg, 0.48, 0.1);  // refraction at the horizon
  EXPECT_NEAR(sun.azimuth_deg, 270.25, 0.1);
}

TEST(SunPosition, OffsetAndUtcAreTheSameMoment) {
  const SunAngles a = SunPosition(ParseTime("2026-01-01T00:30+02:00"), {52.5, 13.4});
  const SunAngles b = SunPosition(ParseTime("2025-12-31T22:30Z"), {52.5, 13.4});
  EXPECT_NEAR(a.elevation_deg, b.elevation_deg, 1e-4);
  EXPECT_NEAR(a.azimuth_deg, b.azimuth_deg, 1e-4);
}

TEST(SunPosition, RefusesWhatIsNoTimeOrPlace) {
  for (const char* text : {"", "2026", "2026-13-01T10:00", "2026-02-29T10:00", "2026-06-21 14:30", "2026-06-21T25:00", "2026-06-21T14:30+2",
                           "2026-06-21T14:30Zx", "2026-6-21T14:30", "2026-06-21T-1:30"}) {
    EXPECT_THROW(ParseTime(text), InputError) << text;
  }
  // No place is so far ahead or behind; a day that there is not is named.
  for (const char* text : {"2026-06-21T14:30+14:01", "2026-06-21T14:30+15:00", "2026-06-21T14:30-12:30"})
    EXPECT_THROW(ParseTime(text), InputError) << text;
  EXPECT_NEAR(ParseTime("2026-06-21T14:30+14:00").hours, 0.5, 1e-12);
  try {
    ParseTime("2026-02-30T12:00");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("30 is not in 1 … 28"), std::string::npos) << error.what();
  }
  for (const char* text : {"", "1", "1,", "91,0", "0,181", "a,b", "1,2,3", "nan,0"}) EXPECT_THROW(ParsePlace(text), InputError) << text;
}

}  // namespace
}  // namespace airsim360
