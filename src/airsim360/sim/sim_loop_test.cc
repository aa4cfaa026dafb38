// What the owner of a stepping loop may do between and after its steps.
#include "airsim360/sim/sim_loop.h"

#include <gtest/gtest.h>

#include "airsim360/sim/test_flights.h"

namespace airsim360 {
namespace {

using internal::HummingbirdAt;
using internal::RoomModel;

std::shared_ptr<SimModel> OneDrone() { return RoomModel({HummingbirdAt({0, 0, 3})}); }

constexpr auto kAlways = [](const SimState&, std::span<const SimEvent>) { return true; };

TEST(SimLoop, AdvanceWhileStopsAfterTheStepThatSaysSo) {
  SimLoop loop(OneDrone()), plain(OneDrone());
  const int64_t taken = loop.AdvanceWhile(100, [](const SimState& state, std::span<const SimEvent>) { return state.step < 7; });
  EXPECT_EQ(taken, 7);
  EXPECT_EQ(loop.state().step, 7);
  EXPECT_EQ(loop.AdvanceWhile(5, kAlways), 5);
  // The states are those of steps that nobody looks at.
  plain.Advance(12);
  EXPECT_EQ(HashState(loop.state()), HashState(*plain.Snapshot()));
}

TEST(SimLoop, AdvanceWhileTellsTheEventsOfEachStepAndKeepsTheOthers) {
  SimLoop loop(OneDrone());
  // Down to the floor: a collision.
  loop.Post({0, FlightCommand{VelocityCommand{.v = {0, 0, -4}}}});
  size_t told = 0;
  loop.AdvanceWhile(3000, [&](const SimState&, std::span<const SimEvent> happened) {
    told += happened.size();
    return told == 0;
  });
  EXPECT_GT(told, 0u);
  EXPECT_TRUE(loop.TakeEvents().empty());
}

TEST(SimLoop, AnEditedStateAndAnotherModelAreWhatTheNextStepSees) {
  SimLoop loop(OneDrone());
  loop.Edit().wind_W = {3, 0, 0};
  loop.Advance(500);
  SimLoop calm(OneDrone());
  calm.Advance(500);
  EXPECT_NE(HashState(loop.state()), HashState(calm.state()));
  auto finer = std::make_shared<SimModel>(loop.model());
  finer->wind.shelter = true;
  loop.SetModel(finer);
  EXPECT_TRUE(loop.model().wind.shelter);
}

TEST(SimLoop, ChangesByHandEndARecordingWhichCouldNotRepeatThem) {
  SimLoop loop(OneDrone());
  loop.StartRecording("by hand");
  loop.Advance(3);
  loop.Edit();
  EXPECT_FALSE(loop.StopRecording().has_value());
  loop.StartRecording("steps alone");
  loop.AdvanceWhile(4, kAlways);
  const auto recording = loop.StopRecording();
  ASSERT_TRUE(recording.has_value());
  EXPECT_EQ(recording->steps, 4);
}

}  // namespace
}  // namespace airsim360
