// Rooms with doors, for the RiMEA tests and for figures of flow.
#pragma once

#include <cmath>
#include <vector>

#include "airsim360/people/crowd/test_crowd.h"

namespace airsim360::internal {

/// Takes people out of the world once they are where `out` says; how many are left.
template <class Out>
size_t TakeOut(TestCrowd& crowd, const Out& out) {
  size_t left = 0;
  for (PersonIndex i = 0; i < crowd.state.people.size(); ++i) {
    if (!crowd[i].visible) continue;
    if (out(crowd[i].p_WP)) {
      crowd.Do(i, RemovePerson{});
    } else {
      ++left;
    }
  }
  return left;
}

struct DoorRun {
  double seconds = 0;  ///< until the room was empty, or gave up
  double flow = 0;     ///< people a second and door, from the first tenth that left to the last
  double closest = 1e9;
  size_t left = 0;
};

/// RiMEA test 9 (after IMO MSC/Circ. 1238, annex 3, test 9): a room of width x depth metres, people spread evenly,
/// doors of 1 m at a quarter and three quarters of its long walls. With `two`, those of the north wall are shut.
inline DoorRun EmptyRoom(double width, double depth, PersonIndex people, bool two, double door = 1.0) {
  const auto w = static_cast<float>(width), d = static_cast<float>(depth), h = static_cast<float>(door / 2);
  TestGround ground;
  ground.Floor("ground/floor", -0.5f, -3, w + 0.5f, d + 3);
  for (const float y : {-0.1f, d + 0.1f}) {
    if (two && y > 0) {
      ground.Wall(-0.5f, y, w + 0.5f, y);
      continue;
    }
    // A wall reaches 0.1 m beyond its ends.
    ground.Wall(-0.5f, y, w / 4 - h - 0.1f, y);
    ground.Wall(w / 4 + h + 0.1f, y, 3 * w / 4 - h - 0.1f, y);
    ground.Wall(3 * w / 4 + h + 0.1f, y, w + 0.5f, y);
  }
  ground.Wall(-0.1f, 0, -0.1f, d);
  ground.Wall(w + 0.1f, 0, w + 0.1f, d);
  TestCrowd crowd(ground.Build(), ReserveOf(people));
  const double step = std::sqrt((width - 1) * (depth - 1) / people);
  const auto columns = static_cast<PersonIndex>((width - 1) / step) + 1;
  const double rows = std::ceil(static_cast<double>(people) / columns), dy = (depth - 1) / std::max(1.0, rows - 1);
  for (PersonIndex i = 0; i < people; ++i) {
    const double x = 0.5 + (width - 1) * (i % columns) / (columns - 1), y = 0.5 + dy * static_cast<double>(i / columns);
    crowd.Do(i, SpawnPerson{{x, y, 0}, 0});
    crowd.Do(i, SendPerson{{x < width / 2 ? width / 4 : 3 * width / 4, two || y < depth / 2 ? -2.0 : depth + 2.0, 0}, 1.34});
  }
  DoorRun run;
  size_t left = people;
  double from = 0;
  size_t of = 0;
  run.seconds = crowd.Run(1200, [&] {
    left = TakeOut(crowd, [&](Vec3d p) { return p.y < -0.8 || p.y > depth + 0.8; });
    if (from == 0 && left < people * 9 / 10) {
      from = static_cast<double>(crowd.state.t_ns) * 1e-9;
      of = left;
    }
    if (crowd.state.t_ns % 2'000'000'000 == 0) run.closest = std::min(run.closest, crowd.Closest());
    return left == 0;
  });
  run.left = left;
  run.flow = static_cast<double>(of - left) / (run.seconds - from) / (two ? 2 : 4);
  return run;
}

struct CorridorRun {
  double first = 0, second = 0;  ///< people who stand (slower than 0.4 m/s) in the 4 m before each bottleneck, on average
                                 ///< while the flow lasts
  double flow = 0;               ///< people a second at the end of the first corridor
  double seconds = 0;
  size_t left = 0;
};

/// RiMEA test 12: two rooms of 10 x 10 m in line, a corridor of `width` x 5 m between them and one behind.
inline CorridorRun RunCorridors(PersonIndex people, double width = 1.0) {
  const auto h = static_cast<float>(width / 2);
  TestGround ground;
  ground.Floor("ground/floor", -0.5f, -0.5f, 33, 10.5f);
  for (const float x : {0.0f, 15.0f}) {  // what is solid around a room and its corridor
    ground.Box("construction/wall", {x - 0.2f, -0.2f, -0.2f}, {x + 17, 0, 3});
    ground.Box("construction/wall", {x - 0.2f, 10, -0.2f}, {x + 17, 10.2f, 3});
    ground.Box("construction/wall", {x + 10, 0, -0.2f}, {x + 15, 5 - h, 3});
    ground.Box("construction/wall", {x + 10, 5 + h, -0.2f}, {x + 15, 10, 3});
  }
  ground.Box("construction/wall", {-0.2f, -0.2f, -0.2f}, {0, 10.2f, 3});
  ground.Box("construction/wall", {30, 0, -0.2f}, {32, 5 - h, 3});
  ground.Box("construction/wall", {30, 5 + h, -0.2f}, {32, 10, 3});
  TestCrowd crowd(ground.Build(), ReserveOf(people));
  const double step = std::sqrt(7.0 * 9.0 / (people * 1.12));
  PersonIndex i = 0;
  for (double y = 0.5; y <= 9.5 && i < people; y += step)
    for (double x = 0.5; x <= 7.2 && i < people; x += step, ++i) {
      crowd.Do(i, SpawnPerson{{x, y, 0}, 0});
      crowd.Do(i, SendPerson{{31.5, 5, 0}, 1.34});
    }
  CorridorRun run;
  double samples = 0, from = 0, to = 0;
  size_t beyond_from = 0, beyond_to = 0;
  run.seconds = crowd.Run(1200, [&] {
    size_t room = 0, at_first = 0, at_second = 0, before = 0;
    for (PersonIndex k = 0; k < people; ++k) {
      if (!crowd[k].visible) continue;
      const double x = crowd[k].p_WP.x;
      room += x < 10;
      before += x < 15;
      const bool stands = Norm(crowd[k].v_WP) < 0.4;
      at_first += stands && x > 6 && x < 10;
      at_second += stands && x > 21 && x < 25;
    }
    const double t = static_cast<double>(crowd.state.t_ns) * 1e-9;
    const size_t beyond = people - before;
    if (from == 0 && beyond >= people / 10) from = t, beyond_from = beyond;
    if (room > people / 5) to = t, beyond_to = beyond;  // the queue lasts
    if (t > 25 && room > people / 5) {
      run.first += static_cast<double>(at_first);
      run.second += static_cast<double>(at_second);
      ++samples;
    }
    run.left = TakeOut(crowd, [](Vec3d p) { return p.x > 30; });
    return run.left == 0;
  });
  run.first /= std::max(1.0, samples);
  run.second /= std::max(1.0, samples);
  if (to > from) run.flow = static_cast<double>(beyond_to - beyond_from) / (to - from);
  return run;
}

}  // namespace airsim360::internal
