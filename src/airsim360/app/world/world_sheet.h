// `airsim360 world sheet`: a world from many places at once, with figures about its pictures.
#pragma once

#include <string>
#include <vector>

#include "airsim360/app/flags/commands.h"
#include "airsim360/render/render_settings.h"

namespace airsim360 {

struct SheetArguments {
  std::string world, out;
  RenderSettings picture;
  int poses = 16;
  int width = 512;
  std::vector<double> heights{1.6, 12, 40, 100};
};

/// Renders `poses` places at each height as panoramas, writes them as one sheet (.jpg or .png) and prints
/// mean brightness, albedo, clipping and what can be seen of each category. InputError for wrong flags.
void RunWorldSheet(const SheetArguments& arguments, const GlobalOptions& globals);

}  // namespace airsim360
