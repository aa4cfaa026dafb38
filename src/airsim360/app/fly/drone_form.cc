#include "airsim360/app/fly/drone_form.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/flight/prompt/drone_class.h"
#include "airsim360/flight/prompt/plain_text.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kLongestQuoted = 80;  // bytes of foreign text in a message
constexpr size_t kLongestPrompt = 1000;

struct NumberField {
  const char* name;
  std::optional<double> DroneRequest::*field;
  double low, high;
  const char* unit;
  const char* meaning;
  bool whole = false;
};

// Ranges are those of figures in words (flight/prompt/reader_quantities.cc).
const std::array kNumbers = {
    NumberField{"mass", &DroneRequest::mass, 0.01, 400, "kg", "ready to fly, payload included"},
    NumberField{"empty_mass", &DroneRequest::empty_mass, 0.005, 400, "kg", "ready to fly without payload"},
    NumberField{"payload", &DroneRequest::payload, 0.0005, 1000, "kg", "what is carried"},
    NumberField{"battery_mass", &DroneRequest::battery_mass, 0.001, 200, "kg", "the battery"},
    NumberField{"propeller", &DroneRequest::propeller, 0.02, 1.6, "m", "diameter of a propeller"},
    NumberField{"pitch", &DroneRequest::pitch, 0.005, 1, "m", "pitch of a propeller"},
    NumberField{"blades", &DroneRequest::blades, 2, 6, "", "blades of a propeller", true},
    NumberField{"arm", &DroneRequest::arm, 0.02, 3, "m", "from a motor to the centre: half of the wheelbase"},
    NumberField{"rotors", &DroneRequest::rotors, 4, 8, "", "number of rotors: 4, 6 or 8", true},
    NumberField{"thrust_to_weight", &DroneRequest::thrust_to_weight, 1.05, 20, "", "full thrust over weight"},
    NumberField{"hover_time", &DroneRequest::hover_time, 10, 36000, "s", "hovering on one battery"},
    NumberField{"flight_time", &DroneRequest::flight_time, 10, 36000, "s", "flying on one battery"},
    NumberField{"speed", &DroneRequest::speed, 0.5, 150, "m/s", "top speed in level flight"},
    NumberField{"least_speed", &DroneRequest::least_speed, 0.1, 150, "m/s", "speed reached at least: of a wind, of cruising"},
    NumberField{"cells", &DroneRequest::cells, 1, 24, "", "battery cells in series", true},
    NumberField{"capacity_ah", &DroneRequest::capacity_ah, 0.03, 500, "Ah", "charge of the battery"},
    NumberField{"energy_wh", &DroneRequest::energy_wh, 0.1, 50000, "Wh", "energy of the battery"},
    NumberField{"motor_kv", &DroneRequest::motor_kv, 10, 50000, "rpm/V", "speed of a motor per volt"},
};

struct FlagField {
  const char* name;
  bool DroneRequest::*field;
  const char* meaning;
};

constexpr std::array kFlags = {
    FlagField{"guarded", &DroneRequest::guarded, "propellers in ducts or behind guards"},
    FlagField{"brushless", &DroneRequest::brushless, "brushless motors were said"},
    FlagField{"lithium_ion", &DroneRequest::lithium_ion, "a lithium-ion battery was said"},
};

const std::vector<std::string> kLayouts = {"x", "plus", "h", "wide_x", "coaxial"};  // in the order of RotorLayout
const std::vector<std::string> kSizes = {"tiny", "small", "medium", "large", "huge"};

std::vector<std::string> ClassNames() {
  std::vector<std::string> names;
  for (const DroneClass& drone : DroneClasses()) names.emplace_back(drone.name);
  return names;
}

struct ChoiceField {
  const char* name;
  const char* meaning;
  std::vector<std::string> choices;
};

const std::vector<ChoiceField>& Choices() {
  static const std::vector<ChoiceField> fields = {{"layout", "where the rotors stand", kLayouts},
                                                  {"drone_class", "kind of drone", ClassNames()},
                                                  {"size", "where no figure tells it", kSizes}};
  return fields;
}

std::vector<std::string> FieldNames() {
  std::vector<std::string> names;
  for (const NumberField& field : kNumbers) names.emplace_back(field.name);
  for (const ChoiceField& field : Choices()) names.emplace_back(field.name);
  for (const FlagField& field : kFlags) names.emplace_back(field.name);
  return names;
}

std::string Shown(std::string_view text) {
  return internal::PrintableText(text.substr(0, kLongestQuoted)) + (text.size() > kLongestQuoted ? " ..." : "");
}

std::string ShownValue(const Json& value) { return Shown(value.dump(-1, ' ', true, Json::error_handler_t::replace)); }

std::string WithUnit(double value, const char* unit) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.6g%s%s", value, *unit ? " " : "", unit);
  return text;
}

[[noreturn]] void Refuse(const std::string& why) { throw InputError("the model's form: " + why); }

/// The object in `text`, or in the fence around it.
Json ParseForm(std::string_view text) {
  const auto trim = [](std::string_view part) {
    const size_t first = part.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return std::string_view();
    return part.substr(first, part.find_last_not_of(" \t\r\n") - first + 1);
  };
  std::string_view body = trim(text);
  if (body.starts_with("```") && body.size() >= 6 && body.ends_with("```")) {
    body = body.substr(3, body.size() - 6);
    if (body.starts_with("json")) body.remove_prefix(4);
    body = trim(body);
  }
  std::set<std::string> seen;
  const auto check = [&](int depth, Json::parse_event_t event, Json& value) {
    if (depth > 1) Refuse("a field holds a list or an object; the form is flat");
    if (event == Json::parse_event_t::key && !seen.insert(value.get<std::string>()).second)
      Refuse("the field '" + Shown(value.get<std::string>()) + "' is there twice");
    return true;
  };
  try {
    Json form = Json::parse(body.begin(), body.end(), check);
    if (!form.is_object()) Refuse("'" + Shown(body) + "' is not a JSON object");
    return form;
  } catch (const Json::exception&) {
    Refuse("'" + Shown(body) + "' is not JSON");
  }
}

void ReadNumber(const NumberField& field, const Json& value, DroneRequest& request) {
  const std::string name = field.name;
  if (!value.is_number()) Refuse(name + " is " + ShownValue(value) + ", not a number");
  const double number = value.get<double>();
  if (!(number >= field.low && number <= field.high)) {
    Refuse(name + " is " + ShownValue(value) + ", not in " + WithUnit(field.low, "") + " ... " + WithUnit(field.high, field.unit));
  }
  if (field.whole && number != std::floor(number)) Refuse(name + " is " + ShownValue(value) + ", not a whole number");
  if (field.field == &DroneRequest::rotors && number != 4 && number != 6 && number != 8)
    Refuse("rotors is " + ShownValue(value) + "; a drone here has 4, 6 or 8 rotors");
  request.*field.field = number;
  request.words[name] = name + " " + WithUnit(number, field.unit);
}

void ReadChoice(const ChoiceField& field, const Json& value, DroneRequest& request) {
  const std::string name = field.name;
  if (!value.is_string()) Refuse(name + " is " + ShownValue(value) + ", not a text");
  const auto& text = value.get_ref<const std::string&>();
  const auto found = std::ranges::find(field.choices, text);
  if (found == field.choices.end()) Refuse(UnknownChoiceMessage(name, Shown(text), field.choices));
  if (name == "layout")
    request.layout = static_cast<RotorLayout>(found - field.choices.begin());
  else if (name == "drone_class")
    request.drone_class = text;
  else
    request.size = text;
  request.words[name] = name + " " + text;
}

void ReadField(const std::string& name, const Json& value, DroneRequest& request) {
  for (const NumberField& field : kNumbers) {
    if (name == field.name) return ReadNumber(field, value, request);
  }
  for (const ChoiceField& field : Choices()) {
    if (name == field.name) return ReadChoice(field, value, request);
  }
  for (const FlagField& field : kFlags) {
    if (name != field.name) continue;
    if (!value.is_boolean()) Refuse(name + " is " + ShownValue(value) + ", not true or false");
    request.*field.field = value.get<bool>();
    if (request.*field.field) request.words[name] = name;
    return;
  }
}

/// mass = empty mass + payload, as in words.
void JoinMasses(DroneRequest& request) {
  if (!request.empty_mass) return;
  const std::string& words = request.words.at("empty_mass");
  if (request.mass && !request.payload && *request.mass > *request.empty_mass) {
    request.payload = *request.mass - *request.empty_mass;
    request.words["payload"] = request.words.at("mass") + " less " + words;
    return;
  }
  const double whole = *request.empty_mass + request.payload.value_or(0);
  if (request.mass && std::abs(*request.mass - whole) > 0.02 * std::max(*request.mass, whole)) {
    Refuse("'" + request.words.at("mass") + "' contradicts '" + words + "' and a payload of " +
           WithUnit(request.payload.value_or(0), "kg"));
  }
  if (request.mass) return;
  request.mass = whole;
  request.words["mass"] = request.payload ? words + " and " + request.words.at("payload") : words;
}

}  // namespace

nlohmann::ordered_json DroneFormSchema() {
  Json properties = Json::object();
  for (const NumberField& field : kNumbers) {
    const std::string unit = *field.unit ? std::string(field.unit) + ": " : "";
    properties[field.name] = {{"type", field.whole ? "integer" : "number"},
                              {"minimum", field.low},
                              {"maximum", field.high},
                              {"description", unit + field.meaning}};
    if (field.field == &DroneRequest::rotors) properties[field.name]["enum"] = {4, 6, 8};
  }
  for (const ChoiceField& field : Choices())
    properties[field.name] = {{"type", "string"}, {"enum", field.choices}, {"description", field.meaning}};
  for (const FlagField& field : kFlags) properties[field.name] = {{"type", "boolean"}, {"description", field.meaning}};
  return {{"title", "what words say about a multirotor drone"},
          {"type", "object"},
          {"properties", properties},
          {"additionalProperties", false}};
}

DroneRequest ReadDroneForm(std::string_view text, std::string_view prompt) {
  if (prompt.size() > kLongestPrompt) throw InputError("the description has " + std::to_string(prompt.size()) + " bytes, more than 1000");
  const Json form = ParseForm(text);
  const std::vector<std::string> names = FieldNames();
  DroneRequest request;
  request.prompt = internal::PrintableText(prompt);
  for (const auto& [name, value] : form.items()) {
    if (std::ranges::find(names, name) == names.end()) Refuse(UnknownChoiceMessage("field", Shown(name), names));
    if (!value.is_null()) ReadField(name, value, request);
  }
  if (request.words.empty()) Refuse("it is empty: nothing in '" + Shown(prompt) + "' describes a drone to the model");
  JoinMasses(request);
  if (request.brushless && request.drone_class == "nano") request.drone_class = "nano_brushless";
  return request;
}

}  // namespace airsim360
