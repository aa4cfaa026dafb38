#include "airsim360/rpc/wire/wire_convert.h"

namespace airsim360 {
namespace {

using Kind = WireValue::Kind;

// A value in a message: numbers as they are, of other kinds the kind.
std::string Shown(const WireValue& value) {
  char text[40];
  switch (value.kind) {
    case Kind::kNil:
      return "nil";
    case Kind::kBool:
      return value.flag ? "true" : "false";
    case Kind::kInt:
      return std::to_string(value.integer);
    case Kind::kUint:
      return std::to_string(value.natural);
    case Kind::kFloat:
      std::snprintf(text, sizeof text, "%g", value.real);
      return text;
    case Kind::kString:
      return "a text";
    case Kind::kBinary:
      return "a binary";
    case Kind::kArray:
      return "a list";
    case Kind::kMap:
      return "a map";
    case Kind::kExtension:
      break;
  }
  return "an extension";
}

}  // namespace

void BadArgument::Within(const std::string& part) {
  const bool separate = !part_.empty() && part_[0] != '[';
  part_ = part + (separate ? "." : "") + part_;
  Write();
}

void BadArgument::InArgument(size_t number) {
  argument_ = "argument " + std::to_string(number);
  Write();
}

void BadArgument::Write() {
  text_ = reason_ == Reason::kKind ? "std::bad_cast. " : "";
  if (!part_.empty()) text_ += part_ + (argument_.empty() ? "" : " of ");
  text_ += argument_;
  text_ += (part_.empty() && argument_.empty() ? "" : ": ") + problem_;
}

void ThrowWrongKind(const WireValue& value, const char* wanted) {
  throw BadArgument(BadArgument::Reason::kKind, Shown(value) + " is not " + wanted);
}

void ThrowOutOfRange(const WireValue& value, int64_t low, uint64_t high) {
  throw BadArgument(BadArgument::Reason::kKind, Shown(value) + " is not in " + std::to_string(low) + " … " + std::to_string(high));
}

bool IsNanOnWire(const WireValue& value) { return value.kind == Kind::kFloat && std::isnan(value.real); }

double RealFromWire(const WireValue& value, double limit) {
  double real = value.real;
  if (value.kind == Kind::kInt) {
    real = static_cast<double>(value.integer);
  } else if (value.kind == Kind::kUint) {
    real = static_cast<double>(value.natural);
  } else if (value.kind != Kind::kFloat) {
    ThrowWrongKind(value, "a number");
  }
  if (std::isnan(real)) throw BadArgument(BadArgument::Reason::kRange, "nan is not a number");
  if (std::abs(real) > limit) throw BadArgument(BadArgument::Reason::kRange, BeyondLimitText(real, limit));
  return real;
}

}  // namespace airsim360
