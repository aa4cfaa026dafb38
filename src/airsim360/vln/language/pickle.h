// JSON as a Python pickle of protocol 2. For the .cc files of this folder.
#pragma once

#include <string>

#include "airsim360/vln/predicates/query_json.h"

namespace airsim360::internal {

/// Objects become dicts, lists lists, texts str, whole numbers int, others float. The opcodes are those of Python's pickletools.
std::string PickleOf(const VlnJson& value);

}  // namespace airsim360::internal
