// airsim360 verify DIR: re-hashes a dataset and compares its labels.
#include <cstdio>
#include <memory>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/app/flags/commands.h"
#include "airsim360/base/error.h"
#include "airsim360/dataset/verify.h"

namespace airsim360 {
namespace {

void Print(const VerifyResult& result, bool json) {
  nlohmann::ordered_json findings = nlohmann::ordered_json::array();
  for (const Finding& finding : result.findings) {
    const char* kind = kFindingNames[static_cast<int>(finding.kind)];
    findings.push_back({{"kind", kind}, {"path", finding.path}, {"detail", finding.detail}});
    if (!json) std::printf("%-8s %s: %s\n", kind, finding.path.c_str(), finding.detail.c_str());
  }
  if (json) {
    PrintJson({{"complete", result.complete},
               {"files", result.files},
               {"frames", result.frames},
               {"damages", result.Damages()},
               {"findings", findings}});
  } else if (result.Damages() == 0) {
    std::printf("%lld files of %lld frames are as they were written\n", static_cast<long long>(result.files),
                static_cast<long long>(result.frames));
  }
}

void RunVerify(const std::string& folder, bool json) {
  const VerifyResult result = VerifyDataset(folder);
  Print(result, json);
  if (!result.complete) throw RuntimeError(folder + ": incomplete; run the same collect again to finish it");
  if (result.Damages() > 0) {
    throw RuntimeError(folder + ": " + std::to_string(result.Damages()) +
                       " findings; delete the files named and run the same collect again to restore them");
  }
}

}  // namespace

void AddVerifyCommand(CLI::App& app, GlobalOptions& globals) {
  CLI::App* command =
      app.add_subcommand("verify", "re-hash a dataset: every damaged, missing or extra file; exit status 1 if any is damaged or missing");
  auto folder = std::make_shared<std::string>();
  command->add_option("DIR", *folder, "folder of the dataset")->required();
  command->callback([folder, &globals] { RunVerify(*folder, globals.json); });
}

}  // namespace airsim360
