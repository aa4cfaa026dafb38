// Worlds: what they hold, rays into them, pictures of them.
#include <algorithm>
#include <filesystem>

#include "airsim360/assets/export/export.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/parallel.h"
#include "airsim360/opening/world_loader.h"
#include "airsim360/scene/viewpoint.h"
#include "airsim360/sensors/surface_label.h"
#include "airsim360/worlds/worlds.h"
#include "handles.h"
#include "interrupts.h"

namespace airsim360::python {

std::shared_ptr<const EntityLabels> World::labels() {
  const std::lock_guard lock(labels_mutex_);
  return labels_;
}

size_t World::Relabel(const std::vector<LabelPattern>& patterns, std::vector<std::string>& unused) {
  size_t changed = 0;
  const std::lock_guard lock(labels_mutex_);
  labels_ = std::make_shared<const EntityLabels>(LabelEntities(scene(), labels_.get(), patterns, changed, &unused));
  return changed;
}

std::shared_ptr<Capture> World::Render(const Rig& rig, const Kinematics& body) {
  const std::lock_guard lock(render_mutex_);
  auto capture = std::make_shared<Capture>();
  const auto named = labels();
  PanoramicRig rendered = Rendered(rig, named.get());
  rendered.state = stage_->StartState();
  CaptureRig(rendered, body, 0, stage_->renderer(rig.rig.tier), *capture);
  FinishCapture(rig, scene(), named.get(), *capture);
  return capture;
}

std::shared_ptr<LidarScan> World::Scan(const Lidar& lidar, const Kinematics& body) {
  auto scan = std::make_shared<LidarScan>();
  ScanLidar(lidar.spec, {}, *stage_->tracer(), body, lidar.X_BS, 0, *scan);
  FinishScan(labels().get(), *scan);
  return scan;
}

namespace {

// A body that stands still.
Kinematics Standing(const py::object& position, double yaw, double pitch, double roll) {
  return {BodyPose(ToVec3(position, "position"), Finite(yaw, "yaw"), Finite(pitch, "pitch"), Finite(roll, "roll")), {}, {}};
}

py::array_t<double> BoundsOf(const Box3f& box) { return FromPoints({VecCast<double>(box.min), VecCast<double>(box.max)}); }

}  // namespace

PeopleRequest PeopleOf(int64_t count, uint64_t seed) {
  if (count < 0 || count > kMostPeople)
    throw InputError("people: " + std::to_string(count) + " is not in 0 ... " + std::to_string(kMostPeople));
  PeopleRequest request{.seed = seed};
  if (count > 0) request.count = static_cast<size_t>(count);
  return request;
}

py::list EntitiesOf(const Scene& scene, const EntityLabels* labels) {
  py::list list;
  for (const Entity& entity : scene.entities) {
    const CategoryId id = labels ? labels->Of(entity.id, entity.category) : entity.category;
    const Category& category = (id == entity.category ? scene.tree : labels->tree)[id];
    py::dict d;
    d["id"] = entity.id;
    d["name"] = entity.name;
    d["category"] = id;
    d["category_path"] = category.path;
    d["kind"] = category.thing ? "thing" : "stuff";
    d["bounds"] = entity.bounds.empty() ? py::object(py::none()) : BoundsOf(entity.bounds);
    list.append(std::move(d));
  }
  return list;
}

namespace {

// One number for one point, else one for each.
template <class T>
py::array_t<T> OneOrMany(size_t count, bool one) {
  return one ? py::array_t<T>(std::vector<py::ssize_t>{}) : py::array_t<T>(static_cast<py::ssize_t>(count));
}

py::tuple Raycast(World& world, const py::object& origins, const py::object& directions) {
  const PointOrPoints from = ToPointOrPoints(origins, "origins"), along = ToPointOrPoints(directions, "directions");
  const size_t many = from.points.size(), ways = along.points.size();
  if (many != ways && many != 1 && ways != 1)
    throw InputError("raycast: " + std::to_string(many) + " origins and " + std::to_string(ways) + " directions");
  const size_t n = many == 1 ? ways : many;
  py::array_t<float> range = OneOrMany<float>(n, from.one && along.one);
  py::array_t<EntityId> entity = OneOrMany<EntityId>(n, from.one && along.one);
  float* ranges = range.mutable_data();
  EntityId* entities = entity.mutable_data();
  {
    const py::gil_scoped_release release;
    const auto tracer = world.stage()->solid();
    const Scene& scene = world.scene();
    constexpr size_t kRaysPerTask = 256;
    ParallelFor(static_cast<int64_t>((n + kRaysPerTask - 1) / kRaysPerTask), [&](int64_t task) {
      const size_t first = static_cast<size_t>(task) * kRaysPerTask;
      for (size_t i = first; i < std::min(n, first + kRaysPerTask); ++i) {
        const Vec3d p = from.points[many == 1 ? 0 : i], way = along.points[ways == 1 ? 0 : i];
        const double length = Norm(way);
        const auto hit = length > 0 ? tracer->Intersect(VecCast<float>(p), VecCast<float>(way / length)) : std::nullopt;
        ranges[i] = hit ? hit->distance : 0;
        entities[i] = scene.sky_entity;
        if (hit) entities[i] = LabelOf(*tracer, hit->surface).entity;
      }
    });
  }
  return py::make_tuple(range, entity);
}

py::array_t<float> Clearance(World& world, const py::object& points, float most) {
  const PointOrPoints places = ToPointOrPoints(points, "points");
  py::array_t<float> distance = OneOrMany<float>(places.points.size(), places.one);
  float* out = distance.mutable_data();
  const py::gil_scoped_release release;
  const auto tracer = world.stage()->solid();
  ParallelFor(static_cast<int64_t>(places.points.size()),
              [&](int64_t i) { out[i] = tracer->Clearance(VecCast<float>(places.points[static_cast<size_t>(i)]), most); });
  return distance;
}

void ExportWorld(const World& world, const std::string& path) {
  const std::filesystem::path file(path);
  if (file.extension() != ".glb")
    throw InputError("path: '" + path + "': worlds are written as .glb (binary glTF); did you mean '" +
                     std::filesystem::path(file).replace_extension(".glb").string() + "'?");
  WriteFileAtomically(path, EncodeGlb(world.scene()));
}

py::list ListOfWorlds() {
  py::list list;
  for (const WorldInfo& info : ListWorlds()) {
    py::dict d;
    d["name"] = info.name;
    d["setting"] = info.setting;
    d["area_m2"] = info.area_m2;
    d["categories"] = info.categories;
    d["description"] = info.description;
    list.append(std::move(d));
  }
  return list;
}

py::list Gpus() {
  py::list list;
  for (const GpuInfo& gpu : ListGpus()) {
    py::dict d;
    d["index"] = gpu.index;
    d["name"] = gpu.name;
    d["driver"] = gpu.driver;
    d["software"] = gpu.software;
    d["missing"] = gpu.missing;
    d["uuid"] = py::bytes(reinterpret_cast<const char*>(gpu.uuid.data()), gpu.uuid.size());
    list.append(std::move(d));
  }
  return list;
}

// A number of people, or the file that describes them.
PeopleRequest ToPeople(const py::object& people, uint64_t seed) {
  if (py::isinstance<py::int_>(people)) return PeopleOf(ToWhole(people, "people", 0, kMostPeople), seed);
  PeopleRequest request{.seed = seed};
  request.file = py::str(people).cast<std::string>();
  return request;
}

// Mistakes are told by the names that Python gives.
void CheckOptions(const StageOptions& options) {
  try {
    CheckStageOptions(options);
  } catch (const InputError& error) {
    const std::string text = error.what();
    throw InputError(text.starts_with("--") ? text.substr(2) : text);
  }
}

TrafficRequest ToTraffic(int64_t count, uint64_t seed) {
  if (count < 0 || count > 20000) throw InputError("traffic: " + std::to_string(count) + " is not in 0 ... 20000");
  return {.count = static_cast<size_t>(count), .seed = seed};
}

std::shared_ptr<World> OpenWorld(const std::string& name, const py::object& given_seed, bool models, const std::string& labels,
                                 const std::string& device, int gpu, const std::string& weather, const std::string& sun,
                                 const std::string& time, const std::string& place, const std::string& hdri, const std::string& environment,
                                 const std::string& clouds, const std::string& sky_seed, const std::string& bbox, const std::string& centre,
                                 double radius, const py::object& people, const std::string& wind, int64_t traffic) {
  const uint64_t seed = ToSeed(given_seed);
  StageOptions options{.world = {.world = name, .seed = seed, .labels = labels, .use_models = models},
                       .environment = {weather, sun, time, place, hdri, environment, clouds, sky_seed},
                       .people = ToPeople(people, seed),
                       .traffic = ToTraffic(traffic, seed),
                       .device = {device, gpu}};
  options.world.cut = MapCutOf("", bbox, centre, radius);
  options.wind = ReadWindFile(wind);
  CheckOptions(options);
  const py::gil_scoped_release release;
  return std::make_shared<World>(options);
}

using WorldClass = py::class_<World, std::shared_ptr<World>>;

size_t Relabel(World& w, const py::dict& labels) {
  std::vector<LabelPattern> patterns;
  for (const auto& [pattern, category] : labels) {
    if (!py::isinstance<py::str>(pattern) || !py::isinstance<py::str>(category))
      throw InputError("relabel: give a dictionary of name pattern -> category path");
    patterns.push_back({pattern.cast<std::string>(), category.cast<std::string>()});
  }
  std::vector<std::string> unused;
  const size_t changed = w.Relabel(patterns, unused);
  for (const std::string& pattern : unused) {
    if (PyErr_WarnEx(PyExc_UserWarning, ("relabel: '" + pattern + "' matches no entity").c_str(), 1) < 0) throw py::error_already_set();
  }
  return changed;
}

// What is in it.
void BindContent(WorldClass& world) {
  world
      .def("__repr__",
           [](const World& w) {
             const SceneCounts counts = w.scene().Count();
             return Text("World(%s: %zu entities, %zu triangles, device %s)", w.name().c_str(), static_cast<size_t>(counts.entities),
                         static_cast<size_t>(counts.instanced_triangles), w.stage()->device().device.c_str());
           })
      .def_property_readonly(
          "device", [](const World& w) { return w.stage()->device().device; }, "What draws its pictures: cpu or vulkan.")
      .def_property_readonly("name", &World::name, "Name or path that it was opened by.")
      .def_property_readonly(
          "entities", [](World& w) { return EntitiesOf(w.scene(), w.labels().get()); },
          "Entities by id (ids begin at 1): dictionaries with id, name, category, category_path, kind, "
          "bounds ((2, 3) metres in W, or None for the sky).")
      .def_property_readonly(
          "categories",
          [](World& w) {
            py::dict d;
            const auto labels = w.labels();
            for (const auto& [id, category] : (labels ? labels->tree : w.scene().tree).categories()) d[py::int_(id)] = category.path;
            return d;
          },
          "Category id -> path.")
      .def("relabel", &Relabel, py::arg("labels"),
           "Categories by patterns of entity names ({'node/22*': 'furniture/misc'}; * any characters, ? one; the first that matches "
           "counts; paths that the tree lacks are added), from the next capture or scan on, in this world and its simulations. "
           "Returns how many entities match; a pattern that matches none gives a UserWarning.")
      .def_property_readonly(
          "bounds", [](const World& w) { return BoundsOf(w.scene().bounds); }, "(2, 3) least and greatest corner in W, metres.")
      .def_property_readonly(
          "spawn", [](const World& w) { return FromVec3(VecCast<double>(FirstViewpoint(w.scene()))); },
          "(3,) a good first viewpoint in W, metres.")
      .def_property_readonly(
          "triangles", [](const World& w) { return w.scene().Count().instanced_triangles; },
          "Triangles, those of every copy of a mesh counted.");
}

// What rays, a rig and a lidar meet.
void BindSensing(WorldClass& world) {
  world
      .def("raycast", &Raycast, py::arg("origins"), py::arg("directions"),
           "Nearest surfaces along rays: origins and directions in W, (3,) or (N, 3), one for all or one each -> range (N,) "
           "float32 metres (0 = nothing), entity (N,) uint32; arrays of no dimension for one ray.")
      .def("clearance", &Clearance, py::arg("points"), py::arg("most") = 100.0f,
           "Distance (N,) float32 from points (N, 3) of W to the nearest surface, at most `most` metres; of no dimension for (3,).")
      .def("export", &ExportWorld, py::arg("path"), py::call_guard<py::gil_scoped_release>(),
           "Writes the world as binary glTF (.glb); ValueError for a path of another ending.")
      .def(
          "capture",
          [](World& w, const py::object& position, const Rig& rig, double yaw, double pitch, double roll) {
            const Kinematics body = Standing(position, yaw, pitch, roll);
            const py::gil_scoped_release release;
            return TakeWatched(PixelsOf(rig), [&] { return w.Render(rig, body); });
          },
          py::arg("position"), py::arg_v("rig", DefaultRig(), "Rig()"), py::arg("yaw") = 0.0, py::arg("pitch") = 0.0, py::arg("roll") = 0.0,
          "A capture by a body that stands still at `position` (3,) of W. Radians; yaw 0 faces east and "
          "grows "
          "counter-clockwise, pitch is positive nose up, roll right side down.")
      .def(
          "scan",
          [](World& w, const py::object& position, const Lidar& lidar, double yaw, double pitch, double roll) {
            const Kinematics body = Standing(position, yaw, pitch, roll);
            const py::gil_scoped_release release;
            return w.Scan(lidar, body);
          },
          py::arg("position"), py::arg_v("lidar", Lidar{}, "Lidar()"), py::arg("yaw") = 0.0, py::arg("pitch") = 0.0, py::arg("roll") = 0.0,
          "LidarScan of one turn by a body that stands still, as capture.");
}

}  // namespace

void BindWorld(py::module_& m) {
  m.def("worlds", &ListOfWorlds, "The built-in worlds: dictionaries with name, setting, area_m2, categories, description.");
  m.def("gpus", &Gpus, "GPUs of this machine: dictionaries with index, name, driver, software, missing (what it lacks to render), uuid.");
  WorldClass world(m, "World", R"(A world by name, or a path to .glb, .gltf, .obj, .osm, CityJSON or world .yaml.

`labels` is a label file: categories by patterns of names (docs/guide/labels.md).

`device` draws the pictures of it and of simulations in it: "auto" (a GPU where there is one), "cpu", or "vulkan" (RuntimeError
says why where there is none); `gpu` is the number of one among several, as `airsim360 doctor` lists them.
`weather`, `clouds`, `sky_seed`, `sun`, `time`, `place`, `hdri` and `environment` are the light instead of the world's own, as the
flags of those names of `airsim360 render`. `bbox`, `centre` and `radius` cut a piece out of a map, likewise. `people`: a number, or the path of a
people .yaml; they live in simulations of it, and captures of the world show them where they begin. `traffic`: how many vehicles drive, likewise. `wind`: a wind file, for
simulations.

ValueError names the nearest world where there is none of that name.)");
  world.def(py::init(&OpenWorld), py::arg("name"), py::arg("seed") = 0, py::arg("models") = true, py::kw_only(), py::arg("labels") = "",
            py::arg("device") = "auto", py::arg("gpu") = -1, py::arg("weather") = "", py::arg("sun") = "", py::arg("time") = "",
            py::arg("place") = "", py::arg("hdri") = "", py::arg("environment") = "", py::arg("clouds") = "", py::arg("sky_seed") = "",
            py::arg("bbox") = "", py::arg("centre") = "", py::arg("radius") = 0.0, py::arg("people") = 0, py::arg("wind") = "",
            py::arg("traffic") = 0);
  BindContent(world);
  BindSensing(world);
}

}  // namespace airsim360::python
