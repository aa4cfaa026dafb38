#include "airsim360/vln/agents/observation.h"

#include <cmath>
#include <numbers>

namespace airsim360::internal {

VlnJson ObservationJson(const VlnSituation& s) {
  const Viewpoint pose = s.Pose();
  const Vec2d from = InHeading(s.episode.start, pose.p_W);
  const double turned = std::remainder(s.episode.start.yaw - pose.yaw, 2 * std::numbers::pi) * 180 / std::numbers::pi;
  return {{"episode", s.episode.id},
          {"instruction", s.episode.instruction},
          {"step", s.step},
          {"steps_left", s.steps_left},
          {"decisions", kDecisionNames[static_cast<int>(s.decisions)]},
          {"view", kViewNames[static_cast<int>(s.eyes.view())]},
          {"answer", AnswerGrammar(s.decisions)},
          {"from_start",
           {{"forward_m", Rounded(from.x)},
            {"left_m", Rounded(from.y)},
            {"up_m", Rounded(pose.p_W.z - s.episode.start.p_W.z)},
            {"turned_right_deg", Rounded(turned)}}},
          {"seconds", Rounded(s.flight.seconds())},
          {"told", s.told}};
}

std::string Tame(std::string_view text, size_t longest) {
  std::string tame;
  for (size_t i = 0; i < text.size() && tame.size() < longest; ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    tame += c == '\n' || c == '\t' ? ' ' : c < 32 || c > 126 ? '?' : static_cast<char>(c);
  }
  return tame;
}

}  // namespace airsim360::internal
