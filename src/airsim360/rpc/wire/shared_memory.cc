#include "airsim360/rpc/wire/shared_memory.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "airsim360/base/log.h"

namespace airsim360 {
namespace {

constexpr size_t kMostLoans = 16, kMostBytes = size_t{1} << 30;  // over all clients

// The descriptor that came with a message, -1 if there was none; -2 when the peer has gone. Others are closed.
int ReceiveDescriptor(int socket) {
  char byte = 0;
  iovec piece{&byte, 1};
  alignas(cmsghdr) char control[CMSG_SPACE(4 * sizeof(int))];
  msghdr message{};
  message.msg_iov = &piece;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  const ssize_t got = ::recvmsg(socket, &message, MSG_DONTWAIT | MSG_CMSG_CLOEXEC);
  int found = -1;
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); got >= 0 && part != nullptr; part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_RIGHTS) continue;
    const size_t count = (part->cmsg_len - CMSG_LEN(0)) / sizeof(int);
    for (size_t i = 0; i < count; ++i) {
      int fd = -1;
      std::memcpy(&fd, CMSG_DATA(part) + i * sizeof fd, sizeof fd);
      found < 0 ? (void)(found = fd) : (void)::close(fd);
    }
  }
  const bool again = got < 0 && (errno == EAGAIN || errno == EINTR);
  return found >= 0 || again ? found : got <= 0 ? -2 : -1;
}

int ListenAt(const std::string& name) {
  sockaddr_un where{};
  where.sun_family = AF_UNIX;
  std::memcpy(where.sun_path + 1, name.data(), name.size());
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  const int fd = ::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd < 0) return -1;
  if (::bind(fd, reinterpret_cast<const sockaddr*>(&where), size) == 0 && ::listen(fd, 16) == 0) return fd;
  ::close(fd);
  return -1;
}

}  // namespace

std::shared_ptr<SharedMemory> SharedMemory::Map(int fd) {
  struct stat file {};
  const int seals = ::fcntl(fd, F_GET_SEALS);
  const bool usable = seals >= 0 && (seals & F_SEAL_SHRINK) != 0 && ::fstat(fd, &file) == 0 && file.st_size > 0 &&
                      static_cast<size_t>(file.st_size) <= kMost;
  const auto size = static_cast<size_t>(usable ? file.st_size : 0);
  void* data = usable ? ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0) : MAP_FAILED;
  ::close(fd);
  if (data == MAP_FAILED) return nullptr;
  return std::shared_ptr<SharedMemory>(new SharedMemory(static_cast<char*>(data), size));
}

SharedMemory::~SharedMemory() { ::munmap(data_, size_); }

LentRegion::LentRegion(std::shared_ptr<SharedMemory> memory, uint64_t offset, uint64_t size)
    : memory_(std::move(memory)), begin_(offset), end_(offset + size), next_(offset) {
  const bool inside = offset <= memory_->size() && size <= memory_->size() - offset;
  if (!inside || offset % kAlignment != 0) throw std::invalid_argument("the memory has no such region");
}

std::shared_ptr<char[]> LentRegion::Take(size_t size) {
  const uint64_t room = (size + kAlignment - 1) / kAlignment * kAlignment;
  wanted_ += room;
  if (size == 0 || size > end_ - next_) return nullptr;
  char* bytes = memory_->data() + next_;
  next_ = std::min(next_ + room, end_);
  return {memory_, bytes};
}

bool LentRegion::Has(const char* bytes) const { return bytes >= memory_->data() + begin_ && bytes < memory_->data() + next_; }

struct MemoryLoans::Impl {
  struct Lender {
    int socket = -1;
    uint64_t token = 0;  // 0: none yet
  };

  int listener = -1, wake = -1;
  std::vector<Lender> lenders;  // of the thread
  mutable std::mutex mutex;     // of what follows
  std::map<uint64_t, std::shared_ptr<SharedMemory>> loans;
  std::thread thread;

  // Keeps the memory; 0 if there is too much already.
  uint64_t Keep(std::shared_ptr<SharedMemory> memory) {
    uint64_t token = 0;
    if (::getrandom(&token, sizeof token, 0) != sizeof token) return 0;
    const std::lock_guard lock(mutex);
    size_t bytes = memory->size();
    for (const auto& [other, loan] : loans) bytes += loan->size();
    if (token == 0 || bytes > kMostBytes || !loans.emplace(token, std::move(memory)).second) return 0;
    return token;
  }

  // False: this connection has come to its end.
  bool Serve(Lender& lender) {
    const int fd = ReceiveDescriptor(lender.socket);
    if (fd < 0) return fd == -1;
    std::shared_ptr<SharedMemory> memory = SharedMemory::Map(fd);
    if (lender.token != 0 || !memory) return false;
    lender.token = Keep(std::move(memory));
    return lender.token != 0 && ::send(lender.socket, &lender.token, sizeof lender.token, MSG_DONTWAIT | MSG_NOSIGNAL) ==
                                    static_cast<ssize_t>(sizeof lender.token);
  }

  void End(const Lender& lender) {
    ::close(lender.socket);
    const std::lock_guard lock(mutex);
    loans.erase(lender.token);
  }

  void Accept() {
    const int fd = ::accept4(listener, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (fd < 0) return;
    lenders.size() < kMostLoans ? lenders.push_back({fd}) : (void)::close(fd);
  }

  void Run() {
    while (true) {
      std::vector<pollfd> waits{{wake, POLLIN, 0}, {listener, POLLIN, 0}};
      for (const Lender& lender : lenders) waits.push_back({lender.socket, POLLIN, 0});
      ::poll(waits.data(), waits.size(), -1);
      if (waits[0].revents != 0) break;
      // From the end, so that the others keep their numbers.
      for (size_t i = lenders.size(); i-- > 0;) {
        if (waits[i + 2].revents == 0 || Serve(lenders[i])) continue;
        End(lenders[i]);
        lenders.erase(lenders.begin() + static_cast<std::ptrdiff_t>(i));
      }
      if (waits[1].revents != 0) Accept();
    }
    for (const Lender& lender : lenders) End(lender);
  }
};

MemoryLoans::MemoryLoans() : impl_(std::make_unique<Impl>()) {}

void MemoryLoans::Listen(int port) {
  impl_->listener = ListenAt("airsim360/" + std::to_string(port));
  impl_->wake = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  if (impl_->listener < 0 || impl_->wake < 0) {
    LogWarning("clients cannot lend memory for pictures, which all go through sockets: no Unix socket to be had");
    return;
  }
  impl_->thread = std::thread([this] { impl_->Run(); });
}

MemoryLoans::~MemoryLoans() {
  const uint64_t one = 1;
  [[maybe_unused]] const ssize_t put = ::write(impl_->wake, &one, sizeof one);
  if (impl_->thread.joinable()) impl_->thread.join();
  if (impl_->listener >= 0) ::close(impl_->listener);
  if (impl_->wake >= 0) ::close(impl_->wake);
}

std::shared_ptr<SharedMemory> MemoryLoans::Find(uint64_t token) const {
  const std::lock_guard lock(impl_->mutex);
  const auto found = impl_->loans.find(token);
  if (found == impl_->loans.end()) throw std::invalid_argument("no memory has been lent under this token");
  return found->second;
}

size_t MemoryLoans::count() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->loans.size();
}

}  // namespace airsim360
