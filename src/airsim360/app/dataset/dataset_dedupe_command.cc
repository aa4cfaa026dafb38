#include "airsim360/app/dataset/dataset_dedupe_command.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/base/error.h"
#include "airsim360/dataset/dedupe/dedupe.h"

namespace airsim360 {
namespace {

struct DedupeArguments {
  std::string folder, methods = "parallax,hash", model;
  DedupeOptions options;
};

void RunDedupe(DedupeArguments arguments, const CLI::App& command, bool json) {
  arguments.options.methods = ParseList("--method", arguments.methods, {std::begin(kDedupeMethods), std::end(kDedupeMethods)});
  for (const char* flag : {"--model", "--similarity"}) {
    if (command.count(flag) > 0 && std::ranges::count(arguments.options.methods, "sscd") == 0)
      throw InputError(std::string(flag) + ": it is for --method sscd");
  }
  arguments.options.model = arguments.model;
  const DedupeResult result = DedupeDataset(arguments.folder, arguments.options);
  std::map<std::string, int64_t> reasons;
  for (const DroppedFrame& frame : result.dropped) ++reasons[frame.reason];
  if (json) {
    PrintJson({{"kept", result.kept.size()},
               {"dropped", result.dropped.size()},
               {"reasons", reasons},
               {"pictures_compared", result.hashed},
               {"parallax_bins", kParallaxBins},
               {"parallax_histogram", result.histogram},
               {"applied", arguments.options.apply}});
    return;
  }
  std::printf("%s: %zu frames kept, %zu dropped%s\n", arguments.folder.c_str(), result.kept.size(), result.dropped.size(),
              arguments.options.apply ? " and removed" : " (kept.txt, dropped.csv; --apply removes them)");
  for (const auto& [reason, count] : reasons) std::printf("  %s: %lld\n", reason.c_str(), static_cast<long long>(count));
}

}  // namespace

void AddDatasetDedupe(CLI::App& dataset, GlobalOptions& globals) {
  CLI::App* command = dataset.add_subcommand("dedupe", "frames that show what an earlier one shows: kept.txt, dropped.csv");
  auto arguments = std::make_shared<DedupeArguments>();
  command->add_option("DIR", arguments->folder, "folder of the dataset")->required();
  command->add_option("--method", arguments->methods, "of parallax, hash, sscd (default parallax,hash)");
  command->add_option("--parallax", arguments->options.parallax, "rad: baseline / median range of twins is below (default 0.02)");
  command->add_option("--bits", arguments->options.bits, "of 256: hashes of twins differ in no more (default 31)");
  command->add_option("--model", arguments->model, "ONNX file of the network of --method sscd");
  command->add_option("--similarity", arguments->options.similarity,
                      "of --method sscd: cosine of descriptors of twins is at least (default 0.75)");
  command->add_flag("--apply", arguments->options.apply, "take the dropped frames out of the dataset");
  command->callback([arguments, command, &globals] { RunDedupe(*arguments, *command, globals.json); });
}

}  // namespace airsim360
