#include "airsim360/dataset/export/ros_messages.h"

namespace airsim360::internal {
namespace {

// Field lists of ROS 2's common_interfaces, rcl_interfaces and geometry2.
std::string Part(const std::string& name, const std::string& fields) { return std::string(80, '=') + "\nMSG: " + name + "\n" + fields; }
std::string Header() {
  return Part("std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n") +
         Part("builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n");
}
std::string Vector3() { return Part("geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"); }
std::string Rotation() { return Part("geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"); }
std::string Point() { return Part("geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"); }
std::string Pose() {
  return Part("geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n") + Point() + Rotation();
}

}  // namespace

const RosType& CompressedImageType() {
  static const RosType type{"sensor_msgs/msg/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n" + Header()};
  return type;
}

const RosType& ImageType() {
  static const RosType type{"sensor_msgs/msg/Image",
                            "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\n"
                            "uint32 step\nuint8[] data\n" +
                                Header()};
  return type;
}

const RosType& OdometryType() {
  static const RosType type{"nav_msgs/msg/Odometry",
                            "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
                            "geometry_msgs/TwistWithCovariance twist\n" +
                                Header() + Part("geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose pose\nfloat64[36] covariance\n") +
                                Pose() + Part("geometry_msgs/TwistWithCovariance", "geometry_msgs/Twist twist\nfloat64[36] covariance\n") +
                                Part("geometry_msgs/Twist", "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n") + Vector3()};
  return type;
}

const RosType& TfMessageType() {
  static const RosType type{
      "tf2_msgs/msg/TFMessage",
      "geometry_msgs/TransformStamped[] transforms\n" +
          Part("geometry_msgs/TransformStamped", "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n") +
          Header() + Part("geometry_msgs/Transform", "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n") + Vector3() +
          Rotation()};
  return type;
}

const RosType& ImuType() {
  static const RosType type{"sensor_msgs/msg/Imu",
                            "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\nfloat64[9] orientation_covariance\n"
                            "geometry_msgs/Vector3 angular_velocity\nfloat64[9] angular_velocity_covariance\n"
                            "geometry_msgs/Vector3 linear_acceleration\nfloat64[9] linear_acceleration_covariance\n" +
                                Header() + Rotation() + Vector3()};
  return type;
}

const RosType& MarkerArrayType() {
  static const RosType type{
      "visualization_msgs/msg/MarkerArray",
      "visualization_msgs/Marker[] markers\n" +
          Part("visualization_msgs/Marker",
               "std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\ngeometry_msgs/Pose pose\n"
               "geometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\nbuiltin_interfaces/Duration lifetime\nbool frame_locked\n"
               "geometry_msgs/Point[] points\nstd_msgs/ColorRGBA[] colors\nstring texture_resource\n"
               "sensor_msgs/CompressedImage texture\nvisualization_msgs/UVCoordinate[] uv_coordinates\nstring text\n"
               "string mesh_resource\nvisualization_msgs/MeshFile mesh_file\nbool mesh_use_embedded_materials\n") +
          Header() + Pose() + Vector3() + Part("std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n") +
          Part("builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n") +
          Part("sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n") +
          Part("visualization_msgs/UVCoordinate", "float32 u\nfloat32 v\n") +
          Part("visualization_msgs/MeshFile", "string filename\nuint8[] data\n")};
  return type;
}

}  // namespace airsim360::internal
