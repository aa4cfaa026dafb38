// Any bytes as plain lower-case text.
#pragma once

#include <string>
#include <string_view>

namespace airsim360::internal {

/// Lower case; accents folded away (é to e, ß to ss), typographic signs as their ASCII ones (″ to ", × to x,
/// – to -, µ to u, ， to a comma), fullwidth forms as ASCII; other writing stays as UTF-8; what is neither is a
/// space.
std::string PlainText(std::string_view bytes);

/// The same text with a space for each control character and byte that is no UTF-8: what files may hold.
std::string PrintableText(std::string_view bytes);

/// Length in bytes of the UTF-8 character at the start of valid UTF-8.
size_t CharacterLength(std::string_view text);

}  // namespace airsim360::internal
