// Recordings as bytes. One list of fields serves both ways: `Walk` visits every field of a value in order.
#include <bit>
#include <cstring>

#include "airsim360/base/error.h"
#include "airsim360/base/hash.h"
#include "airsim360/sim/recording.h"
#include "airsim360/sim/trajectory_reference.h"

namespace airsim360 {
namespace {

static_assert(std::endian::native == std::endian::little, "recordings are written as little-endian memory");

constexpr std::string_view kMagic = "A360RUN\n";
constexpr size_t kDigest = 64;  // hex digits
constexpr int64_t kMostSteps = int64_t{1} << 40;

template <class T>
concept PlainNumber = std::is_arithmetic_v<T>;

/// Appends fields.
class Writer {
 public:
  static constexpr bool kReads = false;
  template <PlainNumber T>
  void Field(const T& value) {
    const auto bytes = std::as_bytes(std::span(&value, 1));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  uint64_t Count(uint64_t count, size_t) {
    Field(count);
    return count;
  }
  Bytes Take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

/// Takes fields; InputError where the bytes end too early.
class Reader {
 public:
  static constexpr bool kReads = true;
  Reader(std::span<const std::byte> rest, std::string_view name) : rest_(rest), name_(name) {}
  [[noreturn]] void Fail(const std::string& what) const { throw InputError(std::string(name_) + ": " + what); }
  template <PlainNumber T>
  void Field(T& value) {
    if (rest_.size() < sizeof(T)) Fail("the recording is cut off");
    std::memcpy(&value, rest_.data(), sizeof(T));
    rest_ = rest_.subspan(sizeof(T));
  }
  // Number of elements of at least `size` bytes each that follow.
  uint64_t Count(uint64_t, size_t size) {
    uint64_t count = 0;
    Field(count);
    if (count > rest_.size() / size) Fail("the recording is cut off");
    return count;
  }
  bool done() const { return rest_.empty(); }

 private:
  std::span<const std::byte> rest_;
  std::string_view name_;
};

// Of values that come after the templates that hold them.
template <class A>
void Walk(A& archive, PersonCommand& command);
template <class A>
void Walk(A& archive, FlightCommand& command);
template <class A>
void Walk(A& archive, RigidTransform& X);

template <class A, PlainNumber T>
void Walk(A& archive, T& value) {
  archive.Field(value);
}
template <class A>
void Walk(A& archive, bool& value) {
  uint8_t byte = value;
  archive.Field(byte);
  value = byte != 0;
}
template <class A>
void Walk(A& archive, Vec3d& v) {
  archive.Field(v.x), archive.Field(v.y), archive.Field(v.z);
}
template <class A, size_t N>
void Walk(A& archive, std::array<double, N>& values) {
  for (double& value : values) archive.Field(value);
}
template <class A, class T, class Body>
void WalkList(A& archive, std::vector<T>& list, size_t least_size, const Body& body) {
  const uint64_t count = archive.Count(list.size(), least_size);
  if constexpr (A::kReads) list.resize(count);
  for (T& element : list) body(element);
}
template <class A>
void Walk(A& archive, std::vector<double>& values) {
  WalkList(archive, values, 8, [&](double& value) { archive.Field(value); });
}
template <class A, class T>
void Walk(A& archive, std::optional<T>& value) {
  bool has = value.has_value();
  Walk(archive, has);
  if constexpr (A::kReads) value = has ? std::optional<T>(T{}) : std::nullopt;
  if (has) Walk(archive, *value);
}

// What `make` gives; its errors name the file.
template <class Make>
auto Made(const Reader& reader, const Make& make) {
  try {
    return make();
  } catch (const InputError& error) {
    reader.Fail(error.what());
  }
}

// Enumerations read from a file must be one of their values.
template <class A, class E>
void WalkEnum(A& archive, E& value, int last) {
  auto number = static_cast<int32_t>(value);
  archive.Field(number);
  if constexpr (A::kReads) {
    if (number < 0 || number > last) archive.Fail("a choice of " + std::to_string(number) + " is not known");
  }
  value = static_cast<E>(number);
}
template <class A>
void Walk(A& archive, YawTarget& yaw) {
  WalkEnum(archive, yaw.mode, static_cast<int>(YawTarget::Mode::kForward));
  Walk(archive, yaw.value);
}
template <class A>
void Walk(A& archive, VerticalTarget& vertical) {
  WalkEnum(archive, vertical.mode, static_cast<int>(VerticalTarget::Mode::kAltitude));
  Walk(archive, vertical.value);
}

template <class A>
void Walk(A&, ArmCommand&) {}
template <class A>
void Walk(A&, DisarmCommand&) {}
template <class A>
void Walk(A& a, HoverCommand& c) {
  Walk(a, c.yaw);
}
template <class A>
void Walk(A& a, RotorSpeedCommand& c) {
  Walk(a, c.speeds);
}
template <class A>
void Walk(A& a, RotorSignalCommand& c) {
  Walk(a, c.signals);
}
template <class A>
void Walk(A& a, RateCommand& c) {
  Walk(a, c.w_B), Walk(a, c.vertical);
}
template <class A>
void Walk(A& a, AttitudeCommand& c) {
  Walk(a, c.roll), Walk(a, c.pitch), Walk(a, c.yaw), Walk(a, c.vertical);
}
template <class A>
void Walk(A& a, VelocityCommand& c) {
  Walk(a, c.v), Walk(a, c.body_heading), Walk(a, c.yaw), Walk(a, c.hold_altitude), Walk(a, c.altitude);
}
template <class A>
void Walk(A& a, PositionCommand& c) {
  Walk(a, c.p_W), Walk(a, c.speed), Walk(a, c.yaw);
}
template <class A>
void Walk(A& a, TakeoffCommand& c) {
  Walk(a, c.height), Walk(a, c.speed);
}
template <class A>
void Walk(A& a, LandCommand& c) {
  Walk(a, c.speed);
}
template <class A>
void Walk(A& a, ReturnCommand& c) {
  Walk(a, c.height), Walk(a, c.speed), Walk(a, c.land);
}
template <class A>
void Walk(A& a, PathCommand& c) {
  std::vector<Vec3d> points;
  if (c.waypoints) points = *c.waypoints;
  WalkList(a, points, 24, [&](Vec3d& p) { Walk(a, p); });
  if constexpr (A::kReads) c.waypoints = std::make_shared<const std::vector<Vec3d>>(std::move(points));
  Walk(a, c.speed), Walk(a, c.lookahead), Walk(a, c.yaw);
}
template <class A>
void Walk(A& a, TrajectoryCommand& c) {
  int32_t degree = 0;
  std::vector<double> durations, coefficients;
  std::optional<double> yaw;
  std::optional<Vec3d> look_at;
  double yaw_at_rest = 0;
  if (const auto* planned = dynamic_cast<const PlannedReference*>(c.trajectory.get())) {
    const PolynomialTrajectory& trajectory = planned->trajectory();
    degree = trajectory.degree();
    durations.assign(trajectory.durations().begin(), trajectory.durations().end());
    coefficients.assign(trajectory.coefficients().begin(), trajectory.coefficients().end());
    yaw = planned->yaw();
    yaw_at_rest = planned->yaw_at_rest();
    look_at = planned->look_at();
  }
  Walk(a, degree), Walk(a, durations), Walk(a, coefficients);
  // How it looks: 0 along the way, 1 by a fixed angle, 2 at a point.
  uint8_t looks = look_at ? 2 : yaw ? 1 : 0;
  a.Field(looks);
  if constexpr (A::kReads) {
    if (looks > 2) a.Fail("a heading of kind " + std::to_string(looks) + " is not known");
    if (looks == 1) yaw = 0;
    if (looks == 2) look_at = Vec3d{};
  }
  if (yaw) Walk(a, *yaw);
  if (look_at) Walk(a, *look_at);
  Walk(a, yaw_at_rest);
  if constexpr (A::kReads) {
    c.trajectory = Made(a, [&] {
      auto path = std::make_shared<const PolynomialTrajectory>(degree, std::move(durations), std::move(coefficients));
      return look_at ? std::make_shared<const PlannedReference>(std::move(path), *look_at)
                     : std::make_shared<const PlannedReference>(std::move(path), yaw, yaw_at_rest);
    });
  }
}

template <class A>
void Walk(A& a, std::shared_ptr<const Route>& route) {
  std::vector<RouteNode> nodes;
  if (route) nodes = route->nodes();
  WalkList(a, nodes, 64, [&](RouteNode& node) { Walk(a, node.t), Walk(a, node.p), Walk(a, node.v), Walk(a, node.yaw); });
  if constexpr (A::kReads) {
    route = Made(a, [&] { return std::make_shared<const Route>(std::move(nodes)); });
  }
}
template <class A>
void Walk(A& a, GimbalCommand& c) {
  uint64_t gimbal = c.gimbal;
  Walk(a, gimbal);
  c.gimbal = gimbal;
  Walk(a, c.angles.yaw), Walk(a, c.angles.pitch), Walk(a, c.angles.roll);
}
template <class A>
void Walk(A& a, RotorHealthCommand& c) {
  Walk(a, c.health);
}
template <class A>
void Walk(A& a, RigidTransform& X) {
  for (auto& row : X.R.m) Walk(a, row);
  Walk(a, X.p);
}
template <class A>
void Walk(A& a, ResetCommand& c) {
  Walk(a, c.X_WB), Walk(a, c.airborne);
}
template <class A>
void Walk(A& a, WindCommand& c) {
  Walk(a, c.wind_W);
}

template <class A>
void Walk(A& a, std::string& text) {
  std::vector<char> letters(text.begin(), text.end());
  WalkList(a, letters, 1, [&](char& c) { a.Field(c); });
  text.assign(letters.begin(), letters.end());
}
template <class A>
void Walk(A& a, SpawnPerson& c) {
  Walk(a, c.p_W), Walk(a, c.yaw);
}
template <class A>
void Walk(A& a, MovePerson& c) {
  Walk(a, c.p_W), Walk(a, c.yaw);
}
template <class A>
void Walk(A&, RemovePerson&) {}
template <class A>
void Walk(A& a, SendPerson& c) {
  Walk(a, c.p_W), Walk(a, c.speed);
}
template <class A>
void Walk(A& a, SetPersonState& c) {
  Walk(a, c.state), Walk(a, c.seconds);
}
template <class A>
void Walk(A& a, MessagePerson& c) {
  Walk(a, c.type);
}
template <class A>
void Walk(A&, ReleasePerson&) {}

// The alternative by its number, then its fields.
template <class A, class... Types>
void Walk(A& a, std::variant<Types...>& value) {
  auto index = static_cast<uint32_t>(value.index());
  a.Field(index);
  if constexpr (A::kReads) {
    using Value = std::variant<Types...>;
    static constexpr Value (*kMake[])() = {[] { return Value(Types{}); }...};
    if (index >= sizeof...(Types)) a.Fail("a command of kind " + std::to_string(index) + " is not known");
    value = kMake[index]();
  }
  std::visit([&](auto& alternative) { Walk(a, alternative); }, value);
}
template <class A>
void Walk(A& a, PersonCommand& c) {
  Walk(a, c.person), Walk(a, c.action);
}
template <class A>
void Walk(A& a, FlightCommand& c) {
  Walk(a, c.command), Walk(a, c.timeout_ns);
}

template <class A>
void Walk(A& a, Recording& r) {
  std::vector<char> note(r.note.begin(), r.note.end());
  WalkList(a, note, 1, [&](char& c) { a.Field(c); });
  r.note.assign(note.begin(), note.end());
  Walk(a, r.dt_ns), Walk(a, r.first_step), Walk(a, r.steps), Walk(a, r.start_hash);
  WalkList(a, r.commands, 16, [&](RecordedStep& step) {
    Walk(a, step.step);
    WalkList(a, step.commands, 12, [&](SimCommand& command) {
      uint64_t vehicle = command.vehicle;
      Walk(a, vehicle);
      command.vehicle = vehicle;
      Walk(a, command.action);
    });
  });
  WalkList(a, r.hashes, 16, [&](auto& hash) { Walk(a, hash.first), Walk(a, hash.second); });
}

void CheckOrder(const Recording& r, const Reader& reader) {
  const auto outside = [](int64_t steps) { return steps < 0 || steps > kMostSteps; };
  if (r.dt_ns <= 0 || outside(r.first_step) || outside(r.steps)) reader.Fail("the number or length of its steps makes no sense");
  int64_t last = r.first_step - 1;
  for (const RecordedStep& step : r.commands) {
    if (step.step <= last) reader.Fail("its commands are out of order");
    last = step.step;
  }
  last = r.first_step;
  for (const auto& [step, hash] : r.hashes) {
    if (step < last) reader.Fail("its hashes are out of order");
    last = step;
  }
}

}  // namespace

Bytes EncodeRecording(const Recording& recording) {
  Writer body;
  Recording copy = recording;
  body.Field(kRecordingVersion);
  Walk(body, copy);
  Bytes bytes(AsBytes(kMagic).begin(), AsBytes(kMagic).end());
  const Bytes content = body.Take();
  bytes.insert(bytes.end(), content.begin(), content.end());
  const std::string digest = Sha256Hex(content);
  bytes.insert(bytes.end(), AsBytes(digest).begin(), AsBytes(digest).end());
  return bytes;
}

Recording DecodeRecording(std::span<const std::byte> bytes, std::string_view name) {
  Reader outer(bytes, name);
  if (bytes.size() < kMagic.size() + sizeof(uint32_t) + kDigest || AsText(bytes.first(kMagic.size())) != kMagic)
    outer.Fail("not a recording");
  const auto content = bytes.subspan(kMagic.size(), bytes.size() - kMagic.size() - kDigest);
  Reader reader(content, name);
  uint32_t version = 0;
  reader.Field(version);
  if (version != kRecordingVersion) {
    reader.Fail("version " + std::to_string(version) + " of a recording; this program reads version " + std::to_string(kRecordingVersion));
  }
  if (Sha256Hex(content) != AsText(bytes.last(kDigest))) reader.Fail("the recording is damaged");
  Recording recording;
  Walk(reader, recording);
  if (!reader.done()) reader.Fail("bytes follow the end of the recording");
  CheckOrder(recording, reader);
  return recording;
}

void WriteRecording(const std::filesystem::path& path, const Recording& recording) {
  WriteFileAtomically(path, EncodeRecording(recording));
}

Recording ReadRecording(const std::filesystem::path& path) { return DecodeRecording(ReadFile(path), path.string()); }

}  // namespace airsim360
