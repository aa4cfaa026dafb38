#include "airsim360/rpc/connection.h"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

namespace airsim360::internal {
namespace {

constexpr size_t kReadBytes = size_t{64} << 10;  // in one turn

bool WouldBlock(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

}  // namespace

Connection::Connection(ConnectionId id, int fd, const TcpLimits& limits, std::atomic<size_t>& total_output)
    : id_(id), fd_(fd), limits_(limits), total_output_(total_output), scanner_(limits.message) {}

Connection::~Connection() {
  total_output_ -= queued_;
  ::close(fd_);
}

Connection::Read Connection::ReadSome(const std::function<void(std::string)>& on_message) {
  char buffer[kReadBytes];
  const ssize_t got = ::recv(fd_, buffer, sizeof buffer, MSG_DONTWAIT);
  if (got == 0 || (got < 0 && !WouldBlock(errno))) return Read::kEnded;
  if (got > 0) input_.append(buffer, static_cast<size_t>(got));

  // Hand over what is complete; the rest stays at the front.
  size_t start = 0;
  while (start < input_.size()) {
    const auto* bytes = reinterpret_cast<const uint8_t*>(input_.data());
    const auto length = scanner_.Scan({bytes + start, input_.size() - start});
    if (!length) break;
    ++unanswered;
    on_message(input_.substr(start, *length));
    start += *length;
  }
  input_.erase(0, start);
  if (input_.empty() && input_.capacity() > 16 * kReadBytes) input_.shrink_to_fit();
  return Read::kOpen;
}

bool Connection::Send(std::string bytes) {
  const std::lock_guard lock(mutex_);
  if (broken_) return false;
  queued_ += bytes.size();
  total_output_ += bytes.size();
  output_.push_back(std::move(bytes));
  if (!FlushLocked()) return false;
  if (queued_ > limits_.output_bytes || (queued_ > 0 && total_output_ > limits_.total_output_bytes))
    broken_ = true;
  return !broken_;
}

bool Connection::Flush() {
  const std::lock_guard lock(mutex_);
  return FlushLocked();
}

bool Connection::FlushLocked() {
  while (!output_.empty() && !broken_) {
    const std::string& front = output_.front();
    const ssize_t put = ::send(fd_, front.data() + sent_, front.size() - sent_, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (put < 0) {
      if (WouldBlock(errno)) return true;
      broken_ = true;
      break;
    }
    sent_ += static_cast<size_t>(put);
    queued_ -= static_cast<size_t>(put);
    total_output_ -= static_cast<size_t>(put);
    if (sent_ < front.size()) continue;
    output_.pop_front();
    sent_ = 0;
  }
  return !broken_;
}

}  // namespace airsim360::internal
