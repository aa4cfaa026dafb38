// The whole AirSim-compatible server: socket, session, pictures, functions.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "airsim360/render/renderer.h"
#include "airsim360/render/vulkan/choose_renderer.h"
#include "airsim360/rpc/scene_extras.h"
#include "airsim360/rpc/settings.h"
#include "airsim360/rpc/tcp_server.h"
#include "airsim360/sim/step.h"

namespace airsim360 {

struct ServerOptions {
  AirSimSettings settings = DefaultSettings();
  Environment environment = {};
  std::string address = "127.0.0.1";
  int port = 41451;  ///< 0 = any free one
  bool lockstep = false;
  Tier tier = Tier::kFast;
  DeviceChoice device = {.device = "cpu"};  ///< that draws the pictures
  uint64_t seed = 0;
  TcpLimits limits = {};
  std::shared_ptr<const SimPeople> people = nullptr;  ///< of the scene (Populate); null = nobody
  std::vector<SpawnAsset> assets = ShapeAssets();     ///< what simSpawnObject can make
};

/// Serves from its construction to its end. See docs/reference/airsim_functions.md for what each function does.
class AirSimServer {
 public:
  /// RuntimeError if the port cannot be had.
  AirSimServer(std::shared_ptr<const Scene> scene, const ServerOptions& options);
  ~AirSimServer();
  AirSimServer(const AirSimServer&) = delete;
  AirSimServer& operator=(const AirSimServer&) = delete;

  int port() const;
  /// Every function that can be called.
  std::vector<std::string> Methods() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360
