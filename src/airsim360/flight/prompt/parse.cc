#include "airsim360/flight/prompt/request.h"

#include "airsim360/flight/prompt/plain_text.h"
#include "airsim360/flight/prompt/reader.h"

namespace airsim360 {

DroneRequest ParsePrompt(std::string_view prompt) { return internal::ReadPrompt(prompt); }

bool NamesRealDrone(std::string_view words) {
  std::string key;
  for (const char c : internal::PlainText(words)) {
    if (c != ' ' && c != '-') key += c;
  }
  return internal::FindKnownModel(key) != nullptr;
}

std::string PromptHelp() {
  std::string help =
      "A description is ordinary words; what carries no figure is listed as not used. Understood are\n"
      "  real drones    a Mavic 3, like an F450, a Crazyflie but twice as heavy\n"
      "  mass           250 g, 1.2 kg, 3 lb, AUW 2 kg, empty weight 1 kg, 2 kg payload, a GoPro, 10 litres\n"
      "  propellers     five-inch, 9 inch propellers, 47 mm props, 5x4.3x3, 9450 props, 3-blade\n"
      "  size           450 mm wheelbase, 12 cm arms, 250 class\n"
      "  rotors         quad, hexacopter, octo, 6 rotors; layout X, plus, H, wide X, coaxial X8, Y6; ducts\n"
      "  flight         20 m/s, 80 km/h, 45 mph, 25 minutes, hovers 20 minutes, thrust to weight 4\n"
      "  battery        4S, 1500 mAh, 77 Wh, li-ion, two 16 Ah packs in parallel; motors 920 KV\n"
      "  journey        at 4000 m altitude, flies 20 km: refused where thrust or energy do not suffice\n";
  const auto list = [&](const char* title, internal::WordKind kind) {
    help += title;
    for (const internal::Word& word : internal::NounWords()) {
      if (word.kind != kind) continue;
      std::string aliases(word.aliases.substr(0, word.aliases.find('|')));
      help += " " + aliases;
    }
    help += "\n";
  };
  help += "  known drones  ";
  for (const auto models : {internal::DjiModels(), internal::OtherModels(), internal::BuilderModels()}) {
    for (const internal::KnownModel& model : models) help += " " + std::string(model.title) + ",";
  }
  help.back() = '\n';
  list("  kinds         ", internal::WordKind::kClass);
  list("  sizes         ", internal::WordKind::kSize);
  return help;
}

}  // namespace airsim360
