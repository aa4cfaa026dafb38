// How deep a JSON text is nested, before anything recurses into it.
#pragma once

#include <string_view>

namespace airsim360 {

/// Most brackets and braces that are open at once, those in strings left out: 0 for a number, 1 for []. Linear in the
/// text, which need not be JSON.
int JsonDepth(std::string_view text);

}  // namespace airsim360
