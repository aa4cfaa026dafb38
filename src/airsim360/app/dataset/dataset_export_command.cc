#include "airsim360/app/dataset/dataset_export_command.h"

#include <cstdio>
#include <memory>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/base/error.h"
#include "airsim360/dataset/export/export.h"

namespace airsim360 {
namespace {

struct ExportArguments {
  std::string folder, format, out;
  double shard_mb = 1000;
  ExportOptions options;
};

std::string FormatHelp() {
  std::string names;
  for (const ExportFormatInfo& format : ExportFormats()) names += (names.empty() ? "" : ", ") + std::string(format.name);
  return names;
}

void RunExport(ExportArguments arguments, bool json) {
  if (!(arguments.shard_mb > 0 && arguments.shard_mb <= 1e9))
    throw InputError("--shard-mb: " + std::to_string(arguments.shard_mb) + " is not in 0 … 10^9");
  if (arguments.options.points < 0 || arguments.options.points > 100'000'000)
    throw InputError("--points: " + std::to_string(arguments.options.points) + " is not in 0 … 100000000");
  arguments.options.shard_bytes = static_cast<int64_t>(arguments.shard_mb * 1e6);
  const ExportResult result = ExportDataset(arguments.folder, arguments.format, arguments.out, arguments.options);
  const auto notes = nlohmann::ordered_json::parse(result.notes);
  if (json) {
    PrintJson({{"out", arguments.out},
               {"format", arguments.format},
               {"frames", result.frames},
               {"files", result.files},
               {"bytes", result.bytes},
               {"notes", notes}});
    return;
  }
  std::printf("%s: %lld frames as %s, %lld files, %.1f MB\n", arguments.out.c_str(), static_cast<long long>(result.frames),
              arguments.format.c_str(), static_cast<long long>(result.files), static_cast<double>(result.bytes) / 1e6);
  for (const auto& [key, value] : notes.items()) std::printf("  %s: %s\n", key.c_str(), value.dump().c_str());
}

}  // namespace

void AddDatasetExport(CLI::App& dataset, GlobalOptions& globals) {
  CLI::App* command = dataset.add_subcommand("export", "a finished dataset in a format that other tools read; the dataset is not changed");
  auto arguments = std::make_shared<ExportArguments>();
  command->add_option("DIR", arguments->folder, "folder of the dataset")->required();
  command->add_option("--format", arguments->format, FormatHelp())->required();
  command->add_option("--out", arguments->out, "new folder, beside the dataset")->required();
  command->add_option("--shard-mb", arguments->shard_mb, "webdataset: size of a tar file at most, 10^6 bytes (default 1000)");
  command->add_option("--points", arguments->options.points, "colmap, nerfstudio: 3-D points at most (default 200000)");
  command->callback([arguments, &globals] { RunExport(*arguments, globals.json); });
}

}  // namespace airsim360
