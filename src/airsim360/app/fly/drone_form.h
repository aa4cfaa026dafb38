// The form that words about a drone fill (DroneRequest), as JSON: what a language model may write.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "airsim360/flight/prompt/request.h"

namespace airsim360 {

/// The JSON schema of the form: each field with its meaning, unit and range.
nlohmann::ordered_json DroneFormSchema();

/// Reads a filled form, one flat JSON object, in the way that ParsePrompt reads words. A field that is left out or
/// null is open. `prompt` is what the user said. InputError for what is no JSON object, unknown and repeated fields
/// (with the nearest one), wrong types, figures out of range or that contradict each other, and a form that says
/// nothing.
DroneRequest ReadDroneForm(std::string_view text, std::string_view prompt);

}  // namespace airsim360
