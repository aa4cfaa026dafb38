// The native vector environment; airsim360/gym wraps it.
#include "airsim360/tasks/gym/vector_environment.h"

#include "airsim360/base/error.h"
#include "handles.h"
#include "keywords.h"

namespace airsim360::python {
namespace {

using Actions = py::array_t<float, py::array::c_style | py::array::forcecast>;

double Number(const py::handle& value, const std::string& name) {
  try {
    return value.cast<double>();
  } catch (const py::cast_error&) {
    throw InputError(name + ": " + py::repr(value).cast<std::string>() + " is not a number");
  }
}

constexpr std::pair<const char*, double NavigationTask::*> kTaskNumbers[] = {{"least_distance", &NavigationTask::least_distance},
                                                                             {"most_distance", &NavigationTask::most_distance},
                                                                             {"goal_radius", &NavigationTask::goal_radius},
                                                                             {"clearance", &NavigationTask::clearance},
                                                                             {"area", &NavigationTask::area},
                                                                             {"min_height", &NavigationTask::min_height},
                                                                             {"max_height", &NavigationTask::max_height},
                                                                             {"seconds", &NavigationTask::seconds},
                                                                             {"safe_distance", &NavigationTask::safe_distance},
                                                                             {"progress_reward", &NavigationTask::progress_reward},
                                                                             {"goal_reward", &NavigationTask::goal_reward},
                                                                             {"crash_cost", &NavigationTask::crash_cost},
                                                                             {"step_cost", &NavigationTask::step_cost},
                                                                             {"near_cost", &NavigationTask::near_cost},
                                                                             {"seen_reward", &NavigationTask::seen_reward}};

std::vector<std::string> TaskOptions() {
  std::vector<std::string> names = {"target"};
  for (const auto& [name, field] : kTaskNumbers) names.emplace_back(name);
  return names;
}

NavigationTask ToTask(const std::string& kind, const py::dict& options) {
  NavigationTask task{.kind = ParseNavigationKind(kind)};
  if (task.kind == NavigationKind::kSearch) task.goal_radius = 3;
  for (const auto& [key, value] : options) {
    const auto name = key.cast<std::string>();
    if (name == "target") {
      task.target = value.cast<std::string>();
      continue;
    }
    bool known = false;
    for (const auto& [field_name, field] : kTaskNumbers) {
      if (name != field_name) continue;
      task.*field = Number(value, name);
      known = true;
    }
    if (!known) throw InputError(UnknownChoiceMessage("task option", name, TaskOptions()));
  }
  if (!task.target.empty() && task.kind != NavigationKind::kSearch)
    throw InputError("target: the task '" + kind + "' looks for no thing; did you mean task 'search'?");
  return task;
}

/// One wish for all environments; each of goal, start and yaw for all, or with one row an environment.
std::vector<EpisodeWish> ToWishes(const py::dict& options, size_t count) {
  std::vector<EpisodeWish> wishes;
  const auto each = [&](const py::handle& value, const char* name, int axes, const auto& set) {
    const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(value);
    const bool rows = array && array.ndim() == axes + 1;
    if (rows && static_cast<size_t>(array.shape(0)) != count) {
      throw InputError(std::string(name) + ": " + std::to_string(array.shape(0)) + " rows for " + std::to_string(count) + " environments");
    }
    wishes.resize(rows ? count : std::max<size_t>(1, wishes.size()), wishes.empty() ? EpisodeWish{} : wishes[0]);
    for (size_t i = 0; i < wishes.size(); ++i)
      set(wishes[i], rows ? value[py::int_(i)].cast<py::object>() : py::reinterpret_borrow<py::object>(value));
  };
  for (const auto& [key, value] : options) {
    const auto name = key.cast<std::string>();
    if (name == "goal") {
      each(value, "goal", 1, [](EpisodeWish& w, const py::object& v) { w.goal_W = ToVec3(v, "goal"); });
    } else if (name == "start") {
      each(value, "start", 1, [](EpisodeWish& w, const py::object& v) { w.start_W = ToVec3(v, "start"); });
    } else if (name == "yaw") {
      each(value, "yaw", 0, [](EpisodeWish& w, const py::object& v) { w.yaw = Finite(Number(v, "yaw"), "yaw"); });
    } else {
      throw InputError(UnknownChoiceMessage("reset option", name, std::vector<std::string>{"goal", "start", "yaw"}));
    }
  }
  return wishes;
}

void SetObservations(const std::vector<std::string>& names, VectorEnvironmentOptions& options) {
  options.rgb = options.range = options.semantic = options.entity = false;
  const std::vector<std::string> choices = {"rgb", "range", "semantic", "entity"};
  for (const std::string& name : names) {
    if (name == "rgb")
      options.rgb = true;
    else if (name == "range")
      options.range = true;
    else if (name == "semantic")
      options.semantic = true;
    else if (name == "entity")
      options.entity = true;
    else
      throw InputError(UnknownChoiceMessage("observation", name, choices));
  }
}

// Names of arguments that are no settings of pictures.
const std::vector<std::string> kEnvironmentArguments = {"world",    "task",   "task_options", "count",  "drone",     "action",
                                                        "width",    "height", "observations", "period", "max_speed", "max_turn",
                                                        "max_rate", "level",  "auto_reset",   "seed"};

std::unique_ptr<VectorEnvironment> Make(const std::shared_ptr<World>& world, const std::string& task, const py::dict& task_options,
                                        const py::object& count, const py::object& drone, const std::string& action,
                                        const py::object& width, const py::object& height,
                                        const std::optional<std::vector<std::string>>& observations, double period, double max_speed,
                                        double max_turn, double max_rate, bool level, bool auto_reset, const py::object& given_seed,
                                        const py::kwargs& picture) {
  const uint64_t seed = ToSeed(given_seed);
  VectorEnvironmentOptions options;
  options.count = static_cast<int>(ToWhole(count, "count", 1, 65536));
  options.drone = ToDrone(drone).model;
  options.action = ParseActionLevel(action);
  options.max_speed = max_speed;
  options.max_turn = max_turn;
  options.max_rate = max_rate;
  options.period = period;
  options.width = static_cast<int>(ToWhole(width, "width", 2, 4096));
  options.height = static_cast<int>(ToWhole(height, "height", 0, 2048));
  if (options.height == 0) options.height = options.width / 2;
  if (level) options.picture.pano_frame = PanoFrame::kLevel;
  ReadKeywords(
      picture, [&](ConfigVisitor& v) { options.picture.Visit(v); }, kEnvironmentArguments);
  const bool lit = options.picture.tier != Tier::kLabels;
  SetObservations(observations.value_or(lit ? std::vector<std::string>{"rgb", "range"} : std::vector<std::string>{"range"}), options);
  options.picture.seed = seed;
  options.auto_reset = auto_reset;
  options.seed = seed;
  const NavigationTask navigation = ToTask(task, task_options);
  const py::gil_scoped_release release;
  return std::make_unique<VectorEnvironment>(world->stage(), navigation, options);
}

// pybind11 knows no signature of keywords that are found out at run time.
std::string Documentation() {
  const ConfigFields picture = [](ConfigVisitor& v) { PictureSettings().Visit(v); };
  return "__init__(self: airsim360.VectorEnvironment, world: airsim360.World, task: str = 'reach', "
         "task_options: dict = {}, count: int = 1, drone: object = 'hummingbird', action: str = 'velocity', "
         "width: int = 128, height: int = 0, *, " +
         KeywordSignature(picture) +
         ", observations: list[str] | None = None, period: float = 0.1, max_speed: float = 3.0, "
         "max_turn: float = 1.5, max_rate: float = 6.0, level: bool = False, auto_reset: bool = True, "
         "seed: int = 0) -> None\n\n" +
         KeywordHelp(picture);
}

// Pictures of all environments: (count, H, W) or (count, H, W, channels); None if they are not made.
template <class T, class Pixel>
auto Pictures(std::span<const Pixel> (VectorEnvironment::*rows)() const, int channels) {
  return [rows, channels](const py::object& self) -> py::object {
    const auto& e = self.cast<const VectorEnvironment&>();
    const auto data = (e.*rows)();
    if (data.empty()) return py::none();
    const py::ssize_t h = e.options().height, w = e.options().width, pixel = sizeof(Pixel);
    std::vector<py::ssize_t> shape = {e.count(), h, w}, strides = {h * w * pixel, w * pixel, pixel};
    if (channels > 0) {
      shape.push_back(channels);
      strides.push_back(sizeof(T));
    }
    return View(reinterpret_cast<const T*>(data.data()), shape, strides, self);
  };
}

template <class T>
auto Numbers(std::span<const T> (VectorEnvironment::*rows)() const) {
  return [rows](const py::object& self) {
    const auto data = (self.cast<const VectorEnvironment&>().*rows)();
    return View(data.data(), {static_cast<py::ssize_t>(data.size())}, {sizeof(T)}, self);
  };
}

// Flags as NumPy's bool.
auto Flags(std::span<const uint8_t> (VectorEnvironment::*rows)() const) {
  return [rows](const py::object& self) {
    const auto data = (self.cast<const VectorEnvironment&>().*rows)();
    return View(reinterpret_cast<const bool*>(data.data()), {static_cast<py::ssize_t>(data.size())}, {1}, self);
  };
}

py::array State(const py::object& self) {
  const auto& e = self.cast<const VectorEnvironment&>();
  constexpr py::ssize_t kRow = StateColumns::kCount * sizeof(float);
  return View(e.state().data(), {e.count(), StateColumns::kCount}, {kRow, sizeof(float)}, self);
}

using E = VectorEnvironment;

void BindActions(py::class_<E>& environment) {
  environment
      .def(
          "reset",
          [](E& e, std::optional<uint64_t> seed, const py::object& options) {
            std::vector<EpisodeWish> wishes;
            if (!options.is_none()) wishes = ToWishes(options.cast<py::dict>(), static_cast<size_t>(e.count()));
            const py::gil_scoped_release release;
            e.Reset(seed, wishes);
          },
          py::arg("seed") = py::none(), py::arg("options") = py::none(),
          "Begins anew: episode 0 of `seed`, or everyone's next episode. options: a dictionary with goal and "
          "start (3,) of W "
          "and yaw (radians), for all or with one row an environment; ValueError for places that are not "
          "free.")
      .def(
          "step",
          [](E& e, const Actions& actions) {
            const std::span<const float> span(actions.data(), static_cast<size_t>(actions.size()));
            const py::gil_scoped_release release;
            e.Step(span);
          },
          py::arg("actions"), "actions: (count, action_size) float32 in -1 … 1.")
      .def_property_readonly_static(
          "TASK_OPTIONS", [](const py::object&) { return py::tuple(py::cast(TaskOptions())); }, "Names that task_options takes.")
      .def("__repr__", [](const E& e) { return Text("VectorEnvironment(%d of %dx%d)", e.count(), e.options().width, e.options().height); });
}

// What stands after each step, one row an environment.
void BindArrays(py::class_<E>& environment) {
  environment.def_property_readonly("count", &E::count, "Environments.")
      .def_property_readonly("action_size", &E::action_size, "Numbers of an action.")
      .def_property_readonly(
          "width", [](const E& e) { return e.options().width; }, "Pixels.")
      .def_property_readonly(
          "height", [](const E& e) { return e.options().height; }, "Pixels.")
      .def_property_readonly("rgb", Pictures<uint8_t>(&E::rgb, 3), "(count, H, W, 3) uint8")
      .def_property_readonly("range", Pictures<float>(&E::range, 0), "(count, H, W) float32, metres, 0 = sky")
      .def_property_readonly("semantic", Pictures<CategoryId>(&E::semantic, 0), "(count, H, W) uint16")
      .def_property_readonly("entity", Pictures<EntityId>(&E::entity, 0), "(count, H, W) uint32")
      .def_property_readonly("state", &State, "(count, 17) float32; columns: docs/guide/gym.md")
      .def_property_readonly("reward", Numbers(&E::reward), "(count,) float32")
      .def_property_readonly("distance", Numbers(&E::distance), "(count,) float32, metres to the goal")
      .def_property_readonly("steps", Numbers(&E::steps), "(count,) int64, of the present episode")
      .def_property_readonly("terminated", Flags(&E::terminated), "(count,) bool: reached or crashed")
      .def_property_readonly("truncated", Flags(&E::truncated), "(count,) bool: out of time")
      .def_property_readonly("reached", Flags(&E::reached), "(count,) bool")
      .def_property_readonly("crashed", Flags(&E::crashed), "(count,) bool");
}

void BindEpisodes(py::class_<E>& environment) {
  environment
      .def(
          "pose_of",
          [](const E& e, int i) {
            if (i < 0 || i >= e.count()) throw InputError("environment " + std::to_string(i) + " of " + std::to_string(e.count()));
            return FromPose(e.sim_state(i).vehicles[0].motion.X_WB);
          },
          py::arg("environment"), "(4, 4) X_WB of a drone.")
      .def(
          "goal_of",
          [](const E& e, int i) {
            if (i < 0 || i >= e.count()) throw InputError("environment " + std::to_string(i) + " of " + std::to_string(e.count()));
            return FromVec3(e.episode(i).goal_W);
          },
          py::arg("environment"), "(3,) goal in W.")
      .def("hash", &E::Hash, "64 bits over every number of all simulations.");
}

}  // namespace

void BindVectorEnvironment(py::module_& m) {
  py::class_<E> environment(m, "VectorEnvironment",
                            "Many drones that learn at once (see airsim360.gym). Arrays stay where they are: each step "
                            "writes into them.");
  {
    py::options options;
    options.disable_function_signatures();
    environment.def(py::init(&Make), py::arg("world"), py::arg("task") = "reach", py::arg("task_options") = py::dict(),
                    py::arg("count") = 1, py::arg("drone") = "hummingbird", py::arg("action") = "velocity", py::arg("width") = 128,
                    py::arg("height") = 0, py::kw_only(), py::arg("observations") = py::none(), py::arg("period") = 0.1,
                    py::arg("max_speed") = 3.0, py::arg("max_turn") = 1.5, py::arg("max_rate") = 6.0, py::arg("level") = false,
                    py::arg("auto_reset") = true, py::arg("seed") = 0, Documentation().c_str());
  }
  BindActions(environment);
  BindArrays(environment);
  BindEpisodes(environment);
}

}  // namespace airsim360::python
