// Pictures as DLPack tensors (dmlc.github.io/dlpack, ABI 0.8): PyTorch, JAX, CuPy and NumPy read them without a copy.
#include <cstdint>
#include <memory>

#include "airsim360/base/error.h"
#include "convert.h"

namespace airsim360::python {
namespace {

// The memory layout that DLPack fixes.
enum DeviceType : int32_t { kCpuDevice = 1 };
enum TypeCode : uint8_t { kIntCode = 0, kUintCode = 1, kFloatCode = 2 };
struct Device {
  int32_t type, id;
};
struct DataType {
  uint8_t code, bits;
  uint16_t lanes;
};
struct Described {
  void* data;
  Device device;
  int32_t dimensions;
  DataType type;
  int64_t *shape, *strides;
  uint64_t byte_offset;
};
struct Managed {
  Described tensor;
  void* context;
  void (*deleter)(Managed*);
};
constexpr const char* kCapsule = "dltensor";

// Numbers behind a Managed, and the array that keeps them alive.
struct Export {
  Managed managed{};
  std::vector<int64_t> shape, strides;
  py::array array;
};

// Consumers call this on any thread, perhaps when Python is already gone.
void Delete(Managed* managed) {
  auto* const own = static_cast<Export*>(managed->context);
  if (Py_IsInitialized() == 0) return;
  const py::gil_scoped_acquire gil;
  delete own;
}

uint8_t CodeOf(char kind) { return kind == 'f' ? kFloatCode : kind == 'i' ? kIntCode : kUintCode; }

struct Tensor {
  py::array array;
};

py::capsule ToDlpack(const Tensor& tensor, const py::object& stream, const py::object&, const py::object& device,
                     const py::object& copy) {
  if (!stream.is_none()) throw py::value_error("stream: memory of the CPU has no streams");
  if (!device.is_none() && device.cast<std::pair<int, int>>().first != kCpuDevice)
    throw py::buffer_error("dl_device: pictures are in memory of the CPU");
  auto own = std::make_unique<Export>();
  own->array = !copy.is_none() && copy.cast<bool>() ? tensor.array.attr("copy")().cast<py::array>() : tensor.array;
  const py::array& a = own->array;
  for (py::ssize_t k = 0; k < a.ndim(); ++k) {
    own->shape.push_back(a.shape(k));
    own->strides.push_back(a.strides(k) / a.itemsize());
  }
  const auto bits = static_cast<uint8_t>(8 * a.itemsize());
  own->managed = {{const_cast<void*>(a.data()),
                   {kCpuDevice, 0},
                   static_cast<int32_t>(a.ndim()),
                   {CodeOf(a.dtype().kind()), bits, 1},
                   own->shape.data(),
                   own->strides.data(),
                   0},
                  own.get(),
                  &Delete};
  // A capsule that nobody took renames itself to nothing: then it is ours to delete.
  PyObject* const capsule = PyCapsule_New(&own->managed, kCapsule, [](PyObject* object) {
    if (PyCapsule_IsValid(object, kCapsule) == 0) return;
    auto* const left = static_cast<Managed*>(PyCapsule_GetPointer(object, kCapsule));
    left->deleter(left);
  });
  if (capsule == nullptr) throw py::error_already_set();
  static_cast<void>(own.release());
  return py::reinterpret_steal<py::capsule>(capsule);
}

}  // namespace

py::object ToTensor(const py::object& picture) {
  return py::cast(Tensor{picture.cast<py::array>()});
}

void BindTensor(py::module_& m) {
  py::class_<Tensor>(m, "Tensor", R"(A picture as DLPack exports it: pass it to numpy, torch, jax or cupy's from_dlpack.

Nothing is copied; the memory stays alive for as long as any consumer has it.)")
      .def("__dlpack__", &ToDlpack, py::kw_only(), py::arg("stream") = py::none(), py::arg("max_version") = py::none(),
           py::arg("dl_device") = py::none(), py::arg("copy") = py::none())
      .def("__dlpack_device__", [](const Tensor&) { return py::make_tuple(static_cast<int>(kCpuDevice), 0); })
      .def_property_readonly("shape", [](const Tensor& t) { return t.array.attr("shape"); });
}

}  // namespace airsim360::python
