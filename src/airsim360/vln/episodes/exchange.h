// Episodes in the forms of public benchmarks, there and back.
#pragma once

#include <string>
#include <vector>

#include "airsim360/vln/episodes/language_episode.h"

namespace airsim360 {

/// aerialvln, openfly, citynav, traveluav, uavon.
const std::vector<std::string>& ExchangeFormats();

/// Episodes as JSON of that form. What was imported from the same form keeps the fields that we do not read. InputError naming
/// --format.
std::string ExportEpisodes(const std::vector<LanguageEpisode>& episodes, const std::string& format);

/// Episodes of a text of that form, in `world`, without entities, query or proof: `vln run` flies them, `vln check` says that
/// nothing is proved. InputError "name: …" naming the record and the field.
std::vector<LanguageEpisode> ImportEpisodes(const std::string& text, const std::string& name, const std::string& format,
                                            const std::string& world);

}  // namespace airsim360
