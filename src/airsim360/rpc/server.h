// The whole AirSim-compatible server: socket, session, pictures, functions.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "airsim360/render/renderer.h"
#include "airsim360/rpc/session/scene_extras.h"
#include "airsim360/rpc/settings/settings.h"
#include "airsim360/rpc/wire/tcp_server.h"
#include "airsim360/stage/stage.h"

namespace airsim360 {

struct ServerOptions {
  AirSimSettings settings = DefaultSettings();
  std::string address = "127.0.0.1";
  int port = 41451;  ///< 0 = any free one
  bool lockstep = false;
  RenderSettings picture = {};  ///< how colour pictures are made
  TcpLimits limits = {};
  std::vector<SpawnAsset> assets = ShapeAssets();  ///< what simSpawnObject can make
};

/// For StageOptions::bodies: drones and what calls can put into the world. A server adds them itself to a stage without
/// bodies, at the cost of a copy of its scene.
BodiesOfScene ServedBodies(const ServerOptions& options);

/// Serves from its construction to its end. See docs/reference/airsim_functions.md for what each function does.
class AirSimServer {
 public:
  /// `stage` has no bodies, or those of ServedBodies(options). RuntimeError if the port cannot be had.
  AirSimServer(std::shared_ptr<Stage> stage, const ServerOptions& options);
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
