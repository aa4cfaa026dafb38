// The functions of AirSim's API on a running session, and where each of them runs.
#pragma once

#include "airsim360/base/log.h"
#include "airsim360/rpc/images/image_service.h"
#include "airsim360/rpc/session/notice.h"
#include "airsim360/rpc/session/session.h"
#include "airsim360/rpc/wire/method_table.h"

namespace airsim360 {

/// Fills a method table. Every function is a lambda whose parameters after the first ones are the client's
/// arguments, in their order on the wire; `optional` of the last may be missing.
class Api {
 public:
  Api(Session& session, ImageService& images, const MemoryLoans& loans) : session_(session), images_(images), loans_(loans) {}

  MethodTable& table() { return table_; }
  Session& session() { return session_; }
  ImageService& images() { return images_; }
  const MemoryLoans& loans() const { return loans_; }

  /// f(const Snapshot&, …): answers from the present snapshot, in the server's own thread; must be quick.
  template <class F>
  void Read(const char* name, F function, size_t optional = 0) {
    Add<1>(name, optional, internal::Plain(function), [this](const auto& f, auto arguments, const Reply& reply) {
      const SnapshotPointer snapshot = session_.snapshot();
      std::apply([&](auto&... argument) { Answer(reply, [&] { return f(*snapshot, argument...); })(); }, arguments);
    });
  }

  /// f(Session&, …): runs between two steps.
  template <class F>
  void Change(const char* name, F function, size_t optional = 0) {
    Add<1>(name, optional, internal::Plain(function), [this](const auto& f, auto arguments, const Reply& reply) {
      session_.Post([f, arguments, reply](Session& session) mutable {
        return std::apply([&](auto&... argument) { return Answer(reply, [&] { return f(session, argument...); }); }, arguments);
      });
    });
  }

  /// f(Session&, const Reply&, …): as Change, but answers later by itself.
  template <class F>
  void Start(const char* name, F function) {
    Add<2>(name, 0, internal::Plain(function), [this](const auto& f, auto arguments, const Reply& reply) {
      session_.Post([f, arguments, reply](Session& session) mutable -> std::function<void()> {
        try {
          std::apply([&](auto&... argument) { f(session, reply, argument...); }, arguments);
        } catch (const std::exception& error) {
          reply.Exception(error.what());
        }
        return {};
      });
    });
  }

  /// f(ImageService&, const SnapshotPointer&, …): runs in the thread of the pictures, with the snapshot of
  /// the moment of the call.
  template <class F>
  void Picture(const char* name, F function, size_t optional = 0) {
    Add<2>(name, optional, internal::Plain(function), [this](const auto& f, auto arguments, const Reply& reply) {
      images_.Post(reply.client(), [f, arguments, reply, snapshot = session_.snapshot()](ImageService& images) mutable {
        if (!reply.wanted()) return;
        std::apply([&](auto&... argument) { Answer(reply, [&] { return f(images, snapshot, argument...); })(); }, arguments);
      });
    });
  }

 private:
  // Calls and keeps the result; the function returned answers with it.
  template <class Call>
  static std::function<void()> Answer(const Reply& reply, const Call& call) {
    using Result = std::invoke_result_t<Call>;
    try {
      if constexpr (std::is_void_v<Result>) {
        call();
        return WithNothing(reply);
      } else {
        return With<Result>(reply, call());
      }
    } catch (const std::exception& error) {
      return WithError(reply, error.what());
    }
  }
  template <class Result>
  static std::function<void()> With(const Reply& reply, Result result) {
    return [reply, result = std::move(result)] { reply.Result(result); };
  }
  static std::function<void()> WithNothing(const Reply& reply);
  static std::function<void()> WithError(const Reply& reply, const char* what);

  template <size_t Skip, class F, class Run>
  void Add(const char* name, size_t optional, F f, Run run) {
    using Arguments = typename internal::TupleTail<Skip, typename internal::Signature<F>::Arguments>::type;
    table_.Add(name, std::tuple_size_v<Arguments>, optional,
               [run, f](const std::vector<WireValue>& values, const Reply& reply) { run(f, MethodTable::Read<F, Skip>(values), reply); });
  }

  Session& session_;
  ImageService& images_;
  const MemoryLoans& loans_;
  MethodTable table_;
};

// Each adds one family of functions; together all of AirSim's, AirSim360's and Cosys-AirSim's, and those
// for people, traffic and missions.
void AddConnectionCalls(Api& api);
void AddVehicleCalls(Api& api);
void AddMoveCalls(Api& api);
void AddImageCalls(Api& api);
void AddCameraCalls(Api& api);
void AddDetectionCalls(Api& api);
void AddSensorCalls(Api& api);
void AddObjectCalls(Api& api);
void AddWorldCalls(Api& api);
void AddWeatherCalls(Api& api);
void AddPeopleCalls(Api& api);
void AddTrafficCalls(Api& api);
void AddMissionCalls(Api& api);
void AddPlotCalls(Api& api);
void AddCosysCalls(Api& api);
void AddUnavailableCalls(Api& api);

}  // namespace airsim360
