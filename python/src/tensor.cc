// Pictures as DLPack tensors (dmlc.github.io/dlpack, ABI 0.8 and 1.0): PyTorch, JAX, CuPy and NumPy read them without a copy.
#include "tensor.h"

#include <cstring>

#include "airsim360/base/error.h"

namespace airsim360::python {
namespace {

// The memory layout that DLPack fixes.
enum DeviceType : int32_t { kCpuDevice = 1, kCudaDevice = 2 };
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
// ABI 0.8.
struct Managed {
  Described tensor;
  void* context;
  void (*deleter)(Managed*);
  static constexpr const char* kCapsule = "dltensor";
};
// ABI 1.0.
struct ManagedVersioned {
  uint32_t major, minor;
  void* context;
  void (*deleter)(ManagedVersioned*);
  uint64_t flags;
  Described tensor;
  static constexpr const char* kCapsule = "dltensor_versioned";
};
constexpr uint64_t kIsCopied = 2;

// A Managed of either kind and what keeps its memory alive.
template <class Kind>
struct Export {
  Kind managed{};
  std::vector<int64_t> shape, strides;
  std::shared_ptr<const void> keep;
};

// What a consumer asks for.
struct Wishes {
  intptr_t stream = -1;  // of CUDA; -1: none has to wait
  bool to_cpu = false, copy = false;
};

template <class Kind>
py::capsule Pack(const Tensor& tensor, bool copied) {
  auto own = std::make_unique<Export<Kind>>();
  own->shape = tensor.shape, own->strides = tensor.strides, own->keep = tensor.keep;
  own->managed.tensor = {const_cast<void*>(tensor.data),
                         {tensor.cuda >= 0 ? kCudaDevice : kCpuDevice, std::max(tensor.cuda, 0)},
                         static_cast<int32_t>(own->shape.size()),
                         {tensor.type.code, tensor.type.bits, 1},
                         own->shape.data(),
                         own->strides.data(),
                         0};
  own->managed.context = own.get();
  // Consumers call this on any thread, perhaps when Python is already gone.
  own->managed.deleter = [](Kind* managed) { delete static_cast<Export<Kind>*>(managed->context); };
  if constexpr (std::is_same_v<Kind, ManagedVersioned>) {
    own->managed.major = 1, own->managed.minor = 0;
    own->managed.flags = copied ? kIsCopied : 0;
  }
  // A capsule that nobody took still has its name: then it is ours to delete.
  PyObject* const capsule = PyCapsule_New(&own->managed, Kind::kCapsule, [](PyObject* object) {
    if (PyCapsule_IsValid(object, Kind::kCapsule) == 0) return;
    auto* const left = static_cast<Kind*>(PyCapsule_GetPointer(object, Kind::kCapsule));
    left->deleter(left);
  });
  if (capsule == nullptr) throw py::error_already_set();
  static_cast<void>(own.release());
  return py::reinterpret_steal<py::capsule>(capsule);
}

size_t BytesOf(const Tensor& tensor) {
  const auto items = static_cast<size_t>(tensor.shape[0] * tensor.strides[0]);
  return items * tensor.type.bits / 8;
}

// A copy where it is wanted, with the same strides.
Tensor Copied(const Tensor& tensor, const Wishes& wishes) {
  Tensor copy = tensor;
  const size_t bytes = BytesOf(tensor);
  if (tensor.pictures && !wishes.to_cpu) {
    // Streams that need not wait are asked to copy all the same: the one that everybody waits for.
    constexpr intptr_t kLegacy = 1;
    copy.keep = tensor.pictures->CopyOnDevice(tensor.data, bytes, reinterpret_cast<void*>(wishes.stream < 0 ? kLegacy : wishes.stream));
  } else {
    const std::shared_ptr<std::byte[]> host(new std::byte[bytes]);
    if (tensor.pictures) {
      tensor.pictures->CopyToHost(host.get(), tensor.data, bytes);
    } else {
      std::memcpy(host.get(), tensor.data, bytes);
    }
    copy.keep = host;
    copy.cuda = -1;
    copy.pictures = nullptr;
  }
  copy.data = copy.keep.get();
  return copy;
}

// The numbers of the protocol: None and 1 are CUDA's legacy stream, 2 the one of each thread, others addresses; 0 could mean either of the
// first two and is not allowed.
intptr_t ReadStream(const Tensor& tensor, const py::object& stream) {
  const intptr_t number = stream.is_none() ? (tensor.pictures ? 1 : -1) : stream.cast<intptr_t>();
  if (!tensor.pictures && number != -1) throw py::value_error("stream: memory of the CPU has no streams");
  if (number == 0 || number < -1)
    throw py::value_error("stream: " + std::to_string(number) + " is not -1 (none), 1 (legacy), 2 (of the thread) or an address");
  return number;
}

Wishes ReadWishes(const Tensor& tensor, const py::object& stream, const py::object& device, const py::object& copy) {
  Wishes wishes{.stream = ReadStream(tensor, stream)};
  const bool may_copy = copy.is_none() || copy.cast<bool>();
  wishes.copy = !copy.is_none() && copy.cast<bool>();
  if (device.is_none()) return wishes;
  const auto [type, id] = device.cast<std::pair<int, int>>();
  const int own_type = tensor.cuda >= 0 ? kCudaDevice : kCpuDevice, own_id = std::max(tensor.cuda, 0);
  if (type == own_type && id == own_id) return wishes;
  if (type != kCpuDevice || id != 0)
    throw py::buffer_error("dl_device: the picture is in memory of device (" + std::to_string(own_type) + ", " + std::to_string(own_id) +
                           "), and goes to that or to the CPU's (1, 0) alone");
  if (!may_copy) throw py::buffer_error("dl_device: memory of the CPU would need a copy, which copy=False forbids");
  wishes.to_cpu = wishes.copy = true;
  return wishes;
}

py::capsule ToDlpack(const Tensor& tensor, const py::object& stream, const py::object& max_version, const py::object& device,
                     const py::object& copy) {
  const Wishes wishes = ReadWishes(tensor, stream, device, copy);
  const bool versioned = !max_version.is_none() && max_version.cast<std::pair<int, int>>().first >= 1;
  Tensor given = tensor;
  if (wishes.copy) {
    const py::gil_scoped_release release;
    given = Copied(tensor, wishes);
  }
  // The pictures are complete, so that no stream has to wait for anything.
  return versioned ? Pack<ManagedVersioned>(given, wishes.copy) : Pack<Managed>(given, wishes.copy);
}

}  // namespace

py::object ToTensor(const py::object& picture) {
  const auto array = picture.cast<py::array>();
  Tensor tensor;
  tensor.data = array.data();
  // Asked of NumPy: where NumPy 2 keeps it, pybind11 before 2.12 finds 0.
  const auto itemsize = array.attr("itemsize").cast<py::ssize_t>();
  for (py::ssize_t k = 0; k < array.ndim(); ++k) {
    tensor.shape.push_back(array.shape(k));
    tensor.strides.push_back(array.strides(k) / itemsize);
  }
  const char kind = array.dtype().kind();
  tensor.type = {kind == 'f' ? TensorType::kFloat : kind == 'i' ? TensorType::kInt : TensorType::kUint, static_cast<uint8_t>(8 * itemsize)};
  tensor.keep = std::shared_ptr<const void>(array.data(), [held = new py::array(array)](const void*) {
    if (Py_IsInitialized() == 0) return;
    const py::gil_scoped_acquire gil;
    delete held;
  });
  return py::cast(std::move(tensor));
}

void BindTensor(py::module_& m) {
  py::class_<Tensor>(m, "Tensor", R"(A picture as DLPack exports it: pass it to torch, jax, cupy or numpy's from_dlpack.

Nothing is copied; the memory stays alive for as long as any consumer has it. copy=True, or dl_device=(1, 0) of a picture on a GPU, gives a copy.)")
      .def("__dlpack__", &ToDlpack, py::kw_only(), py::arg("stream") = py::none(), py::arg("max_version") = py::none(),
           py::arg("dl_device") = py::none(), py::arg("copy") = py::none())
      .def("__dlpack_device__",
           [](const Tensor& t) { return py::make_tuple(static_cast<int>(t.cuda >= 0 ? kCudaDevice : kCpuDevice), std::max(t.cuda, 0)); })
      .def_property_readonly(
          "shape",
          [](const Tensor& t) {
            py::tuple shape(t.shape.size());
            for (size_t i = 0; i < t.shape.size(); ++i) shape[i] = t.shape[i];
            return shape;
          },
          "(H, W) or (H, W, channels).");
}

}  // namespace airsim360::python
