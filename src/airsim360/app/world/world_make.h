// `airsim360 world make`: a town or a building from words, as a world file.
#pragma once

#include <string>

#include "airsim360/app/flags/commands.h"

namespace airsim360 {

struct MakeArguments {
  std::string words, out;
};

/// Writes the world file (and NAME.people.yaml where the words speak of people) and prints what became of each word.
/// InputError for words that are not understood or exclude each other, and for a name that is no .yaml.
void RunWorldMake(const MakeArguments& arguments, const GlobalOptions& globals);

}  // namespace airsim360
