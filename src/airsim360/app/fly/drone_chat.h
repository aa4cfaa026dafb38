// A drone's form filled by a language model behind an OpenAI-style chat interface, on the user's request alone.
#pragma once

#include <string>

#include "airsim360/flight/prompt/request.h"

namespace airsim360 {

struct DroneChat {
  std::string url;              ///< http(s)://…, with or without /chat/completions at its end
  std::string model;            ///< "" = the server's own choice
  std::string key_environment;  ///< name of the environment variable that holds the key; "" = no key
  int seconds = 60;             ///< that the answer may take: a model on a processor alone is slow
};

/// Sends `words` and the form's schema to the server in one POST by the program curl (no redirects, 1 MiB of answer), and reads the form that comes back. InputError for a wrong URL or variable, a missing curl, and a form
/// that ReadDroneForm refuses; RuntimeError for a server that does not answer as it must.
DroneRequest AskForDrone(const DroneChat& chat, const std::string& words);

}  // namespace airsim360
