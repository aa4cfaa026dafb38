// Any bytes as episodes and results either read and score or throw InputError.
#include "airsim360/eval/files/vln_file.h"

#include <cstddef>
#include <cstdint>

#include "airsim360/base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace airsim360;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const bool lines : {false, true}) {
    // As one file, and as two.
    for (const char* results : {"fuzz", "results"}) {
      try {
        for (const NamedVlnEpisode& one : ParseVlnFiles(text, "fuzz", text, results, lines)) ScoreVln(one.episode, 20);
      } catch (const InputError&) {
      }
    }
  }
  return 0;
}
