// airsim360 <command>: turns errors into exit statuses.
// 0 done, 1 failed at run time, 2 bad input; messages on stderr as "airsim360: error: …".
#include <csignal>
#include <cstdio>
#include <new>
#include <string>

#include "airsim360/app/program.h"
#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

constexpr int kFailed = 1;
constexpr int kBadInput = 2;

int Fail(const std::string& message, int status) {
  std::fprintf(stderr, "airsim360: error: %s\n", message.c_str());
  return status;
}

}  // namespace
}  // namespace airsim360

int main(int argc, char** argv) {
  using namespace airsim360;
  // A file size limit or a closed pipe comes back as an error of the write, not as a signal.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  try {
    Program().Run(argc, argv);
    return 0;
  } catch (const InputError& error) {
    return Fail(error.what(), kBadInput);
  } catch (const std::bad_alloc&) {
    return Fail("out of memory", kFailed);
  } catch (const std::exception& error) {
    return Fail(error.what(), kFailed);
  }
}
