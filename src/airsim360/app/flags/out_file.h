// Whether a result can be written, before the work that it comes from.
#pragma once

#include <string>

namespace airsim360 {

/// Makes the folder of a file that a command ends in. InputError naming `--out` if the file is a folder, RuntimeError naming
/// the folder if it cannot be made or written into. An empty name is none.
void CheckOutFile(const std::string& file);

}  // namespace airsim360
