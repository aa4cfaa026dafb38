// Frames of plans for airsim360.data, which has the class that users see.
#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/dataset/plan/find_plan.h"
#include "airsim360/dataset/plan/plan_frames.h"
#include "airsim360/dataset/plan/plan_spec.h"
#include "convert.h"
#include "keywords.h"

namespace airsim360::python {
namespace {

namespace fs = std::filesystem;

// Mistakes are told by the names that Python gives: "--size: …" becomes "size: …".
template <class Action>
auto InWordsOfPython(const Action& action) {
  try {
    return action();
  } catch (const InputError& error) {
    std::string text = error.what();
    if (!text.starts_with("--")) throw;
    for (size_t at = 0; (at = text.find("--", at)) < text.find(':');) text.erase(at, 2);
    throw InputError(text);
  }
}

std::string FindPlanText(const std::string& name, const std::vector<std::string>& worlds, int64_t frames, uint64_t seed,
                         const std::string& device, int gpu) {
  const py::gil_scoped_release release;
  return InWordsOfPython([&] {
    const DeviceChoice choice{device, gpu};
    CheckStageOptions({.device = choice});
    return PlanJson(FindPlan({.name = name, .worlds = worlds, .frames = frames, .seed = seed}, choice));
  });
}

EnvironmentFlags ToEnvironment(const py::dict& words) {
  const auto word = [&](const char* name) { return words.contains(name) ? words[name].cast<std::string>() : std::string(); };
  return {.weather = word("weather"),
          .sun = word("sun"),
          .time = word("time"),
          .place = word("place"),
          .hdri = word("hdri"),
          .settings = word("environment"),
          .clouds = word("clouds"),
          .sky_seed = word("sky_seed")};
}

std::unique_ptr<PlanFrames> MakePlanFrames(const std::string& plan_text, const py::dict& picture,
                                           const std::optional<std::vector<std::string>>& products, const std::string& projection,
                                           const std::string& size, double fov_deg, const std::string& cameras, const py::dict& environment,
                                           const std::string& device, int gpu, const std::optional<std::string>& cache,
                                           uint64_t cache_bytes) {
  return InWordsOfPython([&] {
    const fs::path own = DiskCache::OfUser().folder();
    DatasetPlan plan = ParsePlan(plan_text, "plan");
    RecipePicture wanted = plan.recipe.picture;
    ReadKeywords(picture, [&](ConfigVisitor& v) { wanted.settings.Visit(v); });
    if (products) {
      wanted.settings.products = WithProducts(kNoProducts, *products, "--products");
      wanted.products.clear();
      if (wanted.settings.products.rgb && wanted.settings.tier == Tier::kLabels)
        throw InputError("--products: tier 'labels' has no rgb; take another tier, or leave rgb out");
    }
    // The size of the recipe is that of a panorama.
    const bool panorama = projection == "erp" && cameras.empty();
    const CameraChoice camera{projection, size.empty() && panorama ? wanted.size : size, cameras, fov_deg};
    PlanFramesOptions options{.pictures = SpecOfPicture(wanted, camera),
                              .environment = ToEnvironment(environment),
                              .device = {device, gpu},
                              .cache = cache         ? fs::path(*cache)
                                       : own.empty() ? own
                                                     : own / "panoramas",
                              .cache_bytes = cache_bytes};
    if (ProductFolders(options.pictures).empty()) throw InputError("--products: none; name at least one");
    return std::make_unique<PlanFrames>(std::move(plan), options);
  });
}

// (H, W) or (H, W, values) of a picture, which `owner` keeps alive.
py::array ArrayOf(const StoredPicture& picture, const py::handle& owner) {
  const auto value = static_cast<py::ssize_t>(SizeOf(picture.type)), pixel = value * picture.depth;
  std::vector<py::ssize_t> shape = {picture.height, picture.width}, strides = {pixel * picture.width, pixel};
  if (picture.depth > 1) {
    shape.push_back(picture.depth);
    strides.push_back(value);
  }
  const void* data = picture.values.data();
  switch (picture.type) {
    case StoredPicture::Type::kUint8:
      return View(static_cast<const uint8_t*>(data), shape, strides, owner);
    case StoredPicture::Type::kUint16:
      return View(static_cast<const uint16_t*>(data), shape, strides, owner);
    case StoredPicture::Type::kUint32:
      return View(static_cast<const uint32_t*>(data), shape, strides, owner);
    case StoredPicture::Type::kFloat32:
      break;
  }
  return View(static_cast<const float*>(data), shape, strides, owner);
}

py::tuple TakeFrame(PlanFrames& frames, int64_t frame, int threads) {
  PlanFrame taken;
  {
    const py::gil_scoped_release release;
    const ThreadLimit limit(threads);
    taken = frames.Take(frame);
  }
  py::list pictures;
  for (StoredPicture& picture : taken.pictures) {
    const auto kept = new StoredPicture(std::move(picture));
    const py::capsule owner(kept, [](void* pointer) { delete static_cast<StoredPicture*>(pointer); });
    pictures.append(py::make_tuple(kept->product, kept->view, kept->channels, ArrayOf(*kept, owner)));
  }
  return py::make_tuple(taken.about, pictures);
}

py::dict WorldsOf(const PlanFrames& frames) {
  py::dict worlds;
  for (const RecipeRow& row : frames.plan().recipe.rows) {
    const WorldFacts& facts = frames.plan().facts(row);
    worlds[py::str(WorldKey(row))] = facts.exists() ? py::object(py::str(facts.hash)) : py::object(py::none());
  }
  return worlds;
}

}  // namespace

void BindPlanFrames(py::module_& m) {
  m.def("_find_plan", &FindPlanText, py::arg("name"), py::arg("worlds"), py::arg("frames"), py::arg("seed"), py::arg("device"),
        py::arg("gpu"), "The text of a plan file: of a recipe or a file, with '@HASH' behind or not.");
  py::class_<PlanFrames>(m, "_PlanFrames", "Frames of a plan as dataset run would write them; airsim360.data.Panoramas is for users.")
      .def(py::init(&MakePlanFrames), py::arg("plan"), py::arg("picture"), py::arg("products"), py::arg("projection"), py::arg("size"),
           py::arg("fov_deg"), py::arg("cameras"), py::arg("environment"), py::arg("device"), py::arg("gpu"), py::arg("cache"),
           py::arg("cache_bytes"))
      .def_property_readonly(
          "hash", [](const PlanFrames& f) { return f.plan().hash; }, "Of the plan.")
      .def_property_readonly(
          "count", [](const PlanFrames& f) { return f.plan().frames(); }, "Number of frames.")
      .def_property_readonly("worlds", &WorldsOf, "World -> hash, None where it did not exist.")
      .def_property_readonly("uses_gpu", &PlanFrames::uses_gpu, "Whether a GPU draws.")
      .def_property_readonly("meta", &PlanFrames::MetaText, "meta.json of a dataset of these frames.")
      .def("blocks", &PlanFrames::Blocks, "(first, last) of the frames of each sky whose worlds exist.")
      .def(
          "open",
          [](PlanFrames& f, int threads) {
            const py::gil_scoped_release release;
            const ThreadLimit limit(threads);
            f.Open();
          },
          py::arg("threads"), "Opens worlds, as many as are kept.")
      .def(
          "describe",
          [](PlanFrames& f, int64_t frame, int threads) {
            const py::gil_scoped_release release;
            const ThreadLimit limit(threads);
            return f.Describe(frame);
          },
          py::arg("frame"), py::arg("threads"), "What a frame is, JSON.")
      .def("take", &TakeFrame, py::arg("frame"), py::arg("threads"),
           "The same with persons, and (product, view, channels, picture) of all pictures.");
}

}  // namespace airsim360::python
