// A language model behind a server of the chat-completions kind.
#include <chrono>
#include <cstdlib>
#include <thread>

#include "airsim360/base/base64.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/hash.h"
#include "airsim360/http/http_client.h"
#include "airsim360/vln/agents/observation.h"
#include "airsim360/vln/agents/told_agents.h"

namespace airsim360 {
namespace {

using internal::Tame;
using internal::VlnJson;

constexpr size_t kMostBody = size_t{4} << 20;
constexpr size_t kLongestQuoted = 200;
constexpr int kMostInARow = 3;  // decisions without an answer after which it gives up
constexpr int kAttempts = 2;    // answers asked for in one decision: the second quotes what was wrong with the first

std::string Sha(std::string_view text) { return Sha256Hex(AsBytes(text)); }

// One exchange, as the transcript holds it.
struct Exchange {
  std::string text;   // of the model
  std::string fault;  // of the server; "" = none
  int64_t tokens_in = 0, tokens_out = 0;
  double seconds = 0;
};

int64_t CountOf(const VlnJson& usage, const char* name) {
  const auto found = usage.is_object() ? usage.find(name) : usage.end();
  return usage.is_object() && found != usage.end() && found->is_number_unsigned()
             ? std::min<int64_t>(found->get<uint64_t>() & INT64_MAX, 1'000'000'000)
             : 0;
}

// choices[0].message.content of whatever came.
void ReadBody(const std::string& body, Exchange& exchange) {
  VlnJson json;
  try {
    json = internal::ParseVlnJson(body, "server");
  } catch (const InputError&) {
    exchange.fault = "the server's answer is not JSON: '" + Tame(body, kLongestQuoted) + "'";
    return;
  }
  const VlnJson* at = &json;
  const auto go = [&](const char* name) { at = at != nullptr && at->is_object() && at->contains(name) ? &at->at(name) : nullptr; };
  go("choices");
  at = at != nullptr && at->is_array() && !at->empty() ? &at->at(0) : nullptr;
  go("message");
  go("content");
  if (at == nullptr || !at->is_string()) {
    exchange.fault = "the server's answer has no text choices[0].message.content: '" + Tame(body, kLongestQuoted) + "'";
    return;
  }
  exchange.text = at->get<std::string>();
  const VlnJson usage = json.value("usage", VlnJson::object());
  exchange.tokens_in = CountOf(usage, "prompt_tokens");
  exchange.tokens_out = CountOf(usage, "completion_tokens");
}

class ChatAgent : public VlnAgent {
 public:
  ChatAgent(const ChatOptions& options, Transcript& transcript) : options_(options), transcript_(transcript) {}

  Decision Decide(VlnSituation& s) override {
    Decision decision;
    std::string complaint;
    const auto pictures = s.eyes.Pictures(s.flight.vehicle().motion.X_WB, s.episode.weather, s.moved());
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const Exchange exchange = Ask(s, pictures, attempt, complaint);
      if (!exchange.fault.empty()) {
        decision.faults.push_back(exchange.fault);
        break;  // the request was tried often enough
      }
      try {
        decision.said = exchange.text;
        decision.answer = ParseAnswer(exchange.text, s.decisions);
        in_a_row_ = 0;
        return decision;
      } catch (const InputError& error) {
        complaint = error.what();
        decision.faults.push_back(Tame(complaint, kLongestQuoted) + " in '" + Tame(exchange.text, kLongestQuoted) + "'");
      }
    }
    // Without an answer the drone stays where it is.
    decision.answer = {PresetAction{Preset::kHover}};
    decision.give_up = ++in_a_row_ >= kMostInARow;
    return decision;
  }

 private:
  std::string Body(const VlnSituation& s, const std::vector<VlnPicture>& pictures, const std::string& complaint) const {
    const std::string rules =
        "You fly a drone. You get an instruction and what the drone sees now, and answer with one JSON object and nothing else: " +
        AnswerGrammar(s.decisions) + " You may add \"reason\", a short text." +
        (s.eyes.view() == VlnView::kErp
             ? " The picture is a level panorama of all directions: its middle is ahead; yellow numbers are azimuths in degrees."
             : "");
    VlnJson content = VlnJson::array();
    std::string names;
    for (const VlnPicture& picture : pictures) {
      names += (names.empty() ? "" : ", ") + picture.name;
      content.push_back({{"type", "image_url"}, {"image_url", {{"url", "data:image/jpeg;base64," + Base64(picture.jpeg)}}}});
    }
    VlnJson told = internal::ObservationJson(s);
    told.erase("answer");
    std::string text = "Pictures: " + names + ". " + told.dump(-1, ' ', true);
    if (!complaint.empty())
      text += " Your last answer could not be read: " + Tame(complaint, kLongestQuoted) + ". Answer again, with one JSON object alone.";
    content.insert(content.begin(), VlnJson{{"type", "text"}, {"text", text}});
    VlnJson body = {{"messages", {{{"role", "system"}, {"content", rules}}, {{"role", "user"}, {"content", content}}}},
                    {"temperature", 0},
                    {"max_tokens", options_.most_tokens},
                    {"stream", false}};
    if (!options_.model.empty()) body["model"] = options_.model;
    return body.dump(-1, ' ', true, VlnJson::error_handler_t::replace);
  }

  Exchange Ask(const VlnSituation& s, const std::vector<VlnPicture>& pictures, int attempt, const std::string& complaint) {
    const std::string body = Body(s, pictures, complaint), sha = Sha(body);
    const std::string key = s.episode.id + "#" + std::to_string(s.step) + "#" + std::to_string(attempt);
    if (const std::string line = transcript_.Find(key); !line.empty()) {
      const VlnJson json = VlnJson::parse(line);
      if (json.value("request", "") == sha)
        return {json.value("answer", ""), json.value("fault", ""), json.value("tokens_in", int64_t{0}),
                json.value("tokens_out", int64_t{0})};
    }
    const Exchange exchange = Send(body);
    VlnJson hashes = VlnJson::array();
    for (const VlnPicture& picture : pictures) hashes.push_back(Sha(picture.jpeg));
    const double cost = 1e-6 * (static_cast<double>(exchange.tokens_in) * options_.price_in +
                                static_cast<double>(exchange.tokens_out) * options_.price_out);
    transcript_.Add(key, VlnJson{{"key", key},
                                 {"episode", s.episode.id},
                                 {"step", s.step},
                                 {"attempt", attempt},
                                 {"model", options_.model},
                                 {"request", sha},
                                 {"pictures", hashes},
                                 {"answer", exchange.text},
                                 {"fault", exchange.fault},
                                 {"tokens_in", exchange.tokens_in},
                                 {"tokens_out", exchange.tokens_out},
                                 {"seconds", exchange.seconds},
                                 {"cost", cost}}
                             .dump(-1, ' ', true, VlnJson::error_handler_t::replace));
    return exchange;
  }

  // A request with its tries again.
  Exchange Send(const std::string& body) const {
    Exchange exchange;
    double wait = options_.first_wait;
    for (int attempt = 1;; ++attempt) {
      Pace();
      const HttpAnswer answer = PostJson(options_.base_url, options_.key, body, options_.seconds, kMostBody);
      exchange.seconds += answer.seconds;
      if (answer.fault.empty()) {
        ReadBody(answer.body, exchange);
        return exchange;
      }
      if (!answer.again || attempt >= options_.tries) {
        exchange.fault = answer.fault + (attempt > 1 ? ", " + std::to_string(attempt) + " times" : "");
        return exchange;
      }
      std::this_thread::sleep_for(std::chrono::duration<double>(wait));
      wait = std::min(wait * 2, 60.0);
    }
  }

  // Not more requests than the rate allows, of all agents together.
  void Pace() const {
    if (options_.per_minute <= 0) return;
    static std::mutex mutex;
    static std::chrono::steady_clock::time_point next;
    const std::lock_guard lock(mutex);
    std::this_thread::sleep_until(next);
    next = std::chrono::steady_clock::now() +
           std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(60 / options_.per_minute));
  }

  ChatOptions options_;
  Transcript& transcript_;
  int in_a_row_ = 0;
};

std::string Variable(const char* own, const char* usual) {
  for (const char* name : {own, usual})
    if (const char* value = std::getenv(name); value != nullptr && *value != 0) return value;
  return "";
}

}  // namespace

ChatOptions ChatOptionsFromEnvironment() {
  ChatOptions options;
  options.base_url = Variable("AIRSIM360_VLN_BASE_URL", "OPENAI_BASE_URL");
  options.model = Variable("AIRSIM360_VLN_MODEL", "OPENAI_MODEL");
  options.key = Variable("AIRSIM360_VLN_KEY", "OPENAI_API_KEY");
  if (options.base_url.empty())
    throw InputError("--agent openai: the environment variable AIRSIM360_VLN_BASE_URL is missing, for example http://127.0.0.1:8000/v1");
  const auto plain = [](const std::string& text) { return std::ranges::all_of(text, [](unsigned char c) { return c > ' ' && c < 127; }); };
  std::string& url = options.base_url;
  if (!(url.starts_with("http://") || url.starts_with("https://")) || !plain(url) || url.size() > 2000 ||
      url.find('@') != std::string::npos)
    throw InputError("AIRSIM360_VLN_BASE_URL: '" + Tame(url, 100) + "' is not http://HOST[:PORT]/PATH or https://…");
  if (!plain(options.key)) throw InputError("AIRSIM360_VLN_KEY: holds characters that no key has");
  while (url.ends_with('/')) url.pop_back();
  if (!url.ends_with("/chat/completions")) url += "/chat/completions";
  return options;
}

std::unique_ptr<VlnAgent> MakeChatAgent(const ChatOptions& options, Transcript& transcript) {
  return std::make_unique<ChatAgent>(options, transcript);
}

}  // namespace airsim360
