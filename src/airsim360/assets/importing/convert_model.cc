#include "airsim360/assets/importing/convert_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "airsim360/base/disk_cache.h"
#include "airsim360/base/error.h"
#include "airsim360/base/log.h"
#include "airsim360/base/process.h"

namespace airsim360::internal {
namespace {

namespace fs = std::filesystem;

constexpr double kSeconds = 300;

std::vector<std::string> BlenderWords(const fs::path& file, const ForeignFormat& format, const fs::path& out) {
  const std::string script = std::string("import bpy, sys\nf, out = sys.argv[-2:]\n") +
                             "bpy.ops.wm.read_factory_settings(use_empty=True)\n" + std::string(format.blender) +
                             "\nbpy.ops.export_scene.gltf(filepath=out, export_format='GLB', export_extras=True)\n";
  // Scripts inside .blend files do not run.
  return {"blender", "--background", "--factory-startup",         "--disable-autoexec", "--python-exit-code", "1", "--python-expr",
          script,    "--",           fs::absolute(file).string(), out.string()};
}

// The last words of a program's output that speak of an error, or the last words.
std::string Complaint(const fs::path& log) {
  std::string text, last;
  try {
    text = ReadTextFile(log, uint64_t{16} << 20);
  } catch (const InputError&) {
    return "it said nothing";
  }
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = CleanName(text.substr(begin, end - begin));
    const bool error = line.find("rror") != std::string::npos || line.find("ERROR") != std::string::npos;
    if (!line.empty() && (error || last.find("rror") == std::string::npos)) last = line;
    begin = end + 1;
  }
  return last.empty() ? "it said nothing" : last;
}

CacheKey KeyOf(const fs::path& file, const std::string& tool, const fs::path& program) {
  CacheKey key("converted_model", 1);
  key.Add(tool).AddFile(program).Add(file.extension().string()).Add(ReadFile(file));
  // What the model may refer to.
  constexpr size_t kMostFiles = 4096;
  constexpr int kDeep = 2;
  std::vector<fs::path> beside;
  std::error_code error;
  fs::recursive_directory_iterator it(fs::absolute(file).parent_path(), error);
  for (; !error && it != fs::recursive_directory_iterator() && beside.size() < kMostFiles; it.increment(error)) {
    if (it.depth() >= kDeep) it.disable_recursion_pending();
    if (it->is_regular_file(error)) beside.push_back(it->path());
  }
  std::sort(beside.begin(), beside.end());
  for (const fs::path& path : beside) key.AddFile(path);
  return key;
}

}  // namespace

ConvertedModel ConvertModel(const fs::path& file, const ForeignFormat& format) {
  const Bytes source = ReadFile(file);  // a missing file is said first
  std::string complaints;
  for (const std::string tool : {"blender", "assimp"}) {
    const bool is_blender = tool == "blender";
    if (is_blender ? format.blender.empty() : !format.assimp) continue;
    const auto program = FindProgram(tool);
    if (!program) continue;

    ConvertedModel out;
    if (!is_blender) {
      out.up_z = format.assimp_up_z;
      out.scale = format.extension == ".fbx" ? FbxUnit(source) : format.assimp_scale;
    }
    const CacheKey key = KeyOf(file, tool, *program);
    const DiskCache cache = DiskCache::OfUser();
    if (const auto kept = cache.Load(key)) {
      LogInfo(file.string() + ": as " + tool + " converted it before");
      out.glb.assign(kept->bytes().begin(), kept->bytes().end());
      return out;
    }
    const ScratchFolder scratch("model");
    const fs::path glb = scratch.path() / "model.glb", log = scratch.path() / "log";
    LogInfo(file.string() + ": converting through " + tool);
    const auto words =
        is_blender ? BlenderWords(file, format, glb) : std::vector<std::string>{tool, "export", fs::absolute(file).string(), glb.string()};
    const auto end = RunProgram(words, {.out = log, .complaints = log, .seconds = kSeconds});
    if (end && !end->timed_out && end->status == 0 && fs::is_regular_file(glb)) {
      out.glb = ReadFile(glb);
      if (!cache.folder().empty()) cache.Store(key, out.glb);
      return out;
    }
    complaints +=
        (complaints.empty() ? "" : "; ") + tool + (end && end->timed_out ? " took longer than 300 s" : " failed: " + Complaint(log));
  }
  if (complaints.empty()) throw InputError(UnreadMessage(file));
  throw InputError(file.string() + ": cannot be converted: " + complaints);
}

ResourceLoader SearchingLoader(const fs::path& model) {
  const ResourceLoader beside = FolderLoader(model.string(), model.parent_path());
  const std::string stem = model.stem().string();
  return [=](const std::string& name) -> std::optional<Bytes> {
    std::string path = name;
    std::replace(path.begin(), path.end(), '\\', '/');
    const std::string bare = path.substr(path.rfind('/') + 1);
    if (bare.empty() || bare == "." || bare == "..") return std::nullopt;
    const bool plain = path[0] != '/' && path.find(':') == std::string::npos && ("/" + path).find("/..") == std::string::npos;
    if (plain) {
      if (auto bytes = beside(path)) return bytes;
    }
    for (const std::string folder : {"", "textures/", "Textures/", "texture/", "tex/", "images/", "maps/"}) {
      if (auto bytes = beside(folder + bare)) return bytes;
    }
    return beside(stem + ".fbm/" + bare);
  };
}

double FbxUnit(std::span<const std::byte> fbx) {
  // Binary: the name, then "double", "Number", "", 'D' and eight bytes; as text: …, "",2.54
  constexpr double kCentimetre = 0.01;
  const std::string_view text = AsText(fbx);
  const size_t name = text.find("\"UnitScaleFactor\"");
  double factor = 0;
  if (name != std::string_view::npos) {
    const std::string line(text.substr(name, std::min(text.find('\n', name), text.size()) - name).substr(0, 200));
    factor = std::atof(line.c_str() + std::min(line.rfind(',') + 1, line.size()));
  } else if (const size_t at = text.find("UnitScaleFactor"); at != std::string_view::npos) {
    const std::string_view rest = text.substr(at, 80);
    const size_t number = rest.find("Number");
    const size_t mark = number == std::string_view::npos ? number : rest.find('D', number);
    if (mark != std::string_view::npos && mark + 9 <= rest.size()) std::memcpy(&factor, rest.data() + mark + 1, sizeof factor);
  }
  return factor >= 1e-4 && factor <= 1e6 ? kCentimetre * factor : kCentimetre;
}

}  // namespace airsim360::internal
