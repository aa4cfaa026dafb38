// airsim360 learn: the programs of python/airsim360/learn, in place of this process.
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "airsim360/app/flags/commands.h"
#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;

std::string Setting(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : otherwise;
}

// Beside a program that was built and not installed lies its Python package.
void FindBuiltPackage() {
  std::error_code error;
  const fs::path package = fs::read_symlink("/proc/self/exe", error).parent_path().parent_path() / "python";
  if (!fs::exists(package / "airsim360" / "__init__.py", error)) return;
  const std::string others = Setting("PYTHONPATH", "");
  ::setenv("PYTHONPATH", (package.string() + (others.empty() ? "" : ":" + others)).c_str(), 1);
}

// Returns only if Python cannot be started.
void RunPython(const std::vector<std::string>& words) {
  std::string python = Setting("AIRSIM360_PYTHON", "/usr/bin/python3");
  std::vector<std::string> all{python, "-m", "airsim360.learn"};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> argv;
  for (std::string& word : all) argv.push_back(word.data());
  argv.push_back(nullptr);
  FindBuiltPackage();
  ::execvp(python.c_str(), argv.data());
  throw RuntimeError("learn: cannot run " + python + ": " + std::strerror(errno) +
                     "; AIRSIM360_PYTHON names the Python that has airsim360, torch and OpenCV");
}

}  // namespace

void AddLearnCommand(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("learn", "train on our worlds to see: classes, range, attitude (Python: python3-torch, python3-opencv)");
  command->prefix_command();  // what follows is for Python
  command->callback([command] { RunPython(command->remaining()); });
}

}  // namespace airsim360
