#include "airsim360/view/live_world.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <utility>

#include "airsim360/base/error.h"
#include "airsim360/flight/drones/catalog.h"
#include "airsim360/math/coordinate_limit.h"
#include "airsim360/render/frame/interruption.h"
#include "airsim360/scene/viewpoint.h"
#include "airsim360/sim/drone_bodies.h"
#include "airsim360/view/drawing.h"
#include "airsim360/view/drawn_frames.h"
#include "airsim360/view/fair_mutex.h"
#include "airsim360/view/frame_pool.h"
#include "airsim360/view/live_messages.h"
#include "airsim360/view/placing.h"
#include "airsim360/view/planes.h"
#include "airsim360/view/tree_desk.h"

namespace airsim360 {

using Json = nlohmann::ordered_json;

namespace {

constexpr double kMostPassed = 0.25;         // seconds that pass between two pictures at most
constexpr int64_t kSilenceNs = 500'000'000;  // after which the drone stops
constexpr double kFlowSeconds = 0.1;
constexpr double kKeyStep = 0.5;  // of a stick: so much at once is a key, not the drift of a gamepad
constexpr size_t kKeptFrames = 4, kMostKept = 1000, kMostMessage = 65536;
constexpr int kSmallest = 128, kLargest = 4096;  // columns
constexpr const char* kShown[] = {"range", "semantic", "entity", "normal", "albedo", "material", "position", "coverage", "flow"};

std::string TimeOfDay(double hour) {
  const int minutes = static_cast<int>(std::lround(hour * 60)) % (24 * 60);
  char text[64];
  std::snprintf(text, sizeof text, "2026-06-21T%02d:%02d", minutes / 60, minutes % 60);
  return text;
}

SocketMessage Said(const Json& json) { return {json.dump(-1, ' ', false, Json::error_handler_t::replace)}; }

double Number(const Json& message, const char* key, double low, double high, double otherwise) {
  if (!message.contains(key)) return otherwise;
  const Json& value = message[key];
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  if (!(number >= low && number <= high))
    throw InputError(std::string(key) + ": " + value.dump() + " is not in " + Json(low).dump() + " ... " + Json(high).dump());
  return number;
}

Vec3d PointOf(const Json& message) {
  const Json point = message.value("point", Json());
  const bool fits = point.is_array() && point.size() == 3 && std::ranges::all_of(point, [](const Json& v) { return v.is_number(); });
  if (!fits) throw InputError("point: three numbers, metres of W");
  return CheckedPlace("point", {point[0].get<double>(), point[1].get<double>(), point[2].get<double>()});
}

Products ProductsOf(const Json& message, std::vector<std::string>& names) {
  Products products;
  const Json wanted = message.value("products", Json::array());
  if (!wanted.is_array()) throw InputError("products: a list of names");
  for (const Json& name : wanted) {
    const auto found = std::ranges::find_if(kProducts, [&](const ProductInfo& p) { return name == p.name; });
    if (found == std::end(kProducts) || std::ranges::find(kShown, name) == std::end(kShown))
      throw InputError("products: " + name.dump() + " is none of them");
    products.*found->wanted = true;
    names.push_back(found->name);
  }
  return products;
}

DroneSetup SetupOf(const Scene& scene, const std::string& drone) {
  DroneSetup setup{.name = "drone", .model = CatalogModel(drone)};
  const Vec3d spawn = VecCast<double>(FirstViewpoint(scene));
  setup.X_WB = BodyPose(spawn, scene.spawn_yaw_deg * std::numbers::pi / 180, 0, 0);
  setup.airborne = true;
  setup.crash_disarms = false;  // who bumps into something flies on
  return setup;
}

std::shared_ptr<const SimModel> ModelOf(Stage& stage, const std::string& drone) {
  SimModel model = stage.Model();
  model.drones.push_back(std::make_shared<const SimDrone>(SetupOf(stage.scene(), drone), model.dt_ns));
  return std::make_shared<const SimModel>(std::move(model));
}

// From StartState without the distance to the nearest surface, whose search tree takes a while to build in a large world: the first
// picture does without it, and the first step measures it.
SimLoop LoopOf(const std::shared_ptr<const SimModel>& model) {
  SimModel without_clearance = *model;
  without_clearance.contact_range = 0;
  return SimLoop(model, StartState(without_clearance));
}

// A picture that may still be asked about.
struct Seen {
  int64_t number = 0;
  std::shared_ptr<const Frame> frame;
};

// What the hands do, of the newest message of them.
struct Hands {
  std::array<double, 4> sticks = {};
  int64_t number = 0;  // that the page gave it
  bool fresh = false;  // no picture has them yet
};

bool IsKey(const std::array<double, 4>& before, const std::array<double, 4>& now) {
  for (size_t i = 0; i < before.size(); ++i)
    if (std::abs(now[i] - before[i]) >= kKeyStep) return true;
  return false;
}

// A picture that is taken and not yet written: others take theirs meanwhile.
struct TakenPicture {
  std::shared_ptr<Frame> frame;
  std::string fields;
};

}  // namespace

struct LiveWorld::Impl {
  Impl(std::shared_ptr<Stage> given, LiveOptions wanted)
      : stage(std::move(given)),
        options(std::move(wanted)),
        loop(LoopOf(ModelOf(*stage, options.drone))),
        environment(stage->environment()) {
    renderer = &stage->renderer(options.picture.tier);
  }

  SocketMessage Do(const Json& message, bool may_fly);
  SocketMessage Picture(const Json& message, bool may_fly);
  TakenPicture Take(const Json& message, int width, const Products& products);
  bool TryCapture(const PanoramicRig& rig, const SimState& state, const NextTrigger* next, Capture& capture);
  SocketMessage Feel(const Json& message);
  void Steer(const Json& message);
  SocketMessage Planes(const Json& message);
  std::shared_ptr<const Frame> SeenFrame(int64_t number);
  SocketMessage Set(const Json& message);
  SocketMessage Keep();
  SocketMessage Save();
  SocketMessage Reset();
  void Fly(const std::array<double, 4>& sticks);
  void PassTime();
  std::shared_ptr<const SimModel> Model();
  void Prepare(const Json& message, PanoramicRig& rig, std::shared_ptr<const SimState>& state, NextTrigger& next);
  std::string StateFields(const Capture& capture, const Vehicle& vehicle);

  std::shared_ptr<Stage> stage;
  LiveOptions options;
  SimLoop loop;
  TreeDesk trees{loop};  // as `mutex` says
  std::mutex changes;    // of what follows; taken before the others
  std::string weather;
  double hour = -1;
  FairMutex rendering;  // of what follows; taken before `mutex`. Pictures follow each other without a pause, and another light wants a turn
  std::unique_ptr<Renderer> own_renderer;  // of another environment than the stage's
  Renderer* renderer = nullptr;
  int64_t next_number = 1;
  FramePool frames;
  std::mutex mutex;  // of the loop and what follows; never held while a picture is rendered
  Environment environment;
  std::optional<double> told_at;  // when time last passed; it begins with the first picture
  Flight kept;
  int64_t steered = 0;    // number of the hands that steer
  std::mutex seeing;      // of what follows; who asks about a picture does not wait for the next one
  std::deque<Seen> seen;  // newest last
  std::mutex feeling;     // of what follows; hands do not wait for pictures
  Hands hands;
  std::atomic<bool> up_to_date{true};  // the picture that is being rendered has the newest key
};

void LiveWorld::Impl::Fly(const std::array<double, 4>& sticks) {
  const auto [ahead, left, up, turn] = sticks;
  VelocityCommand command{.v = Vec3d{ahead, left, up} * kStickSpeed, .body_heading = true};
  command.yaw = {YawTarget::Mode::kRate, turn * kStickTurnRate};
  loop.Post({0, FlightCommand{command, kSilenceNs}});
}

void LiveWorld::Impl::PassTime() {
  const double now = options.clock(), passed = told_at ? std::clamp(now - *told_at, 0.0, kMostPassed) : 0;
  told_at = now;
  loop.Advance(std::llround(passed * 1e9 / static_cast<double>(loop.model().dt_ns)));
  // What a mission captures is kept like what hands keep.
  for (MissionCapture& capture : trees.NewCaptures()) {
    if (!options.save || kept.shots.size() >= kMostKept || (!kept.shots.empty() && kept.shots.back().t_ns >= capture.shot.t_ns)) continue;
    kept.trajectory.push_back({capture.shot.t_ns, capture.shot.body, {}});
    kept.shots.push_back(std::move(capture.shot));
  }
}

std::string LiveWorld::Impl::StateFields(const Capture& capture, const Vehicle& vehicle) {
  const std::lock_guard lock(mutex);
  const Quaternion q = ToQuaternion(capture.X_WC.R);
  const Vec3d p = capture.X_WC.p, v = vehicle.motion.v_WB;
  Json fields{{"number", next_number},
              {"t", 1e-9 * static_cast<double>(capture.t_ns)},
              {"p", {p.x, p.y, p.z}},
              {"q", {q.w, q.x, q.y, q.z}},
              {"v", {v.x, v.y, v.z}},
              {"render_ms", capture.stats.render_ms},
              {"collisions", vehicle.collision.count},
              {"charge", vehicle.drone.charge},
              {"kept", kept.shots.size()},
              {"hands", steered}};
  if (vehicle.collision.count > 0 && vehicle.collision.entity != kNoEntity)
    fields["touched"] = stage->scene().entity(vehicle.collision.entity).name;
  const std::string text = fields.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.substr(1, text.size() - 2);
}

// Applied when the next picture is taken.
SocketMessage LiveWorld::Impl::Feel(const Json& message) {
  const auto number = static_cast<int64_t>(Number(message, "number", 0, 9e15, 0));
  const std::array<double, 4> sticks = SticksOf(message.value("input", Json()));
  const std::lock_guard lock(feeling);
  if (IsKey(hands.sticks, sticks)) up_to_date = false;
  hands = {sticks, number, true};
  return Said({{"done", "hands"}});
}

// The hands that came with a picture's question, or those that were told since the last picture.
void LiveWorld::Impl::Steer(const Json& message) {
  const std::lock_guard lock(feeling);
  up_to_date = true;
  if (message.contains("input")) {
    if (!trees.Flies()) Fly(SticksOf(message["input"]));
    return;
  }
  if (!std::exchange(hands.fresh, false)) return;
  steered = hands.number;
  if (!trees.Flies()) Fly(hands.sticks);
}

SocketMessage LiveWorld::Impl::Picture(const Json& message, bool may_fly) {
  const int width = static_cast<int>(Number(message, "width", kSmallest, kLargest, 1024)) / 2 * 2;
  std::vector<std::string> names;
  const Products products = ProductsOf(message, names);
  if (message.contains("input") && !may_fly) throw InputError("token: flying needs the page's token");
  const TakenPicture taken = Take(message, width, products);
  // Without the lock: the next picture is rendered while this one is written.
  PlaneMessage planes;
  planes.AddPicture(taken.frame->rgb);
  for (const std::string& name : names) planes.AddProduct(*taken.frame, name);
  FramePool::DropProducts(*taken.frame);
  return {planes.Finish(taken.fields), true};
}

// The world at the instant of the picture.
void LiveWorld::Impl::Prepare(const Json& message, PanoramicRig& rig, std::shared_ptr<const SimState>& state, NextTrigger& next) {
  const std::lock_guard lock(mutex);
  Steer(message);
  PassTime();
  state = loop.Snapshot();
  rig.state = SceneStateOf(loop.model(), *state, 0);
  if (rig.products.flow) next = InstantAfter(loop.model(), *state, 0, kFlowSeconds);
}

// False: a key came meanwhile, and nobody wants a picture without it.
bool LiveWorld::Impl::TryCapture(const PanoramicRig& rig, const SimState& state, const NextTrigger* next, Capture& capture) {
  const InterruptibleScope interruptible(up_to_date);
  try {
    CaptureRig(rig, state.vehicles[0].motion, state.t_ns, *renderer, capture, next);
  } catch (const Interrupted&) {
    return false;
  }
  return true;
}

TakenPicture LiveWorld::Impl::Take(const Json& message, int width, const Products& products) {
  const std::lock_guard turn(rendering);
  PanoramicRig rig;
  static_cast<RenderSettings&>(rig) = options.picture;
  rig.camera = Equirectangular{width, width / 2};
  rig.pano_frame = PanoFrame::kLevel;
  rig.products = products;
  std::shared_ptr<const SimState> state;
  NextTrigger next;
  const NextTrigger* flow_to = products.flow ? &next : nullptr;
  Prepare(message, rig, state, next);
  const std::shared_ptr<Frame> frame = frames.Take();
  Capture capture;
  capture.frame = std::exchange(*frame, Frame());  // whatever fails, what goes back to the pool is a frame
  // The second one is not given up: somebody who hammers on the keys sees pictures too. It comes sooner, with rough edges.
  if (!TryCapture(rig, *state, flow_to, capture)) {
    Prepare(message, rig, state, next);
    if (rig.tier == Tier::kFast && rig.edge_samples == 0) rig.edge_samples = 1;
    CaptureRig(rig, state->vehicles[0].motion, state->t_ns, *renderer, capture, flow_to);
  }
  *frame = std::move(capture.frame);
  TakenPicture taken{frame, StateFields(capture, state->vehicles[0])};
  const std::lock_guard guard(seeing);
  seen.push_back({next_number++, frame});
  if (seen.size() > kKeptFrames) seen.pop_front();
  return taken;
}

std::shared_ptr<const Frame> LiveWorld::Impl::SeenFrame(int64_t number) {
  const std::lock_guard lock(seeing);
  const auto found = std::ranges::find(seen, number, &Seen::number);
  if (found == seen.end())
    throw InputError("number: picture " + std::to_string(number) + " is gone; ask about one of the newest " + std::to_string(kKeptFrames));
  return found->frame;
}

SocketMessage LiveWorld::Impl::Planes(const Json& message) {
  const auto number = static_cast<int64_t>(Number(message, "number", 0, 9e15, 0));
  const std::shared_ptr<const Frame> frame = SeenFrame(number);
  PlaneMessage planes;
  for (const char* name : {"range", "semantic", "entity"}) planes.AddProduct(*frame, name);
  return {planes.Finish("\"number\":" + std::to_string(number)), true};
}

std::shared_ptr<const SimModel> LiveWorld::Impl::Model() {
  const std::lock_guard lock(mutex);
  return loop.shared_model();
}

// Pictures go on while the renderer of the other light is made.
SocketMessage LiveWorld::Impl::Set(const Json& message) {
  const std::lock_guard one_at_a_time(changes);
  const std::string wanted = message.contains("weather") ? message["weather"].get<std::string>() : weather;
  const double wanted_hour = Number(message, "hour", -1, 24, hour);
  EnvironmentFlags flags{.weather = wanted};
  if (wanted_hour >= 0) {
    flags.time = TimeOfDay(wanted_hour);
    flags.place = "45,0";
  }
  const Environment next = ApplyFlags(flags, stage->environment());
  auto made = stage->NewRenderer(options.picture.tier, next);
  weather = wanted;
  hour = wanted_hour;
  const std::lock_guard turn(rendering);
  const std::lock_guard lock(mutex);
  own_renderer = std::move(made);
  renderer = own_renderer.get();
  environment = next;
  return Said({{"done", "set"}, {"sun_elevation_deg", next.sun_elevation_deg}});
}

SocketMessage LiveWorld::Impl::Keep() {
  const std::lock_guard lock(mutex);
  if (!options.save) throw InputError("keep: start 'airsim360 view' with --record DIR to keep frames");
  if (kept.shots.size() >= kMostKept) throw InputError("keep: " + std::to_string(kMostKept) + " frames are kept already; save them");
  const SimState& state = loop.state();
  if (!kept.shots.empty() && kept.shots.back().t_ns >= state.t_ns) throw InputError("keep: this instant is kept already");
  kept.shots.push_back({.t_ns = state.t_ns, .body = state.vehicles[0].motion, .people = state.people, .traffic = state.traffic});
  kept.trajectory.push_back({state.t_ns, state.vehicles[0].motion, state.vehicles[0].a_WB});
  return Said({{"done", "keep"}, {"kept", kept.shots.size()}});
}

SocketMessage LiveWorld::Impl::Save() {
  const std::lock_guard one_at_a_time(changes);
  Flight flight;
  Environment now;
  {
    const std::lock_guard lock(mutex);
    if (kept.shots.empty()) throw InputError("save: no frame is kept");
    flight = std::exchange(kept, {});
    now = environment;
  }
  const std::string where = options.save(flight, now);
  return Said({{"done", "save"}, {"folder", where}, {"frames", flight.shots.size()}});
}

SocketMessage LiveWorld::Impl::Reset() {
  loop.Post({0, ResetCommand{}});
  return Said({{"done", "reset"}});
}

SocketMessage LiveWorld::Impl::Do(const Json& message, bool may_fly) {
  const std::string what = message.value("do", "");
  if (what == "picture") return Picture(message, may_fly);
  if (what == "planes") return Planes(message);
  if (what == "draw") return Said({{"done", CheckDrawing(*Model(), message.value("kind", ""), message.value("text", ""))}});
  if (what == "cars") {
    const std::lock_guard lock(mutex);
    return {CarsJson(loop)};
  }
  if (TreeDesk::Handles(what) && (may_fly || !TreeDesk::Changes(what))) {
    const std::lock_guard lock(mutex);
    return {trees.Do(what, message.dump())};
  }
  if (!may_fly) throw InputError("token: '" + what + "' needs the page's token");
  if (what == "hands") return Feel(message);
  if (what == "set") return Set(message);
  if (what == "keep") return Keep();
  if (what == "save") return Save();
  if (what == "reset") return Reset();
  if (what == "car") {
    const std::lock_guard lock(mutex);
    BringCar(loop, message.value("car", ""), PointOf(message));
    return Said({{"done", "car"}});
  }
  throw InputError(
      "do: '" + what +
      "' is none of picture, planes, hands, set, keep, save, reset, cars, car, palette, trees, source, mind, check, apply, fly, mission, stop, person, draw");
}

LiveWorld::LiveWorld(std::shared_ptr<Stage> stage, LiveOptions options)
    : impl_(std::make_unique<Impl>(std::move(stage), std::move(options))) {}
LiveWorld::~LiveWorld() = default;

SocketMessage LiveWorld::Answer(std::string_view text, const std::string& token) {
  return AnswerMessage<Json>(text, {.bytes = kMostMessage}, token,
                             [&](const Json& message, bool may_fly) { return impl_->Do(message, may_fly); });
}

std::string LiveWorld::DescriptionJson() const {
  const Scene& scene = impl_->stage->scene();
  const Json about{{"world", impl_->stage->name()},
                   {"seed", impl_->stage->seed()},
                   {"source", impl_->options.source},
                   {"source_text", impl_->options.source_text},
                   {"products", kShown},
                   {"scale", {kNearestColor, kFarthestColor}},
                   {"weathers", EnvironmentPresetNames()},
                   {"keeps", static_cast<bool>(impl_->options.save)},
                   {"flies", true},
                   {"follows", false},
                   {"resets", true},
                   {"categories", Json::parse(CategoriesJson(scene.tree))}};
  return about.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string LiveWorld::EntitiesJson() const {
  const Scene& scene = impl_->stage->scene();
  Json entities = Json::object();
  for (const Entity& entity : scene.entities) {
    const Category& category = scene.tree[entity.category];
    Json& said = entities[std::to_string(entity.id)];
    said = {{"name", entity.name}, {"category_path", category.path}, {"kind", category.thing ? "thing" : "stuff"}};
    const Box3f& box = entity.bounds;
    if (box.empty()) continue;
    said["low"] = {box.min.x, box.min.y, box.min.z};
    said["high"] = {box.max.x, box.max.y, box.max.z};
  }
  return entities.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace airsim360
