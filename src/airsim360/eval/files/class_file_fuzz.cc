// Any bytes as classes, corners of rooms or persons either read or throw InputError.
#include "airsim360/eval/files/class_file.h"

#include <cstddef>
#include <cstdint>

#include "airsim360/base/error.h"
#include "airsim360/eval/files/layout_file.h"
#include "airsim360/eval/files/person_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const bool json : {false, true}) {
    try {
      ParseClassFile(text, "fuzz", json);
    } catch (const InputError&) {
    }
    try {
      const RoomLayout room = ParseLayoutFile(text, "fuzz", json, 32, 16);
      MeasureLayout(room, room, 32, 16);
    } catch (const InputError&) {
    }
    try {
      ParsePersonFiles(text, text, json);
    } catch (const InputError&) {
    }
  }
  return 0;
}
