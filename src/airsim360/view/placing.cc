#include "airsim360/view/placing.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "airsim360/base/error.h"
#include "airsim360/base/nearest_name.h"
#include "airsim360/sim/traffic/traffic.h"
#include "airsim360/traffic/place_vehicle.h"

namespace airsim360 {

using Json = nlohmann::ordered_json;

std::string CarsJson(const SimLoop& loop) {
  Json said{{"cars", Json::array()}};
  if (const auto& traffic = loop.model().traffic) {
    const TrafficState& state = *loop.state().traffic;
    for (size_t i = 0; i < traffic->bodies.size(); ++i) {
      const Vec3d p = PoseOf(traffic->model, state, i, state.t_ns).p;
      said["cars"].push_back({{"name", traffic->bodies[i].name}, {"kind", traffic->bodies[i].kind}, {"p", {p.x, p.y, p.z}}});
    }
  }
  return said.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void BringCar(SimLoop& loop, const std::string& name, Vec3d p) {
  const auto& traffic = loop.model().traffic;
  if (!traffic) throw InputError("nothing drives in this world; start 'airsim360 view' with --traffic N");
  const auto found = std::ranges::find(traffic->bodies, name, &TrafficBody::name);
  if (found == traffic->bodies.end()) {
    std::vector<std::string> names;
    for (const TrafficBody& body : traffic->bodies) names.push_back(body.name);
    throw InputError("car: nothing is called '" + name.substr(0, 100) + "'" + DidYouMean(name, names));
  }
  auto changed = std::make_shared<TrafficState>(
      WithVehicleAt(traffic->model, *loop.state().traffic, static_cast<uint32_t>(found - traffic->bodies.begin()), p));
  loop.Edit().traffic = std::move(changed);
}

}  // namespace airsim360
