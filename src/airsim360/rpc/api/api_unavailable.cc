// Calls whose subject does not exist here (an engine's console, materials, lights, film backs; cars): they
// answer as AirSim does when it finds nothing to act on, and a notice goes to the log. docs/reference/airsim_functions.md lists
// them.
#include "airsim360/rpc/api/api.h"

namespace airsim360 {
namespace {

using Text = const std::string&;
using airsim::CameraName;
using airsim::External;

struct CarControls {
  float throttle = 0, steering = 0, brake = 0;
  bool handbrake = false, is_manual_gear = false, gear_immediate = true;
  int manual_gear = 0;
  template <class V>
  void Visit(V& v) {
    v("throttle", throttle), v("steering", steering), v("brake", brake), v("handbrake", handbrake);
    v("is_manual_gear", is_manual_gear), v("manual_gear", manual_gear), v("gear_immediate", gear_immediate);
  }
};

/// A structure of which no field matters.
struct AnyMap {
  template <class V>
  void Visit(V&) {}
};

void Notice(const char* name, const char* why) { NoticeOnce(std::string(name) + ": " + why); }

/// Calls about the lens of a camera, which must exist: `Arguments` come before the name of the camera, and the answer is
/// an empty `Result`.
template <class Result, class... Arguments>
void AddLensCall(Api& api, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    api.Read(
        name,
        [name](const Snapshot& now, Arguments..., const CameraName& camera, Text vehicle, const External&) {
          FindCamera(now.world->cameras[now.Find(vehicle)], camera.text);
          Notice(name, "cameras here are pinholes without lens or film back");
          return Result();
        },
        1);
  }
}

void AddLensCalls(Api& api) {
  AddLensCall<std::vector<std::string>>(api, {"simGetPresetLensSettings", "simGetPresetFilmbackSettings"});
  AddLensCall<std::string>(api, {"simGetLensSettings", "simGetFilmbackSettings"});
  AddLensCall<float>(api, {"simGetFocalLength", "simGetFocusDistance", "simGetFocusAperture"});
  AddLensCall<void, Text>(api, {"simSetPresetLensSettings", "simSetPresetFilmbackSettings"});
  AddLensCall<void, float>(api, {"simSetFocalLength", "simSetFocusDistance", "simSetFocusAperture"});
  AddLensCall<void, bool>(api, {"simEnableManualFocus", "simEnableFocusPlane"});
  AddLensCall<float, float, float>(api, {"simSetFilmbackSettings"});
}

void AddEngineCalls(Api& api) {
  static constexpr const char* kEngine = "there is no game engine behind this server";
  static constexpr const char* kMaterials = "materials of a world do not change";
  static constexpr const char* kLights = "lights of a world do not change";
  api.Read("simRunConsoleCommand", [](const Snapshot&, Text) { return Notice("simRunConsoleCommand", kEngine), false; });
  api.Read("simLoadLevel",
           [](const Snapshot&, Text) { return Notice("simLoadLevel", "the world is chosen with airsim360 serve --world"), false; });
  api.Read("simGetMeshPositionVertexBuffers", [](const Snapshot&) {
    Notice("simGetMeshPositionVertexBuffers", "use airsim360 world export");
    return std::vector<airsim::MeshPositionVertexBuffersResponse>{};
  });
  api.Read("simSwapTextures",
           [](const Snapshot&, Text, int, int, int) { return Notice("simSwapTextures", kMaterials), std::vector<std::string>{}; });
  for (const char* name : {"simSetObjectMaterial", "simSetObjectMaterialFromTexture"}) {
    api.Read(name, [name](const Snapshot&, Text, Text, int) { return Notice(name, kMaterials), false; });
  }
  for (const char* name : {"simSetLightIntensity", "simSetWorldLightIntensity"}) {
    api.Read(name, [name](const Snapshot&, Text, float) { return Notice(name, kLights), false; });
  }
  api.Read("simSetWorldLightVisibility", [](const Snapshot&, Text, bool) { return Notice("simSetWorldLightVisibility", kLights), false; });
  api.Read("simSetVehicleLightVisibility",
           [](const Snapshot&, Text, Text, bool) { return Notice("simSetVehicleLightVisibility", kLights), false; });
  api.Read("simSetVehicleLightIntensity",
           [](const Snapshot&, Text, Text, float) { return Notice("simSetVehicleLightIntensity", kLights), false; });
  for (const char* name : {"simSetAnnotationObjectTextureByPath"}) {
    api.Read(name, [name](const Snapshot&, Text, Text, Text, bool) { return Notice(name, kMaterials), false; });
  }
  api.Read("simEnableAnnotationObjectTextureByPath",
           [](const Snapshot&, Text, Text, bool) { return Notice("simEnableAnnotationObjectTextureByPath", kMaterials), false; });
  api.Read("simGetAnnotationObjectTexturePath", [](const Snapshot&, Text, Text) { return std::string(); });
  api.Read("simSetExtForce",
           [](const Snapshot&, const airsim::Vector3r&) { Notice("simSetExtForce", "forces from outside are wind and contacts"); });
}

void AddOtherVehicleCalls(Api& api) {
  // No vehicle here is a car: what AirSim says of a vehicle whose API is another.
  const auto none = [](const std::string& vehicle) { throw std::runtime_error(NoVehicleText(vehicle)); };
  api.Read("getCarState", [none](const Snapshot&, Text vehicle) { none(vehicle); });
  api.Read("getCarControls", [none](const Snapshot&, Text vehicle) { none(vehicle); });
  api.Read("setCarControls", [none](const Snapshot&, const CarControls&, Text vehicle) { none(vehicle); });
  api.Read("setSafety", [](const Snapshot&, uint32_t, float, int, float, const airsim::Vector3r&, float, float, float, Text) -> bool {
    throw std::invalid_argument("The setSafety call requires safety_eval_ptr_ to be set first");
  });
  api.Read("setEchoData", [](const Snapshot&, Text sensor, Text, const AnyMap&) {
    throw std::runtime_error("No sensor with name " + sensor + " exist on vehicle");
  });
  for (const char* name : {"getEchoData", "getUWBData", "getUWBSensorData", "getWifiData", "getWifiSensorData"}) {
    api.Read(name,
             [](const Snapshot&, Text sensor, Text) { throw std::runtime_error("No sensor with name " + sensor + " exist on vehicle"); });
  }
}

}  // namespace

void AddUnavailableCalls(Api& api) {
  AddLensCalls(api);
  AddEngineCalls(api);
  AddOtherVehicleCalls(api);
}

}  // namespace airsim360
