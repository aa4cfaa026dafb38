// Writes what AirSim's recording writes: airsim_rec.txt and images/ in a folder of its own.
#pragma once

#include "airsim360/rpc/images/image_service.h"

namespace airsim360 {

/// Makes the recordings of a session from now on, each in a new folder, and starts one if the settings say so. `images`
/// must outlive the session.
void WriteRecordings(Session& session, ImageService& images);

}  // namespace airsim360
