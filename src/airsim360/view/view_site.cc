#include "airsim360/view/view_site.h"

#include <charconv>
#include <nlohmann/json.hpp>
#include <random>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/log.h"
#include "airsim360/view/folder_file.h"
#include "airsim360/view/page_files.h"

namespace airsim360 {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr std::string_view kData = "data/";
constexpr size_t kProgressEvery = 2000;  // files between lines of progress

HttpResponse NotFound() { return {.status = 404, .body = R"({"error":{"message":"there is nothing here"}})"}; }

HttpResponse JsonAnswer(std::string text) { return {.body = std::move(text)}; }

// A new or empty folder.
void CheckNew(const fs::path& folder) {
  if (fs::exists(folder) && !(fs::is_directory(folder) && fs::is_empty(folder)))
    throw InputError("--export: '" + folder.string() + "' exists already; give a new folder");
}

void WriteDataset(const ViewedDataset& data, const fs::path& folder) {
  for (const std::string& made : data.MadeFiles()) {
    fs::create_directories((folder / made).parent_path());
    WriteFileAtomically(folder / made, *data.Made(made));
  }
  const std::vector<std::string> files = data.Files();
  for (size_t i = 0; i < files.size(); ++i) {
    fs::create_directories((folder / files[i]).parent_path());
    if (!fs::is_regular_file(data.folder() / files[i]))
      throw RuntimeError((data.folder() / files[i]).string() + ": missing; 'airsim360 verify' tells what else is");
    fs::copy_file(data.folder() / files[i], folder / files[i], fs::copy_options::overwrite_existing);
    if ((i + 1) % kProgressEvery == 0) LogInfo("view: " + std::to_string(i + 1) + " of " + std::to_string(files.size()) + " files copied");
  }
}

}  // namespace

ViewSite::ViewSite(std::vector<std::shared_ptr<ViewedDataset>> datasets, std::shared_ptr<LiveSource> live, std::string token)
    : datasets_(std::move(datasets)), live_(std::move(live)), token_(std::move(token)) {}

HttpResponse ViewSite::Answer(const HttpRequest& request) const {
  if (request.method != "GET")
    return {.status = 405, .body = R"({"error":{"message":"this page is read with GET"}})", .allow = "GET, HEAD"};
  const std::string path = PercentDecoded(std::string_view(request.target).substr(0, request.target.find('?')));
  if (!path.starts_with('/')) return NotFound();
  try {
    return Find(std::string_view(path).substr(1));
  } catch (const std::exception& error) {
    return {.status = 500, .body = Json{{"error", {{"message", error.what()}}}}.dump()};
  }
}

HttpResponse ViewSite::Find(std::string_view path) const {
  if (path.empty()) path = "index.html";
  if (path == "session.json") return JsonAnswer(Session());
  if (path == "entities.json" && live_) return JsonAnswer(live_->EntitiesJson());
  if (path.starts_with(kData)) return Data(path.substr(kData.size()));
  const PageFile* file = FindPageFile(path);
  if (!file) return NotFound();
  return {.content_type = std::string(ContentType(path)), .body = std::string(file->text)};
}

HttpResponse ViewSite::Data(std::string_view path) const {
  if (drawn_ && path.starts_with("0/")) {
    path.remove_prefix(2);
    auto made = drawn_->Made(path);
    if (!made) return NotFound();
    return {.content_type = path.ends_with(".json") ? "application/json" : "application/octet-stream", .body = std::move(*made)};
  }
  size_t number = 0;
  const auto [end, error] = std::from_chars(path.data(), path.data() + path.size(), number);
  const size_t digits = static_cast<size_t>(end - path.data());
  if (error != std::errc() || number >= datasets_.size() || path.substr(digits, 1) != "/") return NotFound();
  path.remove_prefix(digits + 1);
  const ViewedDataset& data = *datasets_[number];
  if (auto made = data.Made(path)) return JsonAnswer(std::move(*made));
  const int file = OpenInFolder(data.folder(), path);
  if (file < 0) return NotFound();
  return {.content_type = std::string(ContentType(path)), .file = file};
}

std::string ViewSite::Session() const {
  Json session{{"datasets", Json::array()}, {"live", nullptr}};
  for (size_t i = 0; i < datasets_.size(); ++i) session["datasets"].push_back(std::string(kData) + std::to_string(i) + "/");
  if (drawn_) session["datasets"].push_back(std::string(kData) + "0/");
  if (live_) {
    session["live"] = Json::parse(live_->DescriptionJson());
    session["live"]["token"] = token_;
  }
  return session.dump();
}

SocketMessage ViewSite::AnswerMessage(const std::string& message) const { return live_->Answer(message, token_); }

void ViewSite::Write(const fs::path& folder) const {
  CheckNew(folder);
  // Whole, or not at all.
  const fs::path partial = folder.lexically_normal().string() + ".partial";
  try {
    WriteSite(partial);
  } catch (...) {
    std::error_code unimportant;
    fs::remove_all(partial, unimportant);
    throw;
  }
  if (fs::exists(folder)) fs::remove(folder);
  fs::rename(partial, folder);
}

void ViewSite::WriteSite(const fs::path& partial) const {
  CreateWritableFolder(partial);
  for (const PageFile& file : PageFiles()) WriteFileAtomically(partial / file.name, file.text);
  WriteFileAtomically(partial / "session.json", Session());
  for (size_t i = 0; i < datasets_.size(); ++i) WriteDataset(*datasets_[i], partial / kData / std::to_string(i));
}

HttpServerOptions ViewServerOptions(int port) {
  HttpServerOptions options{.port = port, .connections = 256, .body_bytes = 65536, .socket_target = "/live"};
  options.headers = {{"Content-Security-Policy",
                      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; worker-src 'self'; "
                      "connect-src 'self' ws://127.0.0.1:* ws://localhost:*; base-uri 'none'; form-action 'none'; "
                      "frame-ancestors 'self' http://127.0.0.1:* http://localhost:*"},
                     {"X-Content-Type-Options", "nosniff"},
                     {"Cross-Origin-Resource-Policy", "same-origin"},
                     {"Referrer-Policy", "no-referrer"}};
  return options;
}

std::string NewToken() {
  std::random_device source;
  std::string token;
  constexpr std::string_view kLetters = "0123456789abcdef";
  for (int i = 0; i < 32; ++i) token += kLetters[source() % kLetters.size()];
  return token;
}

}  // namespace airsim360
