// --gpu: which GPUs of this machine.
#pragma once

#include <string>
#include <vector>

namespace airsim360 {

/// "1", and where `several` may be given also "0,2" and "all" (those in hardware that trace rays; without any, those in
/// software). InputError naming `--gpu`, the value and the GPUs that there are.
std::vector<int> ParseGpus(const std::string& text, bool several);

}  // namespace airsim360
