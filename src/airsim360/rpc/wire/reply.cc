#include "airsim360/rpc/wire/reply.h"

#include <atomic>

namespace airsim360 {
namespace {

// The answer to a call that has failed; notifications get none.
WireBlocks Failure(std::optional<uint32_t> id, std::string_view text) {
  WireBlocks blocks;
  if (id) blocks.emplace_back(ErrorAnswer(*id, text));
  return blocks;
}

}  // namespace

struct Reply::State {
  std::optional<uint32_t> id;
  std::string method;
  size_t argument_count;
  AnswerSink sink;
  std::function<bool()> alive;
  uint64_t client = 0;
  std::atomic<bool> answered{false};

  ~State() {
    if (!answered) sink(Failure(id, "rpclib: the server is going down"));
  }
};

Reply::Reply(std::optional<uint32_t> id, std::string method, size_t argument_count, AnswerSink sink, std::function<bool()> alive,
             uint64_t client)
    : state_(new State{id, std::move(method), argument_count, std::move(sink), std::move(alive), client}) {}

bool Reply::Begin(WireWriter& writer) const {
  if (state_->answered.exchange(true)) return false;
  if (state_->id) {
    BeginAnswer(*state_->id, writer);
    return true;
  }
  state_->sink({});
  return false;
}

void Reply::Send(WireBlocks bytes) const { state_->sink(std::move(bytes)); }

void Reply::Nil() const {
  WireWriter writer;
  if (!Begin(writer)) return;
  writer.Nil();
  Send(writer.Take());
}

void Reply::Error(std::string_view text) const {
  if (state_->answered.exchange(true)) return;
  state_->sink(Failure(state_->id, text));
}

void Reply::Exception(std::string_view what) const {
  Error("rpclib: function '" + state_->method + "' (called with " + std::to_string(state_->argument_count) +
        " arg(s)) threw an exception. The exception contained this information: " + std::string(what) + ".");
}

bool Reply::wanted() const { return !state_->answered && state_->alive(); }
const std::string& Reply::method() const { return state_->method; }
uint64_t Reply::client() const { return state_->client; }

}  // namespace airsim360
