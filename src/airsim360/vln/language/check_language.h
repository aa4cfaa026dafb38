// The second method: what items of language data say, answered again from rays of its own and from triangles.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/stage/stage.h"

namespace airsim360 {

struct LanguageComplaint {
  std::string id, what;
};

struct LanguageCheck {
  int64_t items = 0;
  std::vector<LanguageComplaint> complaints;
};

/// Looks at every picture again with rays between the centres of its pixels, measures things by their triangles, and lists all
/// answers of each item: exactly the one that it gives must hold. Shares nothing with what makes items but the reading of
/// words. `open`: a world and its seed; asked for one after another.
LanguageCheck CheckLanguage(const std::filesystem::path& items,
                            const std::function<std::shared_ptr<Stage>(const std::string& world, uint64_t seed)>& open);

}  // namespace airsim360
