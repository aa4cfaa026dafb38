#include "airsim360/rpc/wire/connection.h"

#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <string>

namespace airsim360::internal {
namespace {

constexpr size_t kReadBytes = size_t{64} << 10;  // in one turn
constexpr size_t kFlushBytes = size_t{1} << 20;  // in one turn of the server's thread

bool WouldBlock(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

}  // namespace

Connection::Connection(ConnectionId id, int fd, const TcpLimits& limits, Totals& totals)
    : id_(id), fd_(fd), limits_(limits), totals_(totals), scanner_(limits.message) {}

Connection::~Connection() {
  totals_.output -= queued_;
  totals_.input -= held_bytes_;
  ::close(fd_);
}

Connection::Read Connection::ReadSome(const std::function<void(std::string)>& on_message) {
  char buffer[kReadBytes];
  const ssize_t got = ::recv(fd_, buffer, sizeof buffer, MSG_DONTWAIT);
  if (got == 0 || (got < 0 && !WouldBlock(errno))) return Read::kEnded;
  if (got > 0) {
    input_.append(buffer, static_cast<size_t>(got));
    held_bytes_ += static_cast<size_t>(got);
    totals_.input += static_cast<size_t>(got);
    if (totals_.input > limits_.total_input_bytes && held_bytes_ > limits_.small_input_bytes)
      throw WireError("all clients together have sent more than " + std::to_string(limits_.total_input_bytes >> 20) +
                      " MiB that is not answered yet");
  }

  // Hand over what is complete; the rest stays at the front.
  size_t start = 0;
  while (start < input_.size()) {
    const auto* bytes = reinterpret_cast<const uint8_t*>(input_.data());
    const auto length = scanner_.Scan({bytes + start, input_.size() - start});
    if (!length) break;
    ++unanswered_;
    unanswered_bytes_ += *length;
    has_called_ = true;
    on_message(input_.substr(start, *length));
    start += *length;
  }
  input_.erase(0, start);
  if (input_.empty() && input_.capacity() > 16 * kReadBytes) input_.shrink_to_fit();
  return Read::kOpen;
}

void Connection::Settle(size_t message_bytes) {
  --unanswered_;
  unanswered_bytes_ -= message_bytes;
  held_bytes_ -= message_bytes;
  totals_.input -= message_bytes;
}

Connection::Sent Connection::Send(WireBlocks bytes) {
  const std::lock_guard lock(mutex_);
  if (broken_) return Sent::kGone;
  if (queued_ > limits_.output_bytes) {
    AbandonLocked();
    return Sent::kTooSlow;
  }
  if (output_.empty()) last_read_ = std::chrono::steady_clock::now();
  const size_t size = SizeOf(bytes);
  queued_ += size;
  totals_.output += size;
  for (WireBlock& block : bytes) output_.push_back(std::move(block));
  return FlushLocked(SIZE_MAX) ? Sent::kYes : Sent::kGone;
}

std::chrono::steady_clock::time_point Connection::last_read() const {
  const std::lock_guard lock(mutex_);
  return last_read_;
}

void Connection::Abandon() {
  const std::lock_guard lock(mutex_);
  AbandonLocked();
}

// Memory goes at once, not when the last user of the connection has let go.
void Connection::AbandonLocked() {
  broken_ = true;
  output_.clear();
  totals_.output -= queued_;
  queued_ = 0;
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
      AbandonLocked();
      break;
    }
    last_read_ = std::chrono::steady_clock::now();
    sent += static_cast<size_t>(put);
    queued_ -= static_cast<size_t>(put);
    totals_.output -= static_cast<size_t>(put);
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
