// Scanned buildings: the light of their rooms is in their colours already, and nothing else shines on them.
#pragma once

#include <string>

#include "airsim360/assets/imported.h"

namespace airsim360::internal {

/// What speaks for light that is in the colours; "" = nothing does. Rooms are told by ceilings above floors. Either most of
/// what they show is of unlit materials, or all of it has pictures or vertex colours, nothing shines, and nothing but the
/// file's name says what anything is (`named` false), as of a scan.
std::string WhyBaked(const ImportedFile& file, bool named);

/// The light that shows baked colours as they are: what rooms by day have.
Vec3f LightOfBakedRooms();

/// A guess that a scan lies on its side, with the way round; "" where nothing speaks for it.
std::string GuessUp(const ImportedFile& file, const std::string& as_read);

}  // namespace airsim360::internal
