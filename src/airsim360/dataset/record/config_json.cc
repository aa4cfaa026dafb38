#include "airsim360/dataset/record/config_json.h"

#include <nlohmann/json.hpp>
#include <string>

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

class JsonWriter : public ConfigVisitor {
 public:
  explicit JsonWriter(Json& json) : json_(json) {}

  void Field(std::string_view name, std::string_view, bool& value) override { Put(name, value); }
  void Field(std::string_view name, std::string_view, uint64_t& value) override { Put(name, value); }
  void Field(std::string_view name, std::string_view, double& value, double, double) override { Put(name, value); }
  void Field(std::string_view name, std::string_view, std::string& value) override { Put(name, value); }
  void Field(std::string_view name, std::string_view, std::vector<std::string>& value) override { Put(name, value); }
  void Count(std::string_view name, std::string_view, int& value, int) override {
    if (value > 0) Put(name, value);
  }
  void NumberOr(std::string_view name, std::string_view, const char* word, bool& is_word, double& value, double, double) override {
    if (is_word) return Put(name, word);
    Put(name, value);
  }
  void Choice(std::string_view name, std::string_view, std::span<const char* const> names, size_t index,
              const std::function<void(size_t)>&) override {
    Put(name, names[index]);
  }
  void Group(std::string_view name, std::string_view, const ConfigFields& visit) override {
    Json group = Json::object();
    AddConfig(visit, group);
    Put(name, group);
  }
  void Entries(std::string_view name, std::string_view, size_t size, const std::function<void(size_t)>&,
               const std::function<void(ConfigVisitor&, size_t)>& visit) override {
    Json list = Json::array();
    for (size_t i = 0; i < size; ++i) {
      Json entry = Json::object();
      JsonWriter writer(entry);
      visit(writer, i);
      list.push_back(entry);
    }
    Put(name, list);
  }

 private:
  template <class T>
  void Put(std::string_view name, const T& value) {
    json_[std::string(name)] = value;
  }
  Json& json_;
};

}  // namespace

void AddConfig(const ConfigFields& fields, Json& json) {
  JsonWriter writer(json);
  fields(writer);
}

}  // namespace airsim360
