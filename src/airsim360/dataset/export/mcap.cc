// An MCAP file that ROS 2, Foxglove and Rerun play: W is the frame `map`, the body `base_link` (forward, left, up), cameras
// are optical frames.
#include "airsim360/dataset/export/export_job.h"
#include "airsim360/dataset/export/imu_log.h"
#include "airsim360/dataset/export/mcap_file.h"
#include "airsim360/dataset/export/ros_messages.h"

namespace airsim360::internal {
namespace {

std::string TopicName(const View& view) {
  if (view.suffix.empty()) return view.projection == Projection::kErp ? "pano" : "camera";
  std::string name = view.suffix.substr(1);
  // Faces of cubes are called +x, …; topics have letters, digits and '_'.
  for (size_t at; (at = name.find_first_of("+-")) != std::string::npos;) name.replace(at, 1, name[at] == '+' ? "pos_" : "neg_");
  return name;
}

RigidTransform OpticalInWorld(const NativeFrame& frame, const View& view) {
  RigidTransform X = frame.X_WC(view);
  if (const auto* face = std::get_if<CubeFace>(&view.camera)) X.R = X.R * CubeFaceRotation(face->face);
  return X;
}

std::string Odometry(const NativeFrame& frame, const View& view) {
  const RigidTransform X = frame.X_WB(view);
  Cdr cdr;
  cdr.Header(frame.t_ns, "map").Text("base_link").Vector(X.p).Rotation(X.R);
  for (int i = 0; i < 36; ++i) cdr.N(0.0);
  cdr.Vector(X.R.transpose() * frame.v_WB()).Vector(frame.w_WB_B());
  for (int i = 0; i < 36; ++i) cdr.N(0.0);
  return cdr.Take();
}

std::string Transforms(const NativeFrame& frame, const std::vector<View>& views) {
  Cdr cdr;
  cdr.N(static_cast<uint32_t>(views.size() + 1));
  const auto add = [&](const std::string& child, const RigidTransform& X) {
    cdr.Header(frame.t_ns, "map").Text(child).Vector(X.p).Rotation(X.R);
  };
  add("base_link", frame.X_WB(views.front()));
  for (const View& view : views) add(TopicName(view) + "_optical", OpticalInWorld(frame, view));
  return cdr.Take();
}

std::string Compressed(const ExportJob& job, const NativeFrame& frame, const View& view) {
  return Cdr()
      .Header(frame.t_ns, TopicName(view) + "_optical")
      .Text(job.data.Extension("rgb") == ".jpg" ? "jpeg" : "png")
      .Octets(AsText(job.data.Read(frame, view, "rgb")))
      .Take();
}

std::string Range(const ExportJob& job, const NativeFrame& frame, const View& view) {
  const Image<float> range = job.data.Range(frame, view);
  const std::string_view bytes(reinterpret_cast<const char*>(range.pixels().data()), range.size() * sizeof(float));
  return Cdr()
      .Header(frame.t_ns, TopicName(view) + "_optical")
      .N(static_cast<uint32_t>(range.height()))
      .N(static_cast<uint32_t>(range.width()))
      .Text("32FC1")
      .N(uint8_t{0})
      .N(static_cast<uint32_t>(range.width() * sizeof(float)))
      .Octets(bytes)
      .Take();
}

std::string ImuMessage(const ImuRow& row) {
  Cdr cdr;
  cdr.Header(row.t_ns, "base_link").N(0.0).N(0.0).N(0.0).N(1.0);
  cdr.N(-1.0);  // no orientation
  for (int i = 1; i < 9; ++i) cdr.N(0.0);
  cdr.Vector(row.w);
  for (int i = 0; i < 9; ++i) cdr.N(0.0);
  cdr.Vector(row.f);
  for (int i = 0; i < 9; ++i) cdr.N(0.0);
  return cdr.Take();
}

// A box of everyone in the world, with the behaviour as text.
std::string People(const ExportJob& job, const NativeFrame& frame, const View& view) {
  const std::vector<Json> persons = job.data.Persons(frame, view);
  Cdr cdr;
  cdr.N(static_cast<uint32_t>(persons.size()));
  for (const Json& person : persons) {
    const Json &box = person.at("box3d_world"), &c = box.at("center"), &lwh = box.at("lwh");
    cdr.Header(frame.t_ns, "map").Text("people").N(person.at("track_id").get<int32_t>()).N(int32_t{1}).N(int32_t{0});  // cube, add
    cdr.Vector({c.at(0), c.at(1), c.at(2)}).Rotation(RotationZ(box.at("yaw").get<double>()));
    cdr.Vector({lwh.at(0), lwh.at(1), lwh.at(2)});
    cdr.N(1.0f).N(0.5f).N(0.0f).N(0.5f);             // half-clear orange
    cdr.N(int32_t{0}).N(uint32_t{0}).N(uint8_t{0});  // for ever, not locked
    cdr.N(uint32_t{0}).N(uint32_t{0}).Text("");      // no points, colours, texture
    cdr.Header(0, "").Text("").N(uint32_t{0}).N(uint32_t{0});
    cdr.Text(person.value("behaviour", std::string())).Text("").Text("").N(uint32_t{0}).N(uint8_t{0});
  }
  return cdr.Take();
}

struct Message {
  uint16_t channel;
  std::string data;
};

}  // namespace

void ExportMcap(ExportJob& job) {
  const std::vector<View>& views = job.data.views();
  McapFile file(job.out, "dataset.mcap", "ros2");
  const auto channel = [&](const std::string& topic, const RosType& type) { return file.AddChannel(topic, type.name, type.definition); };
  const bool colour = job.data.Has("rgb"), people = job.data.HasPeople();
  const uint16_t odometry = channel("/odom", OdometryType()), tf = channel("/tf", TfMessageType());
  std::vector<uint16_t> pictures, ranges, persons;
  for (const View& view : views) {
    const std::string name = "/" + TopicName(view);
    if (colour) pictures.push_back(channel(name + "/image/compressed", CompressedImageType()));
    ranges.push_back(channel(name + "/range", ImageType()));
  }
  if (people) persons.push_back(channel("/gt/humans", MarkerArrayType()));
  std::vector<ImuRow> imu;
  if (const auto path = FindImu(job.data.folder()); !path.empty()) imu = ReadImu(path);
  const uint16_t imu_channel = imu.empty() ? 0 : channel("/imu", ImuType());
  size_t next_imu = 0;
  const auto tell_imu = [&](int64_t until) {
    for (; next_imu < imu.size() && imu[next_imu].t_ns <= until; ++next_imu)
      file.AddMessage(imu_channel, imu[next_imu].t_ns, ImuMessage(imu[next_imu]));
  };
  job.EachFrame(
      [&](const NativeFrame& frame) {
        std::vector<Message> messages = {{odometry, Odometry(frame, views.front())}, {tf, Transforms(frame, views)}};
        for (size_t v = 0; v < views.size(); ++v) {
          if (colour) messages.push_back({pictures[v], Compressed(job, frame, views[v])});
          messages.push_back({ranges[v], Range(job, frame, views[v])});
        }
        if (people) messages.push_back({persons.front(), People(job, frame, views.front())});
        return messages;
      },
      [&](const NativeFrame& frame, const std::vector<Message>& messages) {
        tell_imu(frame.t_ns);
        for (const Message& message : messages) file.AddMessage(message.channel, frame.t_ns, message.data);
      });
  tell_imu(INT64_MAX);
  file.Finish();
  job.notes["imu_messages"] = imu.size();
}

}  // namespace airsim360::internal
