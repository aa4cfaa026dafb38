#include "airsim360/rpc/connection.h"

#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>

namespace airsim360::internal {
namespace {

constexpr size_t kReadBytes = size_t{64} << 10;   // in one turn
constexpr size_t kFlushBytes = size_t{1} << 20;  // in one turn of the server's thread

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

bool Connection::Send(WireBlocks bytes) {
  const std::lock_guard lock(mutex_);
  if (broken_) return false;
  const size_t size = SizeOf(bytes);
  queued_ += size;
  total_output_ += size;
  for (WireBlock& block : bytes) output_.push_back(std::move(block));
  if (!FlushLocked(SIZE_MAX)) return false;
  if (queued_ > limits_.output_bytes || (queued_ > 0 && total_output_ > limits_.total_output_bytes))
    broken_ = true;
  return !broken_;
}

bool Connection::Flush() {
  const std::lock_guard lock(mutex_);
  return FlushLocked(kFlushBytes);
}

// Sends about `most` bytes of the queue, as far as the socket takes them.
bool Connection::FlushLocked(size_t most) {
  size_t sent = 0;
  while (!output_.empty() && !broken_ && sent < most) {
    std::array<iovec, 16> pieces;
    size_t count = 0;
    for (auto block = output_.begin(); block != output_.end() && count < pieces.size(); ++block, ++count) {
      const size_t skip = count == 0 ? sent_ : 0;
      pieces[count] = {const_cast<char*>(block->data()) + skip, block->size() - skip};
    }
    msghdr message{};
    message.msg_iov = pieces.data();
    message.msg_iovlen = count;
    const ssize_t put = ::sendmsg(fd_, &message, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (put < 0) {
      if (WouldBlock(errno)) return true;
      broken_ = true;
      break;
    }
    sent += static_cast<size_t>(put);
    queued_ -= static_cast<size_t>(put);
    total_output_ -= static_cast<size_t>(put);
    // Blocks that have gone wholly are let go.
    sent_ += static_cast<size_t>(put);
    while (!output_.empty() && sent_ >= output_.front().size()) {
      sent_ -= output_.front().size();
      output_.pop_front();
    }
  }
  return !broken_;
}

}  // namespace airsim360::internal
