#include "airsim360/app/rpc_client.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

constexpr WireLimits kAnswer{.bytes = size_t{512} << 20, .values = size_t{1} << 24, .depth = 32};
constexpr size_t kPiece = size_t{1} << 16;
constexpr timeval kSocketPatience{.tv_sec = 10, .tv_usec = 0};

bool IsPort(std::string_view text) {
  int port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  return error == std::errc() && end == text.data() + text.size() && port > 0 && port <= 65535;
}

}  // namespace

void CheckAddress(const std::string& address) {
  const size_t colon = address.rfind(':');
  const bool plain = std::ranges::all_of(address, [](unsigned char c) { return std::isalnum(c) || std::strchr(".-_:[]", c); });
  if (colon == std::string::npos || colon == 0 || !plain || !IsPort(std::string_view(address).substr(colon + 1)))
    throw InputError("--connect: '" + address + "' is not HOST:PORT, for example 127.0.0.1:41451");
}

RpcClient::RpcClient(const std::string& address) : address_(address) {
  CheckAddress(address);
  const size_t colon = address.rfind(':');
  host_ = address.substr(0, colon), port_ = address.substr(colon + 1);
  const std::lock_guard lock(mutex_);
  Connect();
}

RpcClient::~RpcClient() { Close(); }

void RpcClient::Close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

void RpcClient::Connect() {
  addrinfo wanted{}, *found = nullptr;
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  if (::getaddrinfo(host_.c_str(), port_.c_str(), &wanted, &found) != 0)
    throw RuntimeError("--connect: '" + host_ + "' is no known machine");
  for (const addrinfo* at = found; at != nullptr && socket_ < 0; at = at->ai_next) {
    socket_ = ::socket(at->ai_family, at->ai_socktype | SOCK_CLOEXEC, at->ai_protocol);
    if (socket_ < 0) continue;
    const int one = 1;
    ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &kSocketPatience, sizeof kSocketPatience);
    ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &kSocketPatience, sizeof kSocketPatience);
    if (::connect(socket_, at->ai_addr, at->ai_addrlen) != 0) Close();
  }
  ::freeaddrinfo(found);
  if (socket_ < 0)
    throw RuntimeError("--connect: nobody answers at " + address_ +
                       "; start 'airsim360 serve' or 'airsim360 agent' with --world W --port " + port_ + " first");
}

void RpcClient::Send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) throw RuntimeError("the server at " + address_ + " is gone");
    bytes.remove_prefix(static_cast<size_t>(sent));
  }
}

std::string RpcClient::Receive() {
  std::string bytes;
  WireScanner scanner(kAnswer);
  for (;;) {
    const size_t before = bytes.size();
    bytes.resize(before + kPiece);
    const ssize_t got = ::recv(socket_, bytes.data() + before, kPiece, 0);
    if (got <= 0) throw RuntimeError("the server at " + address_ + (got == 0 ? " is gone" : " does not answer"));
    bytes.resize(before + static_cast<size_t>(got));
    if (scanner.Scan({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()})) return bytes;
  }
}

void RpcClient::Call(std::string_view method, size_t count, const std::function<void(WireWriter&)>& arguments,
                     const std::function<void(const WireValue&)>& read) {
  const std::lock_guard lock(mutex_);
  WireWriter writer;
  writer.ArrayHeader(4);
  writer.Int(0);
  writer.Uint(next_++);
  writer.String(method);
  writer.ArrayHeader(count);
  arguments(writer);
  try {
    if (socket_ < 0) Connect();
    Send(writer.bytes());
    const std::string bytes = Receive();
    const WireValue answer = DecodeWire({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}, kAnswer);
    if (answer.kind != WireValue::Kind::kArray || answer.items.size() != 4)
      throw RuntimeError("what answers at " + address_ + " is no AirSim server");
    if (answer.items[2].kind != WireValue::Kind::kNil)
      throw InputError("the server at " + address_ + " says: " + std::string(answer.items[2].text));
    read(answer.items[3]);
  } catch (const InputError&) {
    throw;  // the connection is as good as before
  } catch (const std::exception& error) {
    Close();
    throw RuntimeError(error.what());
  }
}

void RpcClient::Post(std::string_view method, size_t count, const std::function<void(WireWriter&)>& arguments) {
  const std::lock_guard lock(mutex_);
  WireWriter writer;
  writer.ArrayHeader(3);
  writer.Int(2);
  writer.String(method);
  writer.ArrayHeader(count);
  arguments(writer);
  if (socket_ < 0) Connect();
  try {
    Send(writer.bytes());
  } catch (const RuntimeError&) {
    Close();
    throw;
  }
}

}  // namespace airsim360
