// Keyword arguments from the fields of a configuration (base/config.h).
#pragma once

#include <string>

#include "airsim360/base/config.h"
#include "convert.h"

namespace airsim360::python {

/// Takes the fields from keywords. ValueError naming the keyword, the value and the nearest valid one, also for a
/// keyword that no field has: the choices are the fields and `others`, keywords that were read already.
void ReadKeywords(const py::dict& keywords, const ConfigFields& fields, const std::vector<std::string>& others = {});

/// Names of the fields.
std::vector<std::string> KeywordNames(const ConfigFields& fields);
/// "samples: int | None = None, denoise: bool = True, …": the fields as parameters of a signature.
std::string KeywordSignature(const ConfigFields& fields);
/// "samples: what it is. denoise: …": for docstrings.
std::string KeywordHelp(const ConfigFields& fields);

}  // namespace airsim360::python
