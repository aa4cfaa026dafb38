// Items of language data in the files of public data sets.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace airsim360 {

inline constexpr const char* kLanguageLayouts[] = {"vqa", "refcoco", "llava"};

/// vqa: STEM_questions.json and STEM_annotations.json as of VQA v2 (Goyal et al. 2017), multiple choice. refcoco:
/// STEM_instances.json as of COCO and STEM_refs.p, a Python pickle of refs as of REFER (Yu et al. 2016). llava: STEM_llava.json, a
/// list of conversations (Liu et al. 2023). Returns the files. InputError for a layout that there is not, or that does not hold
/// the kind of the items.
std::vector<std::filesystem::path> WriteLanguageLayout(const std::filesystem::path& items, const std::string& layout,
                                                       const std::filesystem::path& stem);
/// Whether a layout holds a kind; InputError naming --layout otherwise.
void CheckLanguageLayout(const std::string& layout, const std::string& kind);

}  // namespace airsim360
