// Items before they are chosen and worded: what can be asked or said at one place, each with its one answer and its proof. For the
// .cc files of this folder.
#pragma once

#include <string>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/vln/language/named_place.h"
#include "airsim360/vln/predicates/query_json.h"

namespace airsim360::internal {

struct Draft {
  std::string type;  ///< "nearer"
  /// Drafts of one key have the same texts and the same answers; only which answer is right differs.
  std::string key;
  size_t picture = 0;              ///< 0 panorama, from 1 on cameras, kFlight: the panoramas before and after a flight
  int quarters = 0;                ///< of the panorama: how often its heading is turned to the left by 90 degrees
  std::vector<std::string> texts;  ///< ways to say it
  std::string answer_type;         ///< "yes/no", "number", "direction", "thing", "distance", "box", "caption"
  std::vector<VlnJson> answers;    ///< all that it could be, in a fixed order
  size_t answer = 0;
  std::vector<EntityId> entities;  ///< what it speaks of, in the order of the query
  std::vector<uint16_t> words;     ///< of the lexicon, in the order of the query
  VlnJson query, proof;            ///< query: what check.cc decides again
  VlnJson box = {}, mask = {};     ///< refer: [x, y, width, height] and COCO's run lengths
};

std::vector<Draft> QuestionsAt(const NamedPlace& place, RngStream& random);
std::vector<Draft> QuestionsOfFlight(const NamedPlace& place, RngStream& random);
std::vector<Draft> ExpressionsAt(const NamedPlace& place, RngStream& random);
std::vector<Draft> CaptionsAt(const NamedPlace& place, RngStream& random);

}  // namespace airsim360::internal
