// What Cosys-AirSim has added: instance segmentation, annotation layers, sensors.
#include <set>

#include "airsim360/rpc/api/api.h"
#include "airsim360/rpc/coordinates/ned.h"

namespace airsim360 {
namespace {

using Text = const std::string&;
constexpr size_t kMostLayers = 64;

std::vector<std::string> ListedNames(const Api& api, const Snapshot& now) {
  std::vector<std::string> names;
  for (const Entity& entity : const_cast<Api&>(api).session().objects().scene().entities) {
    const ObjectIndex& objects = const_cast<Api&>(api).session().objects();
    if (!PlaceNow(now, objects, entity.id).hidden) names.push_back(objects.NameOf(entity.id, now.world->names));
  }
  return names;
}

std::vector<airsim::Pose> ObjectPoses(Api& api, const Snapshot& now) {
  std::vector<airsim::Pose> poses;
  const ObjectIndex& objects = api.session().objects();
  for (const Entity& entity : objects.scene().entities) {
    const ObjectPlace place = PlaceNow(now, objects, entity.id);
    if (place.hidden) continue;
    poses.push_back({airsim::ToVector(NedFromWorld(place.X_WO.p - api.session().origin_W())), airsim::ToQuaternionr(NedAttitude(place))});
  }
  return poses;
}

// The layer of a name, made at its first use.
std::vector<uint32_t>& LayerToChange(Session& s, Text layer) {
  auto& layers = s.world().annotations;
  if (!layers.contains(layer) && layers.size() >= kMostLayers) throw std::invalid_argument("more than 64 layers");
  auto& values = layers[layer];
  values.resize(s.objects().scene().entities.size() + 1, 0);
  return values;
}

bool SetAnnotation(Session& s, Text layer, Text mesh, uint32_t value, bool is_regex) {
  std::vector<EntityId> entities;
  if (is_regex) {
    entities = s.objects().Match(mesh, s.world().names);
  } else if (const EntityId entity = s.objects().Find(mesh, s.world().names); entity != kNoEntity) {
    entities.push_back(entity);
  }
  auto& values = LayerToChange(s, layer);
  for (const EntityId entity : entities) values[entity] = value;
  return !entities.empty();
}

uint32_t AnnotationOf(const Api& api, const Snapshot& now, Text layer, Text mesh) {
  const EntityId entity = const_cast<Api&>(api).session().objects().Find(mesh, now.world->names);
  const auto values = now.world->annotations.find(layer);
  return entity == kNoEntity || values == now.world->annotations.end() ? 0 : values->second[entity];
}

uint32_t Packed(int r, int g, int b) {
  for (const int c : {r, g, b}) {
    if (c < 0 || c > 255) throw std::invalid_argument("colours are 0 ... 255");
  }
  return static_cast<uint32_t>(r | g << 8 | b << 16);
}

void AddAnnotationCalls(Api& api) {
  api.Change("simSetAnnotationObjectID", [](Session& s, Text layer, Text mesh, int id, bool is_regex) {
    if (id < 0 || id >= 1 << 24) throw std::invalid_argument("object_id must be in 0 ... 16777215");
    return SetAnnotation(s, layer, mesh, static_cast<uint32_t>(id), is_regex);
  });
  api.Read("simGetAnnotationObjectID",
           [&api](const Snapshot& now, Text layer, Text mesh) { return static_cast<int>(AnnotationOf(api, now, layer, mesh)); });
  api.Change("simSetAnnotationObjectColor", [](Session& s, Text layer, Text mesh, int r, int g, int b, bool is_regex) {
    return SetAnnotation(s, layer, mesh, Packed(r, g, b), is_regex);
  });
  api.Read("simGetAnnotationObjectColor", [&api](const Snapshot& now, Text layer, Text mesh) {
    const uint32_t c = AnnotationOf(api, now, layer, mesh);
    return std::to_string(c & 255) + "," + std::to_string(c >> 8 & 255) + "," + std::to_string(c >> 16 & 255);
  });
  api.Change("simSetAnnotationObjectValue", [](Session& s, Text layer, Text mesh, float value, bool is_regex) {
    if (!(value >= 0 && value <= 1)) throw std::invalid_argument("greyscale_value must be in 0 ... 1");
    const int gray = static_cast<int>(value * 255 + 0.5f);
    return SetAnnotation(s, layer, mesh, Packed(gray, gray, gray), is_regex);
  });
  api.Read("simGetAnnotationObjectValue", [&api](const Snapshot& now, Text layer, Text mesh) {
    return static_cast<float>(AnnotationOf(api, now, layer, mesh) & 255) / 255;
  });
  api.Read("simListAnnotationObjects", [&api](const Snapshot& now, Text) { return ListedNames(api, now); });
  api.Read("simListAnnotationPoses", [&api](const Snapshot& now, Text, bool, bool) { return ObjectPoses(api, now); });
}

}  // namespace

void AddCosysCalls(Api& api) {
  AddAnnotationCalls(api);
  api.Read("simListInstanceSegmentationObjects", [&api](const Snapshot& now) { return ListedNames(api, now); });
  api.Read("simListInstanceSegmentationPoses",
           [&api](const Snapshot& now, bool /*ned*/, bool /*only_visible*/) { return ObjectPoses(api, now); });
  // Colour of instance i: its bytes, as panorama_entity shows them.
  api.Read("simGetInstanceSegmentationColorMap", [&api](const Snapshot& now) {
    // In the order of the names above.
    std::vector<airsim::Vector3r> colors;
    const size_t count = api.session().objects().scene().entities.size();
    for (uint32_t id = 1; id <= count; ++id) {
      const auto place = now.world->places.find(id);
      if (place != now.world->places.end() && place->second.hidden) continue;
      colors.push_back({static_cast<float>(id & 255), static_cast<float>(id >> 8 & 255), static_cast<float>(id >> 16 & 255)});
    }
    return colors;
  });
}

}  // namespace airsim360
