#include "airsim360/flight/prompt/drone_file.h"

#include <gtest/gtest.h>

#include <cstring>

#include "airsim360/base/error.h"
#include "airsim360/flight/drones/catalog.h"
#include "airsim360/flight/drones/fleet.h"

namespace airsim360 {
namespace {

void ExpectSame(const DroneModel& a, const DroneModel& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.mass, b.mass);
  EXPECT_EQ(a.inertia_B, b.inertia_B);
  EXPECT_EQ(a.linear_drag_B, b.linear_drag_B);
  EXPECT_EQ(a.quadratic_drag_B, b.quadratic_drag_B);
  EXPECT_EQ(a.half_size_B, b.half_size_B);
  EXPECT_EQ(a.battery.cells, b.battery.cells);
  EXPECT_EQ(a.battery.capacity_ah, b.battery.capacity_ah);
  EXPECT_EQ(a.battery.resistance, b.battery.resistance);
  EXPECT_EQ(a.battery.efficiency, b.battery.efficiency);
  EXPECT_EQ(a.battery.idle_power, b.battery.idle_power);
  ASSERT_EQ(a.rotors.size(), b.rotors.size());
  static_assert(sizeof(RotorModel) == 18 * sizeof(double), "a new field of RotorModel goes into the file too");
  for (size_t i = 0; i < a.rotors.size(); ++i) {
    EXPECT_EQ(std::memcmp(&a.rotors[i], &b.rotors[i], sizeof(RotorModel)), 0) << i;
  }
}

TEST(DroneFile, ReadsBackBitForBit) {
  for (const char* prompt :
       {"a 250 g five-inch racing quad", "a coaxial X8 delivery drone of 15 kg", "a 5 kg hexacopter with a \"4S\" 5000 mAh battery"}) {
    std::string text(prompt);
    std::erase(text, '"');
    const DroneDesign design = DroneFromPrompt(text);
    ExpectSame(ReadDroneYaml(DroneYaml(design), "x.yaml").model, design.model);
  }
  for (const CatalogDrone& drone : DroneCatalog()) {
    const DroneModel model = CatalogModel(std::string(drone.name));
    ExpectSame(ReadDroneYaml(DroneYaml(model, drone.source), "x.yaml").model, model);
  }
  for (uint64_t id = 0; id < 20; ++id) {
    const DroneModel model = SampleDrone(3, id);
    ExpectSame(ReadDroneYaml(DroneYaml(model, ""), "x.yaml").model, model);
  }
}

TEST(DroneFile, TellsTheLawBesideEveryFigure) {
  const std::string yaml = DroneYaml(DroneFromPrompt("a 250 g five-inch racing quad"));
  EXPECT_NE(yaml.find("mass: 0.25"), std::string::npos);
  EXPECT_NE(yaml.find("# kg; said: '250 g'"), std::string::npos);
  EXPECT_NE(yaml.find("k_f = C_T rho D^4"), std::string::npos);
}

std::string FileError(const std::string& yaml) {
  try {
    ReadDroneYaml(yaml, "x.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(DroneFile, MistakesAreNamedWithTheirPlace) {
  const std::string good = DroneYaml(CatalogModel("agilicious"), "");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return FileError(text);
  };
  EXPECT_EQ(FileError(good), "no error");
  EXPECT_NE(with("mass: 0.752", "mas: 0.752").find("unknown key 'mas'; did you mean 'mass'?"), std::string::npos);
  EXPECT_NE(with("mass: 0.752", "mass: heavy").find("expected a number"), std::string::npos);
  EXPECT_NE(with("mass: 0.752", "mass: .nan").find("mass"), std::string::npos);
  EXPECT_NE(with("count: 4", "count: 2").find("3 to 8"), std::string::npos);
  EXPECT_NE(with("count: 4", "count: 3").find("unknown key 'rotor_4'"), std::string::npos);
  EXPECT_NE(with("direction: -1", "direction: 0.5").find("direction"), std::string::npos);
  EXPECT_NE(FileError("mass: 1\n").find("rotors"), std::string::npos);
}

}  // namespace
}  // namespace airsim360
