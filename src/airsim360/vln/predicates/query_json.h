// Queries and proofs as JSON. For the .cc files of this module.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "airsim360/vln/predicates/query.h"

namespace airsim360::internal {

using VlnJson = nlohmann::ordered_json;

/// The value as JSON of at most `deepest` levels; InputError "name:line: …" otherwise.
VlnJson ParseVlnJson(const std::string& text, const std::string& name);

/// Fields of an object: InputError "where: …" for what is missing, of the wrong kind, out of range or unknown.
class VlnFields {
 public:
  VlnFields(const VlnJson& value, std::string where);
  const VlnJson* Find(const char* name);
  const VlnJson& At(const char* name);
  std::string Text(const char* name, const std::string& otherwise);
  double Number(const char* name, double otherwise, double low, double high);
  bool Flag(const char* name, bool otherwise);
  std::vector<std::string> Texts(const char* name);
  Vec3d Point(const char* name);
  std::vector<Vec3d> Points(const char* name, size_t most);
  /// InputError naming a field that nobody has asked for and the nearest that there is.
  void Finish() const;
  const std::string& where() const { return where_; }

 private:
  [[noreturn]] void Refuse(const char* name, const std::string& what) const;
  const VlnJson& value_;
  std::string where_;
  std::vector<std::string> known_;
};

Vec3d PointOf(const VlnJson& value, const std::string& where);
VlnJson ToJson(Vec3d p);

Query QueryOf(const VlnJson& value, const std::string& where);
VlnJson ToJson(const Query& query);
VlnJson ToJson(const Verdict& verdict);
/// Rounded to a thousandth, so that files hold no noise.
double Rounded(double value);

}  // namespace airsim360::internal
