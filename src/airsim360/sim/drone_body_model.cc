// INTERIM: pilot's DroneBody replaces it.
#include "airsim360/sim/drone_bodies.h"
#include "airsim360/worlds/mesh_builder.h"

namespace airsim360 {

Model MakeDroneBody(const DroneModel& drone) {
  Model model;
  model.materials.resize(1);
  MeshBuilder builder;
  const Vec3f h = VecCast<float>(drone.half_size_B * 0.4);
  builder.Box(-h, h);
  for (const RotorModel& rotor : drone.rotors) {
    const Vec3f p = VecCast<float>(rotor.p_B);
    builder.Beam({0, 0, 0}, p, 0.01f);
    builder.Tube(p, p + Vec3f{0, 0, 0.01f}, static_cast<float>(rotor.diameter / 2),
                 static_cast<float>(rotor.diameter / 2), 16);
  }
  model.mesh = builder.Finish(drone.name);
  return model;
}

}  // namespace airsim360
