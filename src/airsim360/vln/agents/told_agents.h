// Agents outside of the program: a program of the user's, a language model behind HTTP. Whatever they do, an episode goes on or
// ends with an explanation.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>

#include "airsim360/vln/agents/vln_agent.h"

namespace airsim360 {

/// What was asked and answered, a line of JSON each, written at once, so that a run that was cut off asks nobody twice.
/// Thread-safe.
class Transcript {
 public:
  /// Reads what is there; a last line that was cut off is dropped. "" = keep nothing.
  explicit Transcript(std::filesystem::path file);
  /// The recorded line of a key; "" if there is none.
  std::string Find(const std::string& key) const;
  void Add(const std::string& key, const std::string& line);

 private:
  std::filesystem::path file_;
  mutable std::mutex mutex_;
  std::map<std::string, std::string> lines_;
};

struct ExecOptions {
  std::vector<std::string> command = {};  ///< program and arguments
  double seconds = 60;                    ///< for one answer
};
/// Starts the program for each episode; a line of JSON to its standard input for each decision, a line back from its standard
/// output (docs/guide/vln.md). InputError if there is no such program.
std::unique_ptr<VlnAgent> MakeExecAgent(const ExecOptions& options);

struct ChatOptions {
  std::string base_url, model, key;  ///< http(s)://HOST[:PORT]/PATH; key "" = none
  double seconds = 120;              ///< for one answer
  int tries = 4;                     ///< of one request, where the server is busy or the line breaks
  double first_wait = 1;             ///< seconds before the second try, doubled for each further one
  double per_minute = 0;             ///< requests at most; 0 = as fast as they are answered
  int most_tokens = 600;
  double price_in = 0, price_out = 0;  ///< of a million tokens, for the transcript
};
/// AIRSIM360_VLN_BASE_URL, AIRSIM360_VLN_MODEL and AIRSIM360_VLN_KEY (or OPENAI_BASE_URL, OPENAI_MODEL, OPENAI_API_KEY).
/// InputError naming the variable that is missing or wrong.
ChatOptions ChatOptionsFromEnvironment();
/// `transcript` outlives the agent.
std::unique_ptr<VlnAgent> MakeChatAgent(const ChatOptions& options, Transcript& transcript);

}  // namespace airsim360
