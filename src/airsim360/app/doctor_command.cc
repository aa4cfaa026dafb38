// airsim360 doctor: what this machine has, what is missing and the command that fixes it.
#include <cstdio>
#include <filesystem>
#include <thread>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/base/parallel.h"
#include "airsim360/dataset/record/version.h"
#include "airsim360/render/vulkan/gpu.h"
#include "airsim360/video/video_writer.h"

namespace airsim360 {
namespace {

struct Check {
  std::string name;
  bool present;
  std::string detail;
  std::string fix;  // command; empty when present or when nothing fixes it
};

bool Exists(const char* path) {
  std::error_code error;
  return std::filesystem::exists(path, error);
}

const char* InstructionSet() {
  if (__builtin_cpu_supports("avx512f")) return "AVX-512";
  if (__builtin_cpu_supports("avx2")) return "AVX2";
  return "SSE2: tracing is several times slower than with AVX2";
}

// What --device vulkan and --gpu would find.
Check CheckGpus() {
  std::string why, list;
  bool usable = false;
  for (const GpuInfo& gpu : ListGpus(&why)) {
    usable |= gpu.missing.empty();
    list += (list.empty() ? "" : "; ") + std::to_string(gpu.index) + " = " + gpu.name + " (" + gpu.driver + ")" +
            (gpu.software ? ", software" : "") + (gpu.missing.empty() ? "" : ", cannot trace rays: " + gpu.missing);
  }
  return {"gpu", usable, list.empty() ? why : list,
          usable ? "" : "sudo apt-get install -t bookworm-backports mesa-vulkan-drivers  # in software"};
}

std::vector<Check> RunChecks() {
  const bool models = Exists("/usr/share/sweethome3d/furniture");
  const bool ffmpeg = HasFfmpeg();
  const bool exiftool = Exists("/usr/bin/exiftool");
  return {
      {"airsim360", true, kVersion, ""},
      {"threads", true, std::to_string(ThreadCount()) + " of " + std::to_string(std::thread::hardware_concurrency()), ""},
      {"instruction set", true, InstructionSet(), ""},
      CheckGpus(),
      {"sweethome3d-furniture", models, "furniture and vehicles of the worlds; without it procedural ones are used",
       models ? "" : "sudo apt-get install sweethome3d-furniture"},
      {"ffmpeg", ffmpeg, "360 degree videos: fly --video, collect --format video, video", ffmpeg ? "" : "sudo apt-get install ffmpeg"},
      {"exiftool", exiftool, "only to look at the GPano metadata of pictures",
       exiftool ? "" : "sudo apt-get install libimage-exiftool-perl"},
  };
}

void RunDoctor(bool json) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Check& check : RunChecks()) {
    list.push_back({{"name", check.name}, {"present", check.present}, {"detail", check.detail}, {"fix", check.fix}});
    if (json) continue;
    std::printf("%-8s %-22s %s\n", check.present ? "ok" : "missing", check.name.c_str(), check.detail.c_str());
    if (!check.fix.empty()) std::printf("         %-22s %s\n", "", check.fix.c_str());
  }
  if (json) PrintJson(list);
}

}  // namespace

void AddDoctorCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command = app.add_subcommand("doctor", "what is installed, what is missing and the command that fixes it");
  command->callback([&globals] { RunDoctor(globals.json); });
}

}  // namespace airsim360
