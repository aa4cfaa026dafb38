#include "airsim360/assets/importing/foreign_format.h"

#include <algorithm>
#include <cctype>

namespace airsim360::internal {
namespace {

constexpr std::string_view kUsd = "bpy.ops.wm.usd_import(filepath=f)";
constexpr std::string_view kX3d = "bpy.ops.import_scene.x3d(filepath=f)";
constexpr std::string_view kStl = "(bpy.ops.wm.stl_import if bpy.app.version >= (4, 2) else bpy.ops.import_mesh.stl)(filepath=f)";
constexpr std::string_view kPoints =
    "it holds points without surfaces: make a mesh of it (MeshLab, CloudCompare: Poisson reconstruction) and save "
    "that as .ply or .glb";
constexpr std::string_view kSplats = "Gaussian splats have no surfaces; export a mesh (.ply, .glb) of the capture";
constexpr std::string_view kRaster =
    "heights of the ground go beside a map: 'world import MAP.osm.pbf --heights FILE.tif' (GDAL's gdal_translate "
    "makes a GeoTIFF of them)";
constexpr std::string_view kVector = "maps are read as OpenStreetMap extracts (.osm, .osm.pbf), city models as CityJSON (.city.json)";
constexpr std::string_view kOwnProgram = "export it as .glb from the program that made it";
constexpr std::string_view kCad = "FreeCAD opens it and exports .gltf or .obj";
constexpr std::string_view kPacked = "unpack it first and name the model inside";

constexpr ForeignFormat kForeign[] = {
    // extension, what, Blender, assimp, advice, assimp: +Z up, metres a unit
    {".fbx", "Autodesk FBX", "bpy.ops.import_scene.fbx(filepath=f)", true, {}},
    {".dae", "Collada", "bpy.ops.wm.collada_import(filepath=f)", true, {}},
    {".blend", "a Blender file", "bpy.ops.wm.open_mainfile(filepath=f)", false, {}},
    {".usd", "Universal Scene Description", kUsd, false, {}},
    {".usda", "Universal Scene Description", kUsd, false, {}},
    {".usdc", "Universal Scene Description", kUsd, false, {}},
    {".usdz", "Universal Scene Description", kUsd, false, {}},
    {".stl", "an STL mesh", kStl, true, {}, true},
    {".3ds", "3D Studio", {}, true, {}},
    {".ifc", "an IFC building model", {}, true, {}},
    {".3mf", "a 3MF model for printing", {}, true, {}, true, 0.001},
    {".off", "an OFF mesh", {}, true, {}, true},
    {".x3d", "X3D", kX3d, true, {}},
    {".wrl", "VRML", kX3d, false, {}},
    {".abc", "Alembic", "bpy.ops.wm.alembic_import(filepath=f)", false, {}},
    {".lwo", "LightWave", {}, true, {}},
    {".b3d", "Blitz3D", {}, true, {}},
    {".ms3d", "MilkShape 3D", {}, true, {}},
    {".ac", "AC3D", {}, true, {}},
    {".ase", "3D Studio ASCII", {}, true, {}},
    {".x", "DirectX", {}, true, {}},
    {".pnts", "a point cloud of 3D Tiles", {}, false, kPoints},
    {".i3dm", "an instanced tile of 3D Tiles", {}, false, "name its tileset.json, or the .glb that it instances"},
    {".las", "a LAS point cloud", {}, false, kPoints},
    {".laz", "a LAZ point cloud", {}, false, kPoints},
    {".e57", "an E57 point cloud", {}, false, kPoints},
    {".pcd", "a PCD point cloud", {}, false, kPoints},
    {".xyz", "a list of points", {}, false, kPoints},
    {".splat", "Gaussian splats", {}, false, kSplats},
    {".ksplat", "Gaussian splats", {}, false, kSplats},
    {".spz", "Gaussian splats", {}, false, kSplats},
    {".hgt", "SRTM heights", {}, false, kRaster},
    {".tif", "a GeoTIFF raster", {}, false, kRaster},
    {".tiff", "a GeoTIFF raster", {}, false, kRaster},
    {".asc", "a grid of heights", {}, false, kRaster},
    {".geojson", "GeoJSON", {}, false, kVector},
    {".kml", "Google's KML", {}, false, kVector},
    {".kmz", "Google's KMZ", {}, false, kVector},
    {".shp", "an ESRI shapefile", {}, false, kVector},
    {".gpkg", "a GeoPackage", {}, false, kVector},
    {".gml", "CityGML", {}, false, "citygml-tools makes CityJSON of it: 'citygml-tools to-cityjson FILE.gml'"},
    {".xodr", "OpenDRIVE", {}, false, kVector},
    {".skp", "SketchUp", {}, false, kOwnProgram},
    {".max", "3ds Max", {}, false, kOwnProgram},
    {".ma", "Maya", {}, false, kOwnProgram},
    {".mb", "Maya", {}, false, kOwnProgram},
    {".c4d", "Cinema 4D", {}, false, kOwnProgram},
    {".rvt", "Revit", {}, false, kOwnProgram},
    {".3dm", "Rhinoceros", {}, false, kOwnProgram},
    {".uasset", "an Unreal asset", {}, false, "docs/guide/unreal.md says how a level is exported"},
    {".umap", "an Unreal level", {}, false, "docs/guide/unreal.md says how a level is exported"},
    {".step", "a STEP drawing", {}, false, kCad},
    {".stp", "a STEP drawing", {}, false, kCad},
    {".iges", "an IGES drawing", {}, false, kCad},
    {".igs", "an IGES drawing", {}, false, kCad},
    {".dxf", "a DXF drawing", {}, false, kCad},
    {".dwg", "a DWG drawing", {}, false, kCad},
    {".mtl", "materials of an OBJ model", {}, false, "name the .obj itself"},
    {".bin", "data of a glTF model", {}, false, "name the .gltf itself"},
    {".zip", "an archive", {}, false, kPacked},
    {".7z", "an archive", {}, false, kPacked},
    {".rar", "an archive", {}, false, kPacked},
    {".gz", "a packed file", {}, false, kPacked},
};

std::string Join(const std::string& a, std::string_view b) { return a + std::string(b); }

}  // namespace

std::string LowerExtension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

const ForeignFormat* FindForeignFormat(std::string_view extension) {
  const auto* found =
      std::find_if(std::begin(kForeign), std::end(kForeign), [&](const ForeignFormat& format) { return format.extension == extension; });
  return found == std::end(kForeign) ? nullptr : found;
}

std::string ReadFormats() {
  return ".glb, .gltf, .obj, .ply, tileset.json, .b3dm, .city.json, .jsonl, .osm, .osm.pbf, and world files (.yaml)";
}

std::string UnreadMessage(const std::filesystem::path& file) {
  const std::string extension = LowerExtension(file), name = file.string() + ": ";
  const ForeignFormat* format = FindForeignFormat(extension);
  if (!format) {
    return name + (extension.empty() ? "a file without extension" : "'" + extension + "'") +
           " is no format of models or maps that is known; read are " + ReadFormats();
  }
  if (!format->advice.empty()) {
    return Join(Join(name, format->what), " (" + extension + ") is not read; ") + std::string(format->advice) + "; read are " +
           ReadFormats();
  }
  const bool blender = !format->blender.empty();
  std::string tools =
      blender && format->assimp ? "Blender or assimp, neither of which is" : std::string(blender ? "Blender" : "assimp") + ", which is not";
  std::string install;
  if (format->assimp) install += "'apt install assimp-utils'";
  if (blender) install += std::string(install.empty() ? "" : " or ") + "'apt install blender'";
  return Join(Join(name, format->what), " (" + extension + ") is read through " + tools + " installed: ") + install +
         ", or save it as .glb; read without them are " + ReadFormats();
}

}  // namespace airsim360::internal
