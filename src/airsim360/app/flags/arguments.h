// Values of flags that several commands share, and the JSON they print.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/app/flags/commands.h"
#include "airsim360/dataset/record/camera_choice.h"
#include "airsim360/flight/drone_model.h"
#include "airsim360/math/vector.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {

/// "x,y,z[,yaw_deg[,pitch_deg[,roll_deg]]]": metres and degrees, finite. InputError naming `--pose` and the
/// value.
struct PoseArgument {
  Vec3d p;
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
};
PoseArgument ParsePose(const std::string& text);

/// "a,b,c" split; InputError naming `flag` for an entry that is not among `choices`.
std::vector<std::string> ParseList(std::string_view flag, const std::string& text, const std::vector<std::string>& choices);

/// "I/N", 0 <= I < N; InputError naming `--shard` otherwise.
struct Shard {
  int64_t index = 0, count = 1;
};
Shard ParseShard(const std::string& text);

/// `value`; InputError naming the flag unless it is a finite number above zero.
double CheckPositive(const char* flag, double value);

/// "a,b,…": exactly `count` finite numbers; InputError "flag: 'text' is not `form`" otherwise.
std::vector<double> ParseNumbers(const char* flag, const std::string& text, size_t count, const char* form);

/// A name of the catalogue, a drone .yaml, or words. InputError naming what is wrong with it.
DroneModel FindDrone(const std::string& text);

/// What meta.json says of --labels: "sha256:…" of the file, "" without one. InputError if it cannot be read.
std::string DescribeLabels(const GlobalOptions& globals);

/// Prints one JSON object on stdout.
void PrintJson(const nlohmann::ordered_json& value);

/// Largest resident memory of this process so far, MiB.
double PeakRssMib();

}  // namespace airsim360
