// A run packed so that anybody can check it: what was flown, on which episodes, with which program, and what it scored.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "airsim360/vln/flights/run_episodes.h"

namespace airsim360 {

struct SubmissionFacts {
  std::string name;     ///< of the entry, for people
  std::string program;  ///< version
  std::string program_sha256;
  std::string key = {};  ///< PEM (base/signature.h): signed with it; "" = sealed alone
};

/// One JSON text: facts, SHA-256 of the episodes and of the transcript, scores, every result, and a SHA-256 over all of that.
/// InputError where the results are not of these episodes. `transcript` "" = none.
std::string PackSubmission(const std::filesystem::path& episodes, const std::filesystem::path& results,
                           const std::filesystem::path& transcript, const SubmissionFacts& facts);

/// What does not hold: the seal, the signature where there is one, that it is the one of `signer` (a public key, "" = anybody), the hash of the episodes, a result without its episode, a score that the flown paths do not give.
/// Empty: all is well. With `fly`, the flights are flown again (agents of the program alone) and compared byte for byte.
std::vector<std::string> VerifySubmission(
    const std::filesystem::path& submission, const std::filesystem::path& episodes, const std::string& signer,
    const std::function<std::vector<VlnResult>(const std::vector<LanguageEpisode>&, const VlnResult& like)>& fly = {});

}  // namespace airsim360
