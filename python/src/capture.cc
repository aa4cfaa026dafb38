// The panoramic rig and what it captures: arrays are views of the capture's own memory.
#include <algorithm>
#include <cmath>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/scene/parts.h"
#include "airsim360/sensors/idle_settings.h"
#include "handles.h"
#include "interrupts.h"
#include "keywords.h"
#include "simulation.h"
#include "tensor.h"

namespace airsim360::python {
namespace {

// Names of arguments of Rig that are no settings of pictures.
const std::vector<std::string> kRigArguments = {"width", "height", "products", "projection", "fov",  "position",
                                                "yaw",   "pitch",  "roll",     "level",      "seed", "flow_dt"};

// Radians, of pictures that have a field of view to choose.
void CheckFieldOfView(const std::string& projection, double fov) {
  const double most_deg = projection == "pinhole" ? 179 : projection == "fisheye" ? 360 : 0;
  const double fov_deg = fov * 180 / M_PI;
  if (most_deg == 0 || (fov_deg >= 1 - 1e-9 && fov_deg <= most_deg + 1e-9)) return;
  std::string text = Text("fov: %g is not in %.4f … %.4f radians (1 … %g degrees)", fov, M_PI / 180, most_deg * M_PI / 180, most_deg);
  // Told in degrees, it seems.
  if (fov > M_PI && fov <= most_deg) {
    text += Text("; did you mean %.4g (%g degrees)?", fov * M_PI / 180, fov);
  } else if (std::isfinite(fov)) {
    text += Text("; the nearest is %.4f", (fov_deg < 1 ? 1 : most_deg) * M_PI / 180);
  }
  throw InputError(text);
}

Products ShownBy(const std::optional<std::vector<std::string>>& products, Tier tier) {
  std::vector<std::string> names = {"rgb", "range", "semantic", "entity"};
  if (tier == Tier::kLabels) names.erase(names.begin());
  if (products) names = *products;
  const Products shown = WithProducts(kNoProducts, names);
  if (shown.rgb && tier == Tier::kLabels)
    throw InputError("products: 'rgb' needs light, which tier 'labels' has none of; did you mean tier 'fast'?");
  return shown;
}

Rig MakeRig(const py::object& width, const py::object& height, const std::optional<std::vector<std::string>>& products,
            const std::string& projection, double fov, const py::object& position, double yaw, double pitch, double roll, bool level,
            const py::object& seed, double flow_dt, const py::kwargs& picture) {
  constexpr int64_t kLargest = 16384;
  CameraSpec spec;
  spec.projection = projection;
  spec.width = static_cast<uint64_t>(ToWhole(width, "width", 1, kLargest));
  spec.height = static_cast<uint64_t>(ToWhole(height, "height", 0, kLargest));
  if (spec.height == 0) spec.height = projection == "erp" ? spec.width / 2 : spec.width;
  CheckFieldOfView(projection, fov);
  spec.fov_deg = fov * 180 / M_PI;
  if (level) spec.pano_frame = PanoFrame::kLevel;
  ReadKeywords(
      picture, [&](ConfigVisitor& v) { spec.PictureSettings::Visit(v); }, kRigArguments);
  spec.seed = ToSeed(seed);
  Rig rig{spec.Rig(), Finite(flow_dt, "flow_dt"), ShownBy(products, spec.tier)};
  if (!(flow_dt > 0 && flow_dt <= 10)) throw InputError("flow_dt: " + std::to_string(flow_dt) + " s is not above 0 and at most 10");
  rig.rig.X_BC = BodyPose(ToVec3(position, "position"), Finite(yaw, "yaw"), Finite(pitch, "pitch"), Finite(roll, "roll")) * CameraInBody();
  rig.rig.products = Rendered(rig.shown);
  RefuseIdleSettings(spec, rig.shown);
  return rig;
}

// "(self, width: int = 1024, …)": pybind11 knows no signature of keywords that are found out at run time.
std::string RigDocumentation() {
  const ConfigFields picture = [](ConfigVisitor& v) { PictureSettings().Visit(v); };
  return "__init__(self: airsim360.Rig, width: int = 1024, height: int = 0, *, " + KeywordSignature(picture) +
         ", products: list[str] | None = None, projection: str = 'erp', "
         "fov: float = 1.5707963267948966, position: object = (0.0, 0.0, 0.0), yaw: float = 0.0, pitch: "
         "float = 0.0, "
         "roll: float = 0.0, level: bool = False, seed: int = 0, flow_dt: float = 0.1) -> None\n\n" +
         KeywordHelp(picture);
}

[[noreturn]] void RefuseMissing(const std::string& product) {
  throw InputError("product '" + product + "' was not captured: name it in Rig(products=…)");
}

/// The picture of a product as (H, W) of T, or (H, W, channels). InputError where the rig did not ask for it.
template <class T, class Pixel>
py::object PictureIn(const py::object& self, const Image<Pixel>& image, int channels, const char* product) {
  if (!image.empty()) return ImageView<T>(image, channels, self);
  if (py::isinstance<CudaCapture>(self))
    throw InputError(std::string(product) + " is in memory of the GPU: take tensor(\"" + product + "\")");
  RefuseMissing(product);
}

template <class T, class Pixel>
auto Picture(Image<Pixel> Frame::*image, int channels, const char* product) {
  return [image, channels, product](const py::object& self) {
    return PictureIn<T>(self, self.cast<const Capture&>().frame.*image, channels, product);
  };
}

/// The pictures that are there, in the order of Rig's documentation, and their size.
struct Pictures {
  std::vector<std::string> names;
  int width = 0, height = 0;
};
Pictures PicturesOf(const Capture& c) {
  Pictures there;
  const auto note = [&](const char* name, const auto& image) {
    if (image.empty()) return;
    there.names.emplace_back(name);
    there.width = static_cast<int>(image.width());
    there.height = static_cast<int>(image.height());
  };
  const Frame& f = c.frame;
  note("rgb", f.rgb);
  note("range", f.range);
  note("semantic", f.semantic);
  note("entity", f.entity);
  note("normal", f.normal);
  note("position", f.position);
  note("albedo", f.albedo);
  note("material", f.material);
  note("part", c.part);
  note("sky", c.sky);
  note("flow", f.flow);
  note("coverage", f.coverage);
  note("radiance", f.radiance);
  return there;
}

py::object CoverageOf(const py::object& self) {
  const Image<CoveragePixel>& image = self.cast<const Capture&>().frame.coverage;
  if (image.empty()) RefuseMissing("coverage");
  const py::tuple entities = py::make_tuple(CoveragePixel::kEntities);
  py::list names, formats, offsets;
  names.append("entity");
  names.append("share");
  formats.append(py::make_tuple("<u4", entities));
  formats.append(py::make_tuple("<f4", entities));
  offsets.append(offsetof(CoveragePixel, entity));
  offsets.append(offsetof(CoveragePixel, share));
  const auto pixel = static_cast<py::ssize_t>(sizeof(CoveragePixel));
  return py::array(py::dtype(names, formats, offsets, pixel), {image.height(), image.width()}, {pixel * image.width(), pixel},
                   image.pixels().data(), self);
}

std::string Describe(const Capture& c) {
  const Pictures there = PicturesOf(c);
  return Text("Capture(%s, %dx%d, at %s m, t = %.3f s)", Joined(there.names).c_str(), there.width, there.height, Text(c.X_WC.p).c_str(),
              Seconds(c.t_ns));
}

// The pictures of a capture in memory of a CUDA device.
Tensor PictureOf(const CudaCapture& capture, const std::string& product) {
  WithProducts(kNoProducts, std::vector{product});  // names the nearest where there is no such product
  const GpuFrame& f = capture.pictures->frame();
  const auto& keep = capture.pictures;
  Tensor tensor;
  if (product == "rgb") tensor = CudaTensor<uint8_t>(f.rgb, 3, keep);
  if (product == "range") tensor = CudaTensor<float>(f.range, 0, keep);
  if (product == "semantic") tensor = CudaTensor<CategoryId>(f.semantic, 0, keep);
  if (product == "entity") tensor = CudaTensor<EntityId>(f.entity, 0, keep);
  if (product == "normal") tensor = CudaTensor<float>(f.normal, 3, keep);
  if (product == "position") tensor = CudaTensor<float>(f.position, 3, keep);
  if (product == "albedo") tensor = CudaTensor<float>(f.albedo, 3, keep);
  if (product == "material") tensor = CudaTensor<uint16_t>(f.material, 0, keep);
  if (product == "flow") tensor = CudaTensor<float>(f.flow, 2, keep);
  if (product == "radiance") tensor = CudaTensor<float>(f.radiance, 3, keep);
  if (tensor.data == nullptr) RefuseMissing(product);
  return tensor;
}

}  // namespace

PanoramicRig Rendered(const Rig& rig, const EntityLabels* labels) {
  PanoramicRig rendered = rig.rig;
  if (labels && rendered.products.semantic) rendered.products.entity = true;
  return rendered;
}

void FinishCapture(const Rig& rig, const Scene& scene, const EntityLabels* labels, Capture& capture) {
  Frame& frame = capture.frame;
  if (rig.shown.part) capture.part = PartPicture(frame.semantic, frame.material, scene.tree, scene.materials);
  if (rig.shown.sky) capture.sky = SkyMask(frame.entity, scene.sky_entity);
  if (labels && rig.rig.products.semantic) {
    for (size_t i = 0; i < frame.semantic.size(); ++i)
      frame.semantic.pixels()[i] = labels->Of(frame.entity.pixels()[i], frame.semantic.pixels()[i]);
  }
  if (!rig.shown.entity) frame.entity = {};
  if (!rig.shown.semantic) frame.semantic = {};
  if (!rig.shown.material) frame.material = {};
}

void FinishScan(const EntityLabels* labels, LidarScan& scan) {
  if (!labels) return;
  for (LidarPoint& point : scan.points) point.category = labels->Of(point.entity, point.category);
}

namespace {

using CaptureClass = py::class_<Capture, std::shared_ptr<Capture>>;

void BindRig(py::module_& m) {
  py::class_<Rig> rig(m, "Rig", R"(A camera on a drone, panoramic unless told otherwise, and what it captures.

width, height: pixels (height 0: half the width for panoramas, else the width). products: any of rgb, range, semantic,
entity, normal, position, albedo, material, part, sky, flow, coverage, radiance (None: rgb, unless the tier is labels, range, semantic,
entity). projection: erp, pinhole or fisheye
(fov: radians, across the width or the shorter side). position (3,), yaw, pitch, roll: the mount in B. level: the same as
pano_frame="level". seed: of samples and noise. flow_dt: seconds that optical flow leads on by. All others say how
pictures are made, as the flags of `airsim360 render` do.)");
  {
    py::options options;
    options.disable_function_signatures();
    rig.def(py::init(&MakeRig), py::arg("width") = 1024, py::arg("height") = 0, py::kw_only(), py::arg("products") = py::none(),
            py::arg("projection") = "erp", py::arg("fov") = M_PI / 2, py::arg("position") = py::make_tuple(0.0, 0.0, 0.0),
            py::arg("yaw") = 0.0, py::arg("pitch") = 0.0, py::arg("roll") = 0.0, py::arg("level") = false, py::arg("seed") = 0,
            py::arg("flow_dt") = 0.1, RigDocumentation().c_str());
  }
  rig.def("__repr__",
          [](const Rig& r) {
            return Text("Rig(%dx%d, tier %s, %s)", Width(r.rig.camera), Height(r.rig.camera), kTierNames[static_cast<int>(r.rig.tier)],
                        Joined(NamesOf(r.shown)).c_str());
          })
      .def_property_readonly(
          "width", [](const Rig& r) { return Width(r.rig.camera); }, "Pixels.")
      .def_property_readonly(
          "height", [](const Rig& r) { return Height(r.rig.camera); }, "Pixels.");
}

// Those that the renderer drew.
void BindPlainPictures(CaptureClass& capture) {
  capture.def("__repr__", &Describe)
      .def_property_readonly(
          "products", [](const Capture& c) { return PicturesOf(c).names; }, "Names of the pictures that are there.")
      .def_property_readonly("rgb", Picture<uint8_t>(&Frame::rgb, 3, "rgb"), "(H, W, 3) uint8, sRGB.")
      .def_property_readonly("range", Picture<float>(&Frame::range, 0, "range"),
                             "(H, W) float32, metres along the ray, 0 = nothing hit (sky).")
      .def_property_readonly("semantic", Picture<CategoryId>(&Frame::semantic, 0, "semantic"),
                             "(H, W) uint16, category id (World.categories).")
      .def_property_readonly("entity", Picture<EntityId>(&Frame::entity, 0, "entity"), "(H, W) uint32, entity id (World.entities).")
      .def_property_readonly("normal", Picture<float>(&Frame::normal, 3, "normal"),
                             "(H, W, 3) float32, unit normal in W towards the camera.")
      .def_property_readonly("position", Picture<float>(&Frame::position, 3, "position"), "(H, W, 3) float32, point hit, metres in W.")
      .def_property_readonly("albedo", Picture<float>(&Frame::albedo, 3, "albedo"), "(H, W, 3) float32, linear base colour.")
      .def_property_readonly("material", Picture<uint16_t>(&Frame::material, 0, "material"), "(H, W) uint16, material index plus 1.");
}

// Those that are made of others or have another form.
void BindOtherPictures(CaptureClass& capture) {
  capture
      .def_property_readonly(
          "part", [](const py::object& self) { return PictureIn<uint8_t>(self, self.cast<const Capture&>().part, 0, "part"); },
          "(H, W) uint8, which part of the pixel's entity (airsim360.PARTS): 1 window, 2 door, 3 balcony …; "
          "0 = its body, or nothing hit.")
      .def_property_readonly(
          "sky", [](const py::object& self) { return PictureIn<uint8_t>(self, self.cast<const Capture&>().sky, 0, "sky"); },
          "(H, W) uint8, 255 = the ray through the pixel centre meets the sky, else 0.")
      .def_property_readonly("coverage", &CoverageOf,
                             "(H, W) records of entity (4,) uint32 and share (4,) float32: the entities in a pixel by the "
                             "share of its area, largest first; entity 0 = no more.")
      .def_property_readonly("radiance", Picture<float>(&Frame::radiance, 3, "radiance"), "(H, W, 3) float32, linear light.")
      .def_property_readonly("flow", Picture<float>(&Frame::flow, 2, "flow"),  // dx, dy are first in the pixel
                             "(H, W, 2) float32, pixels to where the point is flow_dt later if commands stay; x wraps.");
}

// When and how it was taken.
void BindTrigger(CaptureClass& capture) {
  capture
      .def(
          "tensor",
          [](const py::object& self, const std::string& product) {
            WithProducts(kNoProducts, std::vector{product});  // names the nearest where there is no such product
            return ToTensor(self.attr(product.c_str()));
          },
          py::arg("product"), "A picture for from_dlpack of torch, jax, cupy or numpy, without a copy.")
      .def_property_readonly(
          "pose", [](const Capture& c) { return FromPose(c.X_WC); }, "(4, 4) X_WC: p_W = X_WC p_C, C with +X right, +Y down, +Z forward.")
      .def_property_readonly(
          "look",
          [](const Capture& c) -> py::object {
            if (!c.photo) return py::none();
            const PhotoFigures& p = *c.photo;
            using namespace py::literals;
            return py::dict("exposure_ev"_a = p.exposure_ev, "white_cd_m2"_a = p.white_cd_m2, "gain"_a = p.gain, "red"_a = p.red,
                            "green"_a = p.green, "blue"_a = p.blue, "contrast"_a = p.contrast, "sun_seen"_a = p.sun_seen);
          },
          "What the camera of look photo chose: exposure_ev, white_cd_m2, gain, red, green, blue, contrast, sun_seen; None for look clean.")
      .def_property_readonly(
          "developed",
          [](const Capture& c) -> py::object {
            if (c.frame.rgb.empty()) return py::none();
            using namespace py::literals;
            return py::dict("factor"_a = c.frame.exposure, "stops"_a = std::log2(c.frame.exposure));
          },
          "The exposure of rgb: factor (radiance times it is what the tone curve was given), stops (its logarithm to base 2); None "
          "without rgb.")
      .def_property_readonly(
          "body_pose", [](const Capture& c) { return FromPose(c.body.X_WB); }, "(4, 4) X_WB.")
      .def_property_readonly(
          "q_wxyz", [](const Capture& c) { return FromQuaternion(ToQuaternion(c.X_WC.R)); },
          "(4,) rotation of the camera in W as w, x, y, z.")
      .def_property_readonly(
          "p", [](const Capture& c) { return FromVec3(c.X_WC.p); }, "(3,) place of the camera in W, metres.")
      .def_readonly("t_ns", &Capture::t_ns, "Time of the trigger, nanoseconds.")
      .def_property_readonly(
          "render_ms", [](const Capture& c) { return c.stats.render_ms; }, "Milliseconds of rays and shading alone.")
      .def_property_readonly(
          "rays", [](const Capture& c) { return c.stats.rays; }, "Rays that were cast.");
}

void BindCudaCapture(py::module_& m) {
  py::class_<CudaCapture, Capture, std::shared_ptr<CudaCapture>>(m, "CudaCapture", R"(A capture whose pictures stay in memory of the GPU.

rgb, range and so on are ValueErrors; tensor("rgb") is a tensor of CUDA for from_dlpack of torch, jax or cupy.)")
      .def("__repr__",
           [](const CudaCapture& c) { return Text("CudaCapture(at %s m, t = %.3f s)", Text(c.X_WC.p).c_str(), Seconds(c.t_ns)); })
      .def("tensor", &PictureOf, py::arg("product"), "A picture for from_dlpack of torch, jax or cupy, without a copy.");
}

}  // namespace

void BindCapture(py::module_& m) {
  py::list parts;
  for (const char* name : kPartNames) parts.append(name);
  m.attr("PARTS") = py::tuple(parts);
  m.attr("PRODUCTS") = py::tuple(py::cast(ProductNames()));
  m.attr("PICTURE_SETTINGS") = py::tuple(py::cast(KeywordNames([](ConfigVisitor& v) { PictureSettings().Visit(v); })));
  BindRig(m);
  CaptureClass capture(m, "Capture", R"(What one trigger gave: all pictures from the same rays at one instant.

Pictures are views of this object's memory (no copies); one that the rig was not asked for is a ValueError.)");
  BindPlainPictures(capture);
  BindOtherPictures(capture);
  BindTrigger(capture);
  BindCudaCapture(m);
}

void BindCapturing(py::class_<Simulation>& sim) {
  sim.def(
      "capture",
      [](Simulation& s, const Rig& rig, const py::object& drone, const std::string& memory) -> py::object {
        const size_t i = s.Find(drone);
        static const std::vector<std::string> kMemories = {"cpu", "cuda"};
        if (std::ranges::count(kMemories, memory) == 0) throw InputError("memory: " + UnknownChoiceMessage("memory", memory, kMemories));
        std::shared_ptr<Capture> on_cpu;
        std::shared_ptr<CudaCapture> on_gpu;
        {
          const py::gil_scoped_release release;
          if (memory == "cuda") {
            on_gpu = s.TakeCuda(rig, i);
          } else {
            on_cpu = TakeWatched(PixelsOf(rig), [&] { return s.Take(rig, i); });
          }
        }
        return on_gpu ? py::cast(on_gpu) : py::cast(on_cpu);
      },
      py::arg_v("rig", DefaultRig(), "Rig()"), py::arg("drone") = 0, py::arg("memory") = "cpu",
      "What the rig on a drone sees now; its own body is hidden. Changes nothing. memory=\"cuda\": a CudaCapture, whose pictures "
      "stay on the GPU.");
}

}  // namespace airsim360::python
