// An item of language data as its line holds it. For the .cc files of this module.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "airsim360/vln/language/make_language.h"
#include "airsim360/vln/predicates/query_json.h"

namespace airsim360::internal {

struct LanguageItem {
  std::string id, kind, type, world, split, text, answer_type;
  uint64_t world_seed = 0;
  std::vector<LanguagePicture> pictures;
  VlnJson answer, choices;
  size_t answer_index = 0;
  std::vector<EntityId> entities;
  std::string mask = {};  ///< refer: COCO's run lengths
  VlnJson query, nouns;
};

/// InputError "FILE:LINE.field: …" for what is missing, of the wrong kind or too large.
LanguageItem ParseLanguageItem(const std::string& line, const std::string& where);
/// One item after another, so that a file may be larger than memory. InputError for a file that holds none, or an id twice.
void ReadLanguageItems(const std::filesystem::path& file, const std::function<void(LanguageItem item)>& take);

}  // namespace airsim360::internal
