#include "airsim360/vln/report/submission.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/hash.h"
#include "airsim360/base/signature.h"
#include "airsim360/vln/predicates/query_json.h"
#include "airsim360/vln/report/vln_report.h"

namespace airsim360 {
namespace {

using internal::VlnJson;

constexpr const char* kFormat = "airsim360 vln submission 1";
constexpr double kSame = 1e-9;

std::string SealOf(VlnJson json) {
  json.erase("seal");
  json.erase("signature");
  return Sha256Hex(AsBytes(json.dump()));
}

std::string TextOf(const VlnJson& json, const char* name) {
  const auto found = json.find(name);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

// What a result says of itself and what its path says.
void Rescore(const VlnResult& r, std::vector<std::string>& problems) {
  const VlnScore score = ScoreOf(r);
  if (r.success != (score.success > 0))
    problems.push_back(r.id + ": says " + (r.success ? "success" : "failure") + ", its path says otherwise");
  if (std::abs(r.distance - score.error) > 1e-3) problems.push_back(r.id + ": its distance to the goal is not that of its path");
}

void CompareScores(const VlnJson& said, const std::vector<VlnResult>& results, std::vector<std::string>& problems) {
  const VlnJson now = VlnJson::parse(ScoresJson(results));
  for (const auto name : kVlnFigures) {
    const std::string key(name);
    const bool there = said.is_object() && said.contains(key) && said[key].is_number();
    if (!there || !(std::abs(said[key].get<double>() - now[key].get<double>()) <= kSame))
      problems.push_back("score " + key + " is not what the results give");
  }
}

// As the version wrote it that wrote `like`: some kept no log, some no places of the goal.
VlnResult AsOld(VlnResult result, const VlnResult& like) {
  if (like.log.empty()) {
    result.log.clear();
    result.heading_deg.clear();
  }
  if (like.places.empty() && !result.places.empty()) {
    result.places.clear();
    result.oracle_success = ScoreOf(result).oracle > 0;
  }
  return result;
}

}  // namespace

std::string PackSubmission(const std::filesystem::path& episodes, const std::filesystem::path& results,
                           const std::filesystem::path& transcript, const SubmissionFacts& facts) {
  const std::vector<VlnResult> list = ReadResults(results);
  std::map<std::string, bool> known;
  for (const LanguageEpisode& e : ReadEpisodes(episodes)) known[e.id] = true;
  VlnJson lines = VlnJson::array();
  for (const VlnResult& r : list) {
    if (!known.contains(r.id)) throw InputError(results.string() + ": '" + r.id + "' is no episode of " + episodes.string());
    lines.push_back(VlnJson::parse(ResultLine(r)));
  }
  VlnJson json = {{"format", kFormat},
                  {"name", facts.name},
                  {"program", facts.program},
                  {"program_sha256", facts.program_sha256},
                  {"episodes_sha256", Sha256HexOfFile(episodes)},
                  {"episodes", known.size()},
                  {"transcript_sha256", transcript.empty() ? VlnJson(nullptr) : VlnJson(Sha256HexOfFile(transcript))},
                  {"scores", VlnJson::parse(ScoresJson(list))},
                  {"results", lines}};
  if (!facts.key.empty()) json["public_key"] = PublicKeyOf(facts.key);
  json["seal"] = SealOf(json);
  if (!facts.key.empty()) json["signature"] = SignText(facts.key, json["seal"].get<std::string>());
  return json.dump() + "\n";
}

std::vector<std::string> VerifySubmission(
    const std::filesystem::path& submission, const std::filesystem::path& episodes, const std::string& signer,
    const std::function<std::vector<VlnResult>(const std::vector<LanguageEpisode>&, const VlnResult& like)>& fly) {
  const VlnJson json = internal::ParseVlnJson(ReadTextFile(submission, uint64_t{8} << 30), submission.string());
  if (!json.is_object() || TextOf(json, "format") != kFormat || !json.contains("results") || !json["results"].is_array() ||
      json["results"].empty())
    throw InputError(submission.string() + ": is no '" + kFormat + "'");
  std::vector<std::string> problems;
  if (TextOf(json, "seal") != SealOf(json)) problems.push_back("the seal does not fit: the file was changed after it was packed");
  const std::string key = TextOf(json, "public_key");
  if (!key.empty() && !IsSignedBy(key, TextOf(json, "seal"), TextOf(json, "signature")))
    problems.push_back("the signature is not that of its public key");
  if (!signer.empty() && key != signer) problems.push_back("it is signed by " + (key.empty() ? "nobody" : key) + ", not by " + signer);
  if (TextOf(json, "episodes_sha256") != Sha256HexOfFile(episodes)) problems.push_back("the episodes are not those of the submission");
  const std::vector<LanguageEpisode> list = ReadEpisodes(episodes);
  std::map<std::string, const LanguageEpisode*> by_id;
  for (const LanguageEpisode& e : list) by_id[e.id] = &e;
  std::vector<VlnResult> results;
  std::vector<LanguageEpisode> flown;
  for (const VlnJson& line : json["results"]) {
    results.push_back(ParseResultLine(line.dump(), submission.string() + ": results[" + std::to_string(results.size()) + "]"));
    const VlnResult& r = results.back();
    const auto found = by_id.find(r.id);
    if (found == by_id.end()) {
      problems.push_back(r.id + ": is no episode of " + episodes.string());
      continue;
    }
    if (Norm(r.ref.back() - found->second->goal) > 2e-3) problems.push_back(r.id + ": its reference does not end at the episode's goal");
    const LanguageEpisode& e = *found->second;
    const auto is_goal = [&](Vec3d p) {
      const auto is_it = [&](Vec3d place) { return Norm(p - place) <= 2e-3; };
      return is_it(e.goal) || std::ranges::any_of(e.places, is_it);
    };
    if (!is_goal(r.goal.value_or(e.goal)) || !std::ranges::all_of(r.places, is_goal))
      problems.push_back(r.id + ": its goal is none of the episode's");
    Rescore(r, problems);
    flown.push_back(*found->second);
  }
  if (results.size() != list.size())
    problems.push_back(std::to_string(results.size()) + " results of " + std::to_string(list.size()) +
                       " episodes: the scores leave some out");
  CompareScores(json.value("scores", VlnJson()), results, problems);
  if (!fly || !problems.empty()) return problems;
  const std::vector<VlnResult> again = fly(flown, results.front());
  for (size_t i = 0; i < results.size(); ++i)
    if (ResultLine(AsOld(again[i], results[i])) != ResultLine(results[i]))
      problems.push_back(results[i].id + ": flown again it gives another result");
  return problems;
}

}  // namespace airsim360
