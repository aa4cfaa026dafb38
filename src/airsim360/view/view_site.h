// What the page and its data are, by address; the server sends it, the export writes it.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/dataset/viewing/viewed_dataset.h"
#include "airsim360/http/http_server.h"
#include "airsim360/view/drawn_frames.h"
#include "airsim360/view/live_source.h"

namespace airsim360 {

/// Everything is below "/": the files of the page, session.json (what is shown), data/N/… (dataset N). Thread-safe.
class ViewSite {
 public:
  /// At most two datasets, side by side; or a live world, to which `token` gives control.
  ViewSite(std::vector<std::shared_ptr<ViewedDataset>> datasets, std::shared_ptr<LiveSource> live = nullptr, std::string token = {});
  /// Frames that are drawn when they are looked at.
  explicit ViewSite(std::shared_ptr<DrawnFrames> drawn) : drawn_(std::move(drawn)) {}

  /// GET alone. Never throws.
  HttpResponse Answer(const HttpRequest& request) const;
  /// One message of a WebSocket, of a live world alone.
  SocketMessage AnswerMessage(const std::string& message) const;

  /// Writes the page and the datasets into a folder for a server of files: a new or empty one. InputError for one that holds
  /// something.
  void Write(const std::filesystem::path& folder) const;

 private:
  HttpResponse Find(std::string_view path) const;
  HttpResponse Data(std::string_view path) const;
  std::string Session() const;
  void WriteSite(const std::filesystem::path& partial) const;

  std::vector<std::shared_ptr<ViewedDataset>> datasets_;
  std::shared_ptr<LiveSource> live_;
  std::string token_;
  std::shared_ptr<DrawnFrames> drawn_;
};

/// Options of a server of it: this machine alone, and headers that let the page load nothing from elsewhere.
HttpServerOptions ViewServerOptions(int port);

/// 128 random bits, in letters; of this machine's source of them.
std::string NewToken();

}  // namespace airsim360
