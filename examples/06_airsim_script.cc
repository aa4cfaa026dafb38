// Example 6: an AirSim script in C++: the server in this process, msgpack-rpc over its socket.
//   build/bin/06_airsim_script
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "airsim360/opening/world_loader.h"
#include "airsim360/rpc/server.h"
#include "airsim360/rpc/wire/wire_convert.h"

namespace {

using namespace airsim360;

// A client of AirSim's protocol: a request is [0, id, method, arguments], its answer [1, id, error, result].
class Client {
 public:
  explicit Client(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in where{.sin_family = AF_INET, .sin_port = htons(static_cast<uint16_t>(port)), .sin_addr = {}, .sin_zero = {}};
    where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&where), sizeof where) != 0)
      throw std::runtime_error("cannot connect");
  }
  ~Client() { ::close(socket_); }

  /// The result, valid until the next call.
  template <class... Arguments>
  const WireValue& Call(const char* method, const Arguments&... arguments) {
    WireWriter writer;
    writer.ArrayHeader(4);
    writer.Int(0);
    writer.Uint(++id_);
    writer.String(method);
    writer.ArrayHeader(sizeof...(arguments));
    (ToWire(writer, arguments), ...);
    if (::send(socket_, writer.bytes().data(), writer.bytes().size(), 0) < 0) throw std::runtime_error("send");
    bytes_.clear();
    WireScanner scanner;
    char buffer[65536];
    while (true) {
      const ssize_t got = ::recv(socket_, buffer, sizeof buffer, 0);
      if (got <= 0) throw std::runtime_error("the server has closed the connection");
      bytes_.insert(bytes_.end(), buffer, buffer + got);
      if (scanner.Scan(bytes_)) break;
    }
    answer_ = DecodeWire(bytes_);
    if (answer_.items[2].kind == WireValue::Kind::kString) throw std::runtime_error(std::string(answer_.items[2].text));
    return answer_.items[3];
  }

 private:
  int socket_;
  uint64_t id_ = 0;
  std::vector<uint8_t> bytes_;
  WireValue answer_;
};

}  // namespace

int main() {
  // A clock four times as fast as the wall's; any free port.
  ServerOptions options{.port = 0};
  options.settings.clock_speed = 4;
  const AirSimServer server(std::make_shared<Stage>(StageOptions{.world = {.world = "box_room"}, .device = {.device = "cpu"}}), options);
  Client client(server.port());
  const std::string drone;  // the first one
  client.Call("enableApiControl", true, drone);
  client.Call("armDisarm", true, drone);
  client.Call("takeoff", 20.0f, drone);
  client.Call("moveToZ", -3.0f, 1.0f, 20.0f, airsim::YawMode{}, -1.0f, 1.0f, drone);
  const WireValue& pose = client.Call("simGetVehiclePose", drone);
  const double z = pose.Find("position")->Find("z_val")->real;
  std::printf("north-east-down: %.2f m below where it started\n", z);
  return std::abs(z + 3) < 0.6 ? 0 : 1;
}
