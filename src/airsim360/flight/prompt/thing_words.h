// Words outside the lexicon, by what they can be beside a mass: a thing that is carried, the drone itself, neither.
#pragma once

#include <string_view>

namespace airsim360::internal {

/// Whether an unknown word can name a thing: no pronoun, adverb, adjective or verb of speech, no maker of drones,
/// no material and no word for the drone itself. Nouns are an open class, all these are closed enough to list.
bool CanBeThing(std::string_view word);

/// "rx1", "d850": a name of letters and figures.
bool IsProductCode(std::string_view word);

/// "build", "bird", "beast"; "scale", "budget": said of the drone itself or of its figures.
bool MeansDrone(std::string_view word);

/// "esc", "avionics", "wiring": built into every drone.
bool IsPartWord(std::string_view word);

/// "kit", "unit", "system": of the drone where they stand alone, of a thing after its name: "defibrillator kit".
bool NamesWhole(std::string_view word);

/// "carry", "hauling", "tragt", "deliver": what follows is a thing.
bool IsCarryVerb(std::string_view word);

/// "a", "my", "one", "einen": a thing follows.
bool IsArticle(std::string_view word);

/// "with", "plus", "for", "und": joins a thing to the drone or to another thing.
bool JoinsThing(std::string_view word);

}  // namespace airsim360::internal
