#include "airsim360/http/http_client.h"

#include <curl/curl.h>

#include <memory>
#include <mutex>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

struct Inbox {
  std::string body;
  size_t most = 0;
};

size_t Receive(char* bytes, size_t, size_t count, void* user) {
  auto& inbox = *static_cast<Inbox*>(user);
  if (inbox.body.size() + count > inbox.most) return 0;  // ends the transfer
  inbox.body.append(bytes, count);
  return count;
}

std::string FaultOf(CURLcode code, double seconds, size_t most) {
  switch (code) {
    case CURLE_OPERATION_TIMEDOUT:
      return "no answer within " + std::to_string(static_cast<int>(seconds)) + " s";
    case CURLE_WRITE_ERROR:
    case CURLE_FILESIZE_EXCEEDED:
      return "an answer of more than " + std::to_string(most >> 20) + " MiB";
    case CURLE_GOT_NOTHING:
    case CURLE_RECV_ERROR:
    case CURLE_PARTIAL_FILE:
    case CURLE_SEND_ERROR:
      return "the connection was dropped";
    case CURLE_COULDNT_CONNECT:
    case CURLE_COULDNT_RESOLVE_HOST:
      return "the server cannot be reached";
    default:
      return curl_easy_strerror(code);
  }
}

using Handle = std::unique_ptr<CURL, decltype(&curl_easy_cleanup)>;

Handle NewHandle(const std::string& url, double seconds) {
  static std::once_flag once;
  std::call_once(once, [] { curl_global_init(CURL_GLOBAL_DEFAULT); });
  Handle handle(curl_easy_init(), curl_easy_cleanup);
  if (!handle) throw RuntimeError("libcurl cannot be started");
  curl_easy_setopt(handle.get(), CURLOPT_URL, url.c_str());
  curl_easy_setopt(handle.get(), CURLOPT_PROTOCOLS_STR, "http,https");
  curl_easy_setopt(handle.get(), CURLOPT_FOLLOWLOCATION, 0L);
  curl_easy_setopt(handle.get(), CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(handle.get(), CURLOPT_TIMEOUT_MS, static_cast<long>(seconds * 1000));
  return handle;
}

HttpAnswer Perform(CURL* handle, double seconds, size_t most_bytes) {
  Inbox inbox{{}, most_bytes};
  curl_easy_setopt(handle, CURLOPT_WRITEFUNCTION, Receive);
  curl_easy_setopt(handle, CURLOPT_WRITEDATA, &inbox);
  const CURLcode code = curl_easy_perform(handle);
  HttpAnswer answer;
  long status = 0;
  curl_easy_getinfo(handle, CURLINFO_RESPONSE_CODE, &status);
  curl_easy_getinfo(handle, CURLINFO_TOTAL_TIME, &answer.seconds);
  answer.status = static_cast<int>(status);
  if (code != CURLE_OK) {
    answer.fault = FaultOf(code, seconds, most_bytes);
    answer.again =
        code != CURLE_WRITE_ERROR && code != CURLE_FILESIZE_EXCEEDED && code != CURLE_URL_MALFORMAT && code != CURLE_UNSUPPORTED_PROTOCOL;
    return answer;
  }
  answer.body = std::move(inbox.body);
  if (status / 100 == 2) return answer;
  answer.fault = "status " + std::to_string(status);
  answer.again = status == 408 || status == 409 || status == 425 || status == 429 || status >= 500;
  return answer;
}

}  // namespace

HttpAnswer PostJson(const std::string& url, const std::string& key, const std::string& body, double seconds, size_t most_bytes) {
  const Handle handle = NewHandle(url, seconds);
  curl_slist* list = curl_slist_append(nullptr, "Content-Type: application/json");
  list = curl_slist_append(list, "Expect:");
  if (!key.empty()) list = curl_slist_append(list, ("Authorization: Bearer " + key).c_str());
  const std::unique_ptr<curl_slist, decltype(&curl_slist_free_all)> headers(list, curl_slist_free_all);
  curl_easy_setopt(handle.get(), CURLOPT_HTTPHEADER, headers.get());
  curl_easy_setopt(handle.get(), CURLOPT_POSTFIELDS, body.data());
  curl_easy_setopt(handle.get(), CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(body.size()));
  return Perform(handle.get(), seconds, most_bytes);
}

HttpAnswer GetHttp(const std::string& url, double seconds, size_t most_bytes) {
  const Handle handle = NewHandle(url, seconds);
  return Perform(handle.get(), seconds, most_bytes);
}

}  // namespace airsim360
