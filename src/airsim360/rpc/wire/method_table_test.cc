#include "airsim360/rpc/wire/method_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/rpc/wire/airsim_image_types.h"

namespace airsim360 {
namespace {

// Calls with the arguments that `write` makes; returns the whole answer.
class Caller {
 public:
  std::string answer;
  int answers = 0;

  template <class Write>
  WireValue Call(const MethodTable& table, const char* method, size_t count, const Write& write) {
    WireWriter writer;
    writer.ArrayHeader(4);
    writer.Int(0), writer.Int(7), writer.String(method), writer.ArrayHeader(count);
    write(writer);
    request_ = writer.bytes();
    const WireValue value = Decoded(request_);
    const RpcMessage message = ParseMessage(value);
    {
      const Reply reply(
          message.id, method, count,
          [this](WireBlocks blocks) {
            answer.clear();
            for (const WireBlock& block : blocks) answer += block.view();
            ++answers;
          },
          [] { return true; });
      table.Call(message, reply);
    }
    return Decoded(answer);
  }
  static WireValue Decoded(const std::string& bytes) { return DecodeWire({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}); }

 private:
  std::string request_;
};

MethodTable SumTable() {
  MethodTable table;
  const auto add = [](int, double a, const airsim::Vector3r& b, bool more) { return a + b.x_val + more; };
  using F = decltype(add);
  table.Add("add", 3, 1, [add](const std::vector<WireValue>& values, const Reply& reply) {
    auto arguments = MethodTable::Read<F, 1>(values);
    reply.Result(std::apply([&](auto&... a) { return add(0, a...); }, arguments));
  });
  return table;
}

TEST(MethodTable, CallsWithAllOrWithoutOptionalArguments) {
  const MethodTable table = SumTable();
  Caller caller;
  WireValue answer =
      caller.Call(table, "add", 3, [](WireWriter& w) { w.Double(1.5), w.MapHeader(1), w.String("x_val"), w.Int(2), w.Bool(true); });
  EXPECT_EQ(answer.items[1].integer, 7);
  EXPECT_EQ(answer.items[2].kind, WireValue::Kind::kNil);
  EXPECT_EQ(answer.items[3].real, 4.5);
  answer = caller.Call(table, "add", 2, [](WireWriter& w) { w.Int(1), w.MapHeader(0); });
  EXPECT_EQ(answer.items[3].real, 1);
}

TEST(MethodTable, ErrorsAreThoseOfRpclib) {
  const MethodTable table = SumTable();
  Caller caller;
  const auto error = [&](const char* method, size_t count, const auto& write) {
    return std::string(caller.Call(table, method, count, write).items[2].text);
  };
  EXPECT_EQ(error("sub", 0, [](WireWriter&) {}), "rpclib: server could not find function 'sub' with argument count 0.");
  EXPECT_EQ(error("add", 1, [](WireWriter& w) { w.Int(1); }),
            "rpclib: Function 'add' was called with an invalid number of arguments. Expected: 3, got: 1");
  EXPECT_EQ(error("add", 2, [](WireWriter& w) { w.String("1"), w.MapHeader(0); }),
            "rpclib: function 'add' (called with 2 arg(s)) threw an exception. The exception contained this "
            "information: "
            "std::bad_cast. argument 1: a text is not a number.");
  EXPECT_NE(error("add", 2, [](WireWriter& w) { w.Double(std::nan("")), w.MapHeader(0); }).find("nan"), std::string::npos);
}

TEST(Reply, IsGivenOnceAndNeverForgotten) {
  std::vector<std::string> answers;
  const auto sink = [&](WireBlocks blocks) {
    answers.emplace_back();
    for (const WireBlock& block : blocks) answers.back() += block.view();
  };
  {
    const Reply reply(3, "f", 0, sink, [] { return true; });
    const Reply copy = reply;
    reply.Result(true);
    copy.Result(false);
    copy.Error("late");
  }
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_TRUE(Caller::Decoded(answers[0]).items[3].flag);
  {
    const Reply forgotten(4, "f", 0, sink, [] { return true; });
  }
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_FALSE(Caller::Decoded(answers[1]).items[2].text.empty());
  {
    const Reply notification(std::nullopt, "f", 0, sink, [] { return true; });
  }
  ASSERT_EQ(answers.size(), 3u);
  EXPECT_TRUE(answers[2].empty());
}

}  // namespace
}  // namespace airsim360
