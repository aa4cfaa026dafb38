// Datasets of HDF5 files, by the HDF5 library.
#include <fcntl.h>
#include <hdf5.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "airsim360/base/error.h"
#include "airsim360/eval/files/hdf5_file.h"
#include "airsim360/image/codecs.h"

namespace airsim360 {
namespace {

// Closes what it holds, whatever its kind.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  hid_t get() const { return id_; }
  bool ok() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

constexpr H5Z_filter_t kLzf = 32000;  // number of h5py's filter in the HDF Group's list

// LibLZF's format: runs of literals, and copies from up to 8191 bytes before. 0 = damaged.
size_t DecompressLzf(const unsigned char* in, size_t in_size, unsigned char* out, size_t out_size) {
  size_t from = 0, to = 0;
  while (from < in_size) {
    const size_t control = in[from++];
    if (control < 32) {
      if (from + control + 1 > in_size || to + control + 1 > out_size) return 0;
      for (size_t i = 0; i <= control; ++i) out[to++] = in[from++];
      continue;
    }
    size_t length = control >> 5;
    if (length == 7) {
      if (from >= in_size) return 0;
      length += in[from++];
    }
    if (from >= in_size) return 0;
    const size_t back = ((control & 31) << 8 | in[from++]) + 1;
    if (back > to || to + length + 2 > out_size) return 0;
    for (size_t i = 0; i < length + 2; ++i, ++to) out[to] = out[to - back];
  }
  return to;
}

// The signature is the library's. h5py stores the size of a chunk as the third value.
size_t LzfFilter(unsigned flags, size_t count, const unsigned values[], size_t size, size_t* buffer_size, void** buffer) {
  if (!(flags & H5Z_FLAG_REVERSE) || count < 3 || values[2] == 0 || values[2] > 4u * kMaxPixels) return 0;
  void* out = std::malloc(values[2]);
  if (!out) return 0;
  const size_t got = DecompressLzf(static_cast<const unsigned char*>(*buffer), size, static_cast<unsigned char*>(out), values[2]);
  if (got == 0) {
    std::free(out);
    return 0;
  }
  std::free(*buffer);
  *buffer = out;
  *buffer_size = values[2];
  return got;
}

void PrepareLibrary() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  static const H5Z_class2_t kFilter = {H5Z_CLASS_T_VERS, kLzf, 0, 1, "lzf", nullptr, nullptr, LzfFilter};
  H5Zregister(&kFilter);
}

herr_t CollectNames(hid_t, const char* name, const H5O_info_t* info, void* names) {
  if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

std::string ChooseDataset(hid_t file, const std::string& key, const std::string& path) {
  std::vector<std::string> names;
  if (H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, CollectNames, &names, H5O_INFO_BASIC) < 0) throw InputError(path + ": damaged");
  if (!key.empty()) {
    for (const std::string& name : names) {
      if (name == key || "/" + name == key) return name;
    }
    throw InputError(path + ": " + UnknownChoiceMessage("dataset", key, names));
  }
  for (const char* usual : {"depth", "range", "data"}) {
    for (const std::string& name : names) {
      if (name == usual) return name;
    }
  }
  if (names.size() == 1) return names[0];
  throw InputError(path + ": has " + std::to_string(names.size()) +
                   " datasets, none of them named depth, range or data: name one with --h5-key");
}

std::vector<int64_t> Shape(hid_t dataset, const std::string& where) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  hsize_t sizes[H5S_MAX_RANK];
  const int rank = H5Sget_simple_extent_dims(space.get(), sizes, nullptr);
  if (rank < 1) throw InputError(where + ": is no array");
  std::vector<int64_t> shape;
  hsize_t count = 1;
  for (int i = 0; i < rank; ++i) {
    if (sizes[i] < 1 || sizes[i] > static_cast<hsize_t>(kMaxPixels)) throw InputError(where + ": empty or too large");
    count *= sizes[i];
    if (count > static_cast<hsize_t>(kMaxPixels)) throw InputError(where + ": too large");
    shape.push_back(static_cast<int64_t>(sizes[i]));
  }
  return shape;
}

NumberArray ReadHere(const std::filesystem::path& path, const std::string& key) {
  PrepareLibrary();
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file.ok()) throw InputError(path.string() + ": cannot be read as an HDF5 file");
  const std::string name = ChooseDataset(file.get(), key, path.string()), where = path.string() + ":/" + name;
  const Handle dataset(H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset.ok()) throw InputError(where + ": cannot be read");
  const Handle type(H5Dget_type(dataset.get()), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type.get());
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) throw InputError(where + ": is not made of numbers");
  NumberArray array{Shape(dataset.get(), where), {}};
  size_t count = 1;
  for (const int64_t n : array.shape) count *= static_cast<size_t>(n);
  array.values.resize(count);
  if (H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()) < 0)
    throw InputError(where + ": is damaged or packed by a filter that is not known (gzip, shuffle and LZF are)");
  return array;
}

// What a reading process tells: 0 and an array, or 1 and a message; each size as 64 bits.
void Send(int to, const void* data, size_t size) {
  const char* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = write(to, bytes, size);
    if (sent <= 0) _exit(1);
    bytes += sent;
    size -= static_cast<size_t>(sent);
  }
}

void SendSized(int to, const void* data, uint64_t count, size_t each) {
  Send(to, &count, sizeof(count));
  Send(to, data, count * each);
}

[[noreturn]] void ReadAndSend(const std::filesystem::path& path, const std::string& key, int to) {
  try {
    const NumberArray array = ReadHere(path, key);
    SendSized(to, array.shape.data(), array.shape.size(), sizeof(int64_t));
    SendSized(to, array.values.data(), array.values.size(), sizeof(double));
  } catch (const std::exception& error) {
    const std::string text = error.what();
    SendSized(to, nullptr, 0, 1);
    SendSized(to, text.data(), text.size(), 1);
  }
  _exit(0);
}

bool Receive(int from, void* data, size_t size) {
  char* bytes = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t got = read(from, bytes, size);
    if (got <= 0) return false;
    bytes += got;
    size -= static_cast<size_t>(got);
  }
  return true;
}

template <class Container>
bool ReceiveSized(int from, Container& container) {
  uint64_t count = 0;
  if (!Receive(from, &count, sizeof(count)) || count > static_cast<uint64_t>(kMaxPixels)) return false;
  container.resize(count);
  return Receive(from, container.data(), count * sizeof(container[0]));
}

}  // namespace

// The library crashes on some damaged files, so a process of its own reads. Nothing but the library and the allocator runs there.
NumberArray ReadHdf5(const std::filesystem::path& path, const std::string& key) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw RuntimeError("cannot make a pipe to read " + path.string());
  const pid_t reader = fork();
  if (reader == 0) ReadAndSend(path, key, ends[1]);
  close(ends[1]);
  NumberArray array;
  std::string message;
  bool whole = reader > 0 && ReceiveSized(ends[0], array.shape);
  whole = whole && (array.shape.empty() ? ReceiveSized(ends[0], message) : ReceiveSized(ends[0], array.values));
  close(ends[0]);
  if (reader < 0) throw RuntimeError("cannot start a process to read " + path.string());
  int status = 0;
  waitpid(reader, &status, 0);
  if (!whole || !WIFEXITED(status)) throw InputError(path.string() + ": is damaged; the HDF5 library cannot read it");
  if (!message.empty()) throw InputError(message);
  return array;
}

}  // namespace airsim360
