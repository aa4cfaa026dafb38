// airsim360 world export: a world as a model file.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "airsim360/app/arguments.h"
#include "airsim360/app/commands.h"
#include "airsim360/app/world_sheet.h"
#include "airsim360/assets/export.h"
#include "airsim360/base/error.h"
#include "airsim360/sim/world_loader.h"

namespace airsim360 {
namespace {

struct ExportArguments {
  std::string world, out;
};

void RunExport(const ExportArguments& arguments, const GlobalOptions& globals) {
  const std::filesystem::path out = arguments.out;
  if (out.extension() != ".glb")
    throw InputError("--out: '" + arguments.out + "': worlds are exported as .glb; did you mean '" +
                     std::filesystem::path(out).replace_extension(".glb").string() + "'?");
  const auto scene = LoadWorld({.world = arguments.world, .seed = globals.seed});
  const Bytes bytes = EncodeGlb(*scene);
  if (out.has_parent_path()) CreateWritableFolder(out.parent_path());
  WriteFileAtomically(out, bytes);
  const SceneCounts counts = scene->Count();
  if (globals.json) {
    PrintJson({{"out", out.string()},
               {"bytes", bytes.size()},
               {"entities", counts.entities},
               {"instances", counts.instances},
               {"triangles", counts.unique_triangles}});
    return;
  }
  std::printf("%s: %.1f MB, %llu entities, %llu instances, %llu triangles\n", out.c_str(),
              static_cast<double>(bytes.size()) / 1e6, static_cast<unsigned long long>(counts.entities),
              static_cast<unsigned long long>(counts.instances),
              static_cast<unsigned long long>(counts.unique_triangles));
}

}  // namespace

void AddWorldCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command = app.add_subcommand(
      "world", "worlds in and out: world export WORLD --out FILE.glb, world sheet WORLD --out FILE.jpg");
  command->require_subcommand(1);
  CLI::App* to_file =
      command->add_subcommand("export", "write a world with its names and labels as binary glTF");
  auto arguments = std::make_shared<ExportArguments>();
  to_file->add_option("world", arguments->world, "name (airsim360 worlds) or path of a model or world .yaml")
      ->required();
  to_file->add_option("--out", arguments->out, "the .glb file to write")->required();
  to_file->callback([arguments, &globals] { RunExport(*arguments, globals); });

  CLI::App* sheet = command->add_subcommand(
      "sheet", "a contact sheet: panoramas from many places and heights, with brightness and label figures");
  auto view = std::make_shared<SheetArguments>();
  sheet->add_option("world", view->world, "name (airsim360 worlds) or path of a model or world .yaml")
      ->required();
  sheet->add_option("--out", view->out, "the .jpg or .png file to write")->required();
  sheet->add_option("--poses", view->poses, "places, 1 … 64 (16)");
  sheet->add_option("--heights", view->heights, "metres above the ground (1.6,12,40,100)")->delimiter(',');
  sheet->add_option("--width", view->width, "of one panorama in pixels (512)");
  sheet->add_option("--tier", view->tier, "labels, fast, high or reference (fast)");
  sheet->callback([view, &globals] { RunWorldSheet(*view, globals); });
}

}  // namespace airsim360
