// CityJSON 1.0, 1.1 and 2.0 (cityjson.org/specs), also as a stream of features (CityJSONSeq).
#pragma once

#include <string>
#include <string_view>

#include "airsim360/assets/imported.h"
#include "airsim360/assets/limits.h"

namespace airsim360::internal {

/// Throws InputError for JSON of another kind, naming it (JSON-FG, GeoJSON). Reads the members
/// of the outermost object up to "type", in any order, without keeping what lies between. Damage passes:
/// ReadCityJson names its place.
void CheckIsCityJson(const std::string& file, std::string_view text);

/// One node for each city object and kind of its surfaces: "ID" and, where the file tells them apart, "ID/roof",
/// "ID/window", "ID/door"; labelled by the object's type. Geometry of the highest level of detail; surfaces,
/// solids and templates (GeometryInstance). W: east, north, up of the file's reference system (degrees are brought
/// to metres), the middle of all vertices at x = y = 0, the lowest at z = 0. InputError "file: /pointer: …" for
/// damage.
ImportedFile ReadCityJson(const std::string& file, std::string_view text, const ImportLimits& limits = {});

}  // namespace airsim360::internal
