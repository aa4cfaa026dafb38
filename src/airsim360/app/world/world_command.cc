// airsim360 world export, import, entities: worlds in and out, and what they hold.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/app/flags/config_flags.h"
#include "airsim360/app/flags/session.h"
#include "airsim360/app/flags/world_flags.h"
#include "airsim360/app/world/world_make.h"
#include "airsim360/app/world/world_sheet.h"
#include "airsim360/assets/export/export.h"
#include "airsim360/base/error.h"
#include "airsim360/base/log.h"
#include "airsim360/dataset/rooms_json.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/scene/entity_table.h"
#include "airsim360/worlds/osm/osm_world.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct ExportArguments {
  std::string world, out;
};

void WriteGlb(const Scene& scene, const fs::path& out) {
  const Bytes bytes = EncodeGlb(scene);
  if (out.has_parent_path()) CreateWritableFolder(out.parent_path());
  WriteFileAtomically(out, bytes);
}

void RunExport(const ExportArguments& arguments, const GlobalOptions& globals) {
  const fs::path out = arguments.out;
  if (out.extension() != ".glb")
    throw InputError("--out: '" + arguments.out + "': worlds are exported as .glb; did you mean '" +
                     fs::path(out).replace_extension(".glb").string() + "'?");
  const auto scene = Stage(StageOptionsOf(arguments.world, globals)).shared_scene();
  WriteGlb(*scene, out);
  const SceneCounts counts = scene->Count();
  const uint64_t bytes = fs::file_size(out);
  if (globals.json) {
    PrintJson({{"out", out.string()},
               {"bytes", bytes},
               {"entities", counts.entities},
               {"instances", counts.instances},
               {"triangles", counts.unique_triangles}});
    return;
  }
  std::printf("%s: %.1f MB, %llu entities, %llu instances, %llu triangles\n", out.c_str(), static_cast<double>(bytes) / 1e6,
              static_cast<unsigned long long>(counts.entities), static_cast<unsigned long long>(counts.instances),
              static_cast<unsigned long long>(counts.unique_triangles));
}

struct ImportArguments {
  std::string file, out, heights;
  bool no_fill = false, buildings = false;
  ModelPlacement placement;
  std::string offset, light;
};

// Counts of what a map's buildings became.
Json BuildingsJson(const OsmReport& report, bool list) {
  std::map<std::string, int> kinds, sources;
  int parts = 0, shapeless = 0;
  Json rows = Json::array();
  for (const OsmBuildingReport& building : report.buildings) {
    if (building.part) {
      ++parts;
    } else {
      ++kinds[building.id.substr(0, building.id.find('/'))];
      ++sources[building.source];
      shapeless += building.area <= 0;
    }
    if (list)
      rows.push_back({{"id", building.id},
                      {"entity", building.entity},
                      {"height", building.height},
                      {"height_from", building.source},
                      {"area_m2", building.area}});
  }
  Json json{{"nodes", kinds["node"]},
            {"ways", kinds["way"]},
            {"relations", kinds["relation"]},
            {"parts_outside_buildings", parts},
            {"without_shape", shapeless},
            {"heights_from_tag", sources["tag"]},
            {"heights_from_levels", sources["levels"]},
            {"heights_guessed", sources["guess"]}};
  if (list) json["list"] = std::move(rows);
  return json;
}

Json CategoriesJson(const Scene& scene) {
  std::map<std::string, int> counts;
  for (const Entity& entity : scene.entities) ++counts[scene.tree[entity.category].path];
  Json json = Json::object();
  for (const auto& entry : counts) json[entry.first] = entry.second;
  return json;
}

// A world file that names the imported one, so that its settings need not be repeated.
std::string WorldFileOf(const ImportArguments& arguments, const GlobalOptions& globals, const fs::path& out) {
  const auto path = [&](const std::string& file) {
    std::error_code error;
    const fs::path folder = out.has_parent_path() ? out.parent_path() : fs::path(".");
    const fs::path relative = fs::relative(file, folder, error);
    return "'" + (error || relative.empty() ? fs::absolute(file) : relative).string() + "'";
  };
  std::string text = "world: " + path(arguments.file) + "\n";
  if (!arguments.heights.empty()) text += "heights: " + path(arguments.heights) + "\n";
  if (!globals.labels.empty()) text += "labels: " + path(globals.labels) + "\n";
  if (!globals.bbox.empty()) text += "bbox: '" + globals.bbox + "'\n";
  if (!globals.centre.empty()) text += "centre: '" + globals.centre + "'\nradius: " + nlohmann::json(globals.radius).dump() + "\n";
  if (arguments.no_fill) text += "fill: false\n";
  const ModelPlacement& placement = arguments.placement;
  const auto number = [](double v) {
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), "%.17g", v);
    return std::string(digits.data());
  };
  if (placement.scale) text += "scale: " + number(*placement.scale) + "\n";
  if (!placement.up.empty()) text += "up: " + placement.up + "\n";
  if (placement.ground) text += "ground: true\n";
  if (placement.baked) text += std::string("light: ") + (*placement.baked ? "baked" : "lit") + "\n";
  const Vec3d o = placement.offset;
  if (!(o == Vec3d{})) text += "offset: {x: " + number(o.x) + ", y: " + number(o.y) + ", z: " + number(o.z) + "}\n";
  return text;
}

bool IsBaked(const std::string& light) {
  static const std::vector<std::string> kLights = {"baked", "lit"};
  if (light != "baked" && light != "lit") throw InputError("--light: " + UnknownChoiceMessage("light", light, kLights));
  return light == "baked";
}

void RunImport(ImportArguments arguments, const GlobalOptions& globals) {
  if (!arguments.offset.empty()) {
    const std::vector<double> xyz = ParseNumbers("--offset", arguments.offset, 3, "x,y,z in metres");
    arguments.placement.offset = {xyz[0], xyz[1], xyz[2]};
  }
  if (!arguments.light.empty()) arguments.placement.baked = IsBaked(arguments.light);
  ValidatePlacement(arguments.placement, "--");
  fs::path out = arguments.out;
  if (!out.empty() && out.extension().empty()) out += ".yaml";
  if (!out.empty() && out.extension() != ".glb" && out.extension() != ".yaml")
    throw InputError("--out: '" + arguments.out + "': a .glb file, or a name or .yaml file for a world file");
  if (!fs::is_regular_file(arguments.file)) throw InputError(arguments.file + ": no such file");
  OsmReport report;
  std::shared_ptr<const Scene> scene;
  const bool map = IsOsmFile(arguments.file);
  WorldRequest request = RequestOf(arguments.file, globals);
  request.heights = arguments.heights;
  request.fill = !arguments.no_fill;
  request.placement = arguments.placement;
  if (map) {
    const LongTask reading("reading " + arguments.file);
    scene = LoadMap(request, &report);
  } else {
    scene = Stage({.world = request}).shared_scene();
  }
  if (out.extension() == ".glb") WriteGlb(*scene, out);
  if (out.extension() == ".yaml") {
    if (out.has_parent_path()) CreateWritableFolder(out.parent_path());
    WriteFileAtomically(out, std::string_view(WorldFileOf(arguments, globals, out)));
  }
  const SceneCounts counts = scene->Count();
  Json json{{"file", arguments.file},
            {"entities", counts.entities},
            {"instances", counts.instances},
            {"triangles", counts.unique_triangles},
            {"instanced_triangles", counts.instanced_triangles}};
  if (map) {
    json["origin"] = {{"latitude_deg", report.origin.latitude_deg},
                      {"longitude_deg", report.origin.longitude_deg},
                      {"altitude_m", report.origin.altitude}};
    json["extent_m"] = {report.width, report.depth};
    json["buildings"] = BuildingsJson(report, arguments.buildings);
  }
  json["categories"] = CategoriesJson(*scene);
  if (!out.empty()) json["out"] = out.string();
  if (globals.json) return PrintJson(json);
  std::printf("%s: %llu entities, %llu triangles (%llu with instances)\n", arguments.file.c_str(),
              static_cast<unsigned long long>(counts.entities), static_cast<unsigned long long>(counts.unique_triangles),
              static_cast<unsigned long long>(counts.instanced_triangles));
  if (map)
    std::printf("  %.0f x %.0f m around %.6f, %.6f; buildings %s\n", report.width, report.depth, report.origin.latitude_deg,
                report.origin.longitude_deg, BuildingsJson(report, false).dump().c_str());
  for (const auto& entry : json["categories"].items()) std::printf("  %6d %s\n", entry.value().get<int>(), entry.key().c_str());
  if (out.extension() == ".yaml") std::printf("use it as --world %s\n", out.c_str());
  if (out.empty()) std::printf("use it as --world %s\n", arguments.file.c_str());
}

struct EntitiesArguments {
  std::string world;
  bool csv = false;
};

std::string CsvText(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

void RunEntities(const EntitiesArguments& arguments, const GlobalOptions& globals) {
  const auto scene = Stage(StageOptionsOf(arguments.world, globals)).shared_scene();
  const std::vector<EntityRow> rows = EntityTable(*scene);
  if (globals.json) {
    Json list = Json::array();
    for (const EntityRow& row : rows) {
      const Quaternion q = ToQuaternion(row.X_WE.R);
      Json json{{"id", row.id},
                {"name", row.name},
                {"category", row.category},
                {"category_path", row.path},
                {"kind", row.thing ? "thing" : "stuff"},
                {"pose", {{"p", {row.X_WE.p.x, row.X_WE.p.y, row.X_WE.p.z}}, {"q_wxyz", {q.w, q.x, q.y, q.z}}}}};
      json["box"] = nullptr;
      if (row.has_box)
        json["box"] = {{"min", {row.box.min.x, row.box.min.y, row.box.min.z}}, {"max", {row.box.max.x, row.box.max.y, row.box.max.z}}};
      list.push_back(std::move(json));
    }
    return PrintJson(list);
  }
  if (arguments.csv) {
    std::printf("id,name,category,category_path,kind,x,y,z,qw,qx,qy,qz,min_x,min_y,min_z,max_x,max_y,max_z\n");
    for (const EntityRow& row : rows) {
      const Quaternion q = ToQuaternion(row.X_WE.R);
      std::printf("%u,%s,%u,%s,%s,%.3f,%.3f,%.3f,%.5f,%.5f,%.5f,%.5f", row.id, CsvText(row.name).c_str(), row.category, row.path.c_str(),
                  row.thing ? "thing" : "stuff", row.X_WE.p.x, row.X_WE.p.y, row.X_WE.p.z, q.w, q.x, q.y, q.z);
      if (row.has_box)
        std::printf(",%.3f,%.3f,%.3f,%.3f,%.3f,%.3f\n", static_cast<double>(row.box.min.x), static_cast<double>(row.box.min.y),
                    static_cast<double>(row.box.min.z), static_cast<double>(row.box.max.x), static_cast<double>(row.box.max.y),
                    static_cast<double>(row.box.max.z));
      else
        std::printf(",,,,,,\n");
    }
    return;
  }
  for (const EntityRow& row : rows)
    std::printf("%7u  %-44s %-40s %9.2f %9.2f %8.2f\n", row.id, row.name.c_str(), row.path.c_str(), row.X_WE.p.x, row.X_WE.p.y,
                row.X_WE.p.z);
}

void RunRooms(const std::string& world, const GlobalOptions& globals) {
  const auto building = RoomsOf(RequestOf(world, globals));
  if (!building) throw InputError("'" + world + "' is no building; rooms have apartment, office, warehouse, mall, car_park and building");
  if (globals.json) {
    std::fputs(RoomsJson(*building).c_str(), stdout);
    return;
  }
  for (const RoomOutline& room : building->rooms)
    std::printf("%4u  %-20s storey %d  %8.1f m2  height %.2f m  x %.2f … %.2f  y %.2f … %.2f\n", room.id, room.name.c_str(), room.storey,
                room.area_m2, static_cast<double>(room.ceiling_z - room.floor_z), static_cast<double>(room.corners[0].x),
                static_cast<double>(room.corners[2].x), static_cast<double>(room.corners[0].y), static_cast<double>(room.corners[2].y));
  const auto name = [&](uint32_t id) { return id == 0 ? "outside" : building->rooms[id - 1].name.c_str(); };
  for (const RoomDoor& door : building->doors)
    std::printf("%-12s %3u  %-6s %.2f x %.2f m at %.2f,%.2f,%.2f  %s - %s\n", door.kind.c_str(), door.id,
                door.open > 0.5 ? "open" : "closed", static_cast<double>(door.width), static_cast<double>(door.height),
                static_cast<double>(door.center.x), static_cast<double>(door.center.y), static_cast<double>(door.center.z),
                name(door.rooms[0]), name(door.rooms[1]));
}

constexpr const char* kWorldHelp = "name (airsim360 worlds) or path of a model, map or world .yaml";

}  // namespace

void AddWorldCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command =
      app.add_subcommand("world", "worlds in and out: world export, world import, world entities, world rooms, world sheet, world make");
  command->require_subcommand(1);
  CLI::App* to_file = command->add_subcommand("export", "write a world with its names and labels as binary glTF");
  auto arguments = std::make_shared<ExportArguments>();
  to_file->add_option("world", arguments->world, kWorldHelp)->required();
  to_file->add_option("--out", arguments->out, "the .glb file to write")->required();
  AddWorldFlags(*to_file, globals);
  to_file->callback([arguments, &globals] { RunExport(*arguments, globals); });

  CLI::App* from_file = command->add_subcommand("import", "read a map, city model or 3D model, and say what it holds");
  auto importing = std::make_shared<ImportArguments>();
  from_file->add_option("file", importing->file, "the file")->required();
  from_file->add_option("--out", importing->out, "FILE.glb: write it as glTF; NAME or FILE.yaml: write a world file that names it");
  AddWorldFlags(*from_file, globals);
  from_file->add_option("--heights", importing->heights, "maps: GeoTIFF with the heights of the ground (needs gdal-bin)");
  from_file->add_flag("--no-fill", importing->no_fill, "maps: add no parked cars, lamps and trees by rule; CityJSON: no facades");
  from_file->add_option("--scale", importing->placement.scale, "models: metres a unit of the file (0.01: it is in centimetres)");
  from_file->add_option("--up", importing->placement.up, "models: axis of the file that points up: x, y, z, -x, -y, -z");
  from_file->add_option("--offset", importing->offset, "models: x,y,z in metres to move it by");
  from_file->add_flag("--ground", importing->placement.ground, "models: stands on a plain at z = 0");
  from_file->add_option("--light", importing->light,
                        "models: baked: scanned rooms whose colours have their light in them; lit: sun, sky, lamps");
  from_file->add_flag("--buildings", importing->buildings, "maps: with --json, list every building with its height");
  from_file->callback([importing, &globals] { RunImport(*importing, globals); });

  CLI::App* entities = command->add_subcommand("entities", "the table of entities: id, name, category, pose, 3D box");
  auto table = std::make_shared<EntitiesArguments>();
  entities->add_option("world", table->world, kWorldHelp)->required();
  AddWorldFlags(*entities, globals);
  entities->add_flag("--csv", table->csv, "comma-separated values");
  entities->callback([table, &globals] { RunEntities(*table, globals); });
  CLI::App* rooms = command->add_subcommand("rooms", "rooms and doors of a building: outlines, heights, door states");
  auto of = std::make_shared<std::string>();
  rooms->add_option("world", *of, kWorldHelp)->required();
  AddWorldFlags(*rooms, globals);
  rooms->callback([of, &globals] { RunRooms(*of, globals); });
  CLI::App* sheet =
      command->add_subcommand("sheet", "a contact sheet: panoramas from many places and heights, with brightness and label figures");
  auto view = std::make_shared<SheetArguments>();
  sheet->add_option("world", view->world, "name (airsim360 worlds) or path of a model or world .yaml")->required();
  sheet->add_option("--out", view->out, "the .jpg or .png file to write")->required();
  sheet->add_option("--poses", view->poses, "places, 1 … 64 (16)");
  sheet->add_option("--heights", view->heights, "metres above the ground (1.6,12,40,100)")->delimiter(',');
  sheet->add_option("--width", view->width, "of one panorama in pixels (512)");
  AddConfigFlags(*sheet, [view](ConfigVisitor& v) { view->picture.Visit(v); });
  AddWorldFlags(*sheet, globals);
  sheet->callback([view, &globals] { RunWorldSheet(*view, globals); });
  CLI::App* make = command->add_subcommand("make", "a town or the inside of a building from words, as a world file");
  auto town = std::make_shared<MakeArguments>();
  make->add_option("words", town->words, "what town or building: \"a small coastal town with a church and a marina, 40 ha\"")->required();
  make->add_option("--out", town->out, "the world file to write, NAME.yaml")->required();
  make->callback([town, &globals] { RunWorldMake(*town, globals); });
}

}  // namespace airsim360
