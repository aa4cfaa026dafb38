// What an imported thing is, told from the names its makers gave it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace airsim360::internal {

/// What a name says. A part ("wheel", "window") belongs to something larger that may know better.
struct KeywordMatch {
  std::string_view category;  ///< path of the semantic tree, possibly one that has to be added
  bool part = false;
};

/// What carries a name: a material of wood is no table, however it is called.
enum class NameKind { kNode, kMaterial, kFile };

/// The keyword of a name: whole words are compared in singular and without case; the longest keyword wins ("bus
/// stop" over "bus"), then the last one ("car park bench" is a bench). Weak keywords, which mean other things as
/// often ("table" of data, "temple" of spectacles), count only where all other words are colours, sizes, materials
/// and the like, and never in materials. Some phrases tell that a name says nothing ("car paint", "hotel room").
/// A part whose owner stands in the same name belongs to it ("car_wheel" is car). nullopt if there is none.
std::optional<KeywordMatch> FindKeyword(std::string_view name, NameKind kind = NameKind::kNode);

/// Category of a part with category `part` of something that is an `owner`: a wheel of a car is car, a window
/// of a house stays a window, a window of a car is car.
std::string_view CategoryOfPart(std::string_view part, std::string_view owner);

/// "vehicle" of "vehicle/car".
std::string_view RootOf(std::string_view path);

}  // namespace airsim360::internal
