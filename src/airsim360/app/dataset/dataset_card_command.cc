#include "airsim360/app/dataset/dataset_card_command.h"

#include <cstdio>
#include <memory>

#include "airsim360/app/flags/arguments.h"
#include "airsim360/dataset/gallery/gallery.h"

namespace airsim360 {
namespace {

struct CardArguments {
  std::string folder;
  bool html = false;
};

void RunCard(const CardArguments& arguments, bool json) {
  const DatasetCard card = CardOfDataset(arguments.folder);
  std::string page;
  if (arguments.html) page = WriteGallery(arguments.folder).string();
  if (json) {
    auto figures = nlohmann::ordered_json::parse(card.json);
    if (!page.empty()) figures["html"] = page;
    PrintJson(figures);
    return;
  }
  if (page.empty()) {
    std::fputs(card.markdown.c_str(), stdout);
  } else {
    std::printf("%s\n", page.c_str());
  }
}

}  // namespace

void AddDatasetCard(CLI::App& dataset, GlobalOptions& globals) {
  CLI::App* command = dataset.add_subcommand("card", "what a dataset holds: counts by scene, environment, height, range and category");
  auto arguments = std::make_shared<CardArguments>();
  command->add_option("DIR", arguments->folder, "folder of the dataset")->required();
  command->add_flag("--html", arguments->html, "write index.html, a page of all products of all frames that opens without a server");
  command->callback([arguments, &globals] { RunCard(*arguments, globals.json); });
}

}  // namespace airsim360
