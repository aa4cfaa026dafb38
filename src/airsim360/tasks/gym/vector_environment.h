// Many drones that learn at once: each in a copy of the same world of its own, all stepped and seen in one
// call. Arrays hold one row an environment and stay where they are: views of them are never copied.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "airsim360/render/renderer.h"
#include "airsim360/sensors/rig.h"
#include "airsim360/sim/sim_loop.h"
#include "airsim360/stage/stage.h"
#include "airsim360/tasks/gym/navigation_task.h"

namespace airsim360 {

/// What the numbers of an action mean; each is in [-1, 1], others are clamped.
enum class ActionLevel {
  kVelocity,  ///< 4: velocity ahead, left, up in the level frame of the heading; turning rate, left positive
  kRates,     ///< 4: thrust (-1 none … 1 full), roll, pitch and yaw rate about B's axes
  kRotors,    ///< one a rotor: -1 stands still … 1 full static thrust
};
inline constexpr const char* kActionLevelNames[] = {"velocity", "rates", "rotors"};
/// Level of a name; InputError naming the nearest if there is none.
ActionLevel ParseActionLevel(std::string_view name);

struct VectorEnvironmentOptions {
  int count = 1;
  DroneModel drone;
  ActionLevel action = ActionLevel::kVelocity;
  double max_speed = 3, max_turn = 1.5;                             ///< m/s, rad/s of action 1 at level velocity
  double max_rate = 6;                                              ///< rad/s of action 1 at level rates
  double period = 0.1;                                              ///< seconds of a step, a whole number of milliseconds, even
  int width = 128, height = 64;                                     ///< of the panoramas; width = 2 height
  PictureSettings picture = {};                                     ///< how they are made
  bool rgb = true, range = true, semantic = false, entity = false;  ///< panoramas that are made; rgb needs light
  bool auto_reset = true;  ///< an environment that has ended begins anew in the next step, which does nothing
                           ///< else there (reward 0); off: such a step is an InputError
  uint64_t seed = 0;
};

/// Columns of state(): float32. Level frame L: at B, +Z up, +X along the heading.
struct StateColumns {
  static constexpr int kGoal = 0;        ///< 3: goal less place in L, metres; search: 0
  static constexpr int kVelocity = 3;    ///< 3: in L, m/s
  static constexpr int kUp = 6;          ///< 3: +Z of W in B
  static constexpr int kRates = 9;       ///< 3: angular velocity in B, rad/s
  static constexpr int kClearance = 12;  ///< metres to the nearest surface, at most 2
  static constexpr int kTimeLeft = 13;   ///< share of the episode's time, 1 … 0
  static constexpr int kHeading = 14;    ///< 2: cosine and sine of the heading in W
  static constexpr int kTarget = 16;     ///< search: category id of the target, else 0
  static constexpr int kCount = 17;
};

/// Not for several threads at once; each call uses all of them. The same seed and actions give the same bytes
/// with any number of threads.
class VectorEnvironment {
 public:
  /// InputError naming the option that makes no sense. Begins with Reset(options.seed).
  VectorEnvironment(std::shared_ptr<Stage> stage, const NavigationTask& task, const VectorEnvironmentOptions& options);
  ~VectorEnvironment();

  int count() const { return options_.count; }
  int action_size() const;
  const VectorEnvironmentOptions& options() const { return options_; }
  const NavigationWorld& world() const { return world_; }

  /// All environments begin: with episode 0 of `seed`, or with their next episodes; these first ones as wished
  /// (one wish for all, or one each). InputError as NavigationWorld::Wished, and then nothing has changed.
  void Reset(std::optional<uint64_t> seed, std::span<const EpisodeWish> wishes = {});
  /// `actions`: [count][action_size]. InputError for another size, or for a number that is none (naming
  /// environment and place), and then nothing has changed.
  void Step(std::span<const float> actions);

  // Rows of all environments, valid as long as this lives. Panoramas that are not made are empty.
  std::span<const Rgb8> rgb() const { return rgb_; }       ///< [count][height][width]
  std::span<const float> range() const { return range_; }  ///< metres, 0 = sky
  std::span<const CategoryId> semantic() const { return semantic_; }
  std::span<const EntityId> entity() const { return entity_; }
  std::span<const float> state() const { return state_; }  ///< [count][StateColumns::kCount]
  std::span<const float> reward() const { return reward_; }
  std::span<const uint8_t> terminated() const { return terminated_; }  ///< reached or crashed
  std::span<const uint8_t> truncated() const { return truncated_; }    ///< out of time
  std::span<const uint8_t> reached() const { return reached_; }
  std::span<const uint8_t> crashed() const { return crashed_; }
  std::span<const float> distance() const { return distance_; }  ///< to the goal, metres
  std::span<const int64_t> steps() const { return steps_; }      ///< of the present episode

  /// Of environment i.
  const SimState& sim_state(int i) const { return lanes_[static_cast<size_t>(i)].loop->state(); }
  const NavigationEpisode& episode(int i) const { return lanes_[static_cast<size_t>(i)].episode; }
  /// Hash of all states.
  uint64_t Hash() const;

 private:
  /// One environment.
  struct Lane {
    std::unique_ptr<SimLoop> loop;
    NavigationEpisode episode;
    uint64_t number = 0;  ///< of the episode
    bool ended = false;
  };
  /// One thread's renderer.
  struct Slot {
    std::unique_ptr<Renderer> renderer;
    Capture capture;
  };

  void Begin(size_t i, const NavigationEpisode& episode);
  Command CommandOf(std::span<const float> action) const;
  void StepLane(size_t i, std::span<const float> action, Slot& slot);
  TargetSight Look(size_t i, Slot& slot);
  void FillState(size_t i);
  /// Calls body(i, slot) for every environment, in parallel.
  template <class Body>
  void ForAll(const Body& body);

  VectorEnvironmentOptions options_;
  std::shared_ptr<Stage> stage_;
  NavigationWorld world_;
  std::shared_ptr<const SimModel> model_;
  std::vector<Lane> lanes_;
  std::vector<std::unique_ptr<Slot>> slots_;
  uint64_t seed_ = 0;
  std::vector<Rgb8> rgb_;
  std::vector<float> range_, state_, reward_, distance_;
  std::vector<CategoryId> semantic_;
  std::vector<EntityId> entity_;
  std::vector<uint8_t> terminated_, truncated_, reached_, crashed_;
  std::vector<int64_t> steps_;
};

}  // namespace airsim360
