// The functions a client can call, by name and number of arguments.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "airsim360/rpc/wire/reply.h"

namespace airsim360 {

namespace internal {
template <class F>
struct Signature : Signature<decltype(&F::operator())> {};
template <class C, class R, class... A>
struct Signature<R (C::*)(A...) const> {
  using Arguments = std::tuple<std::decay_t<A>...>;
};
template <class R, class... A>
struct Signature<R (*)(A...)> {
  using Arguments = std::tuple<std::decay_t<A>...>;
};

/// The rest of a tuple after its first N types.
template <size_t N, class Tuple, class = void>
struct TupleTail;
template <class Tuple>
struct TupleTail<0, Tuple> {
  using type = Tuple;
};
template <size_t N, class First, class... Rest>
struct TupleTail<N, std::tuple<First, Rest...>, std::enable_if_t<(N > 0)>> : TupleTail<N - 1, std::tuple<Rest...>> {};

/// A lambda without captures as a pointer to a function, so that all of one signature are one type, and what takes them is compiled once.
template <class F>
auto Plain(F f) {
  if constexpr (std::is_empty_v<F>) {
    return +f;
  } else {
    return f;
  }
}
}  // namespace internal

class MethodTable {
 public:
  /// Takes the checked arguments and returns what is to be run with the reply, here or elsewhere.
  using Handler = std::function<void(const std::vector<WireValue>& arguments, const Reply& reply)>;

  /// `most` arguments of which the last `optional` may be missing. A name may be added once.
  void Add(std::string name, size_t most, size_t optional, Handler handler);

  /// Calls the method, or answers with rpclib's error for a name or a number of arguments that there is not.
  void Call(const RpcMessage& message, const Reply& reply) const;
  std::vector<std::string> Names() const;

  /// Reads the arguments of a function whose first `Skip` parameters are not the client's. Missing ones keep
  /// their defaults. Throws BadArgument.
  template <class F, size_t Skip>
  static auto Read(const std::vector<WireValue>& values) {
    return ReadAll<typename internal::TupleTail<Skip, typename internal::Signature<F>::Arguments>::type>(values);
  }

 private:
  template <class Arguments>
  static Arguments ReadAll(const std::vector<WireValue>& values) {
    Arguments arguments{};
    size_t i = 0;
    const auto read = [&](auto& argument) {
      if (i < values.size()) FromWire(values[i], argument);
      ++i;
    };
    try {
      std::apply([&](auto&... argument) { (read(argument), ...); }, arguments);
    } catch (BadArgument& error) {
      error.InArgument(i + 1);
      throw;
    }
    return arguments;
  }

  struct Method {
    size_t most = 0, optional = 0;
    Handler handler;
  };
  std::map<std::string, Method, std::less<>> methods_;
};

}  // namespace airsim360
