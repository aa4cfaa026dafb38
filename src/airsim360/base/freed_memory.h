// Memory that was freed, back to the system.
#pragma once

#include <malloc.h>

namespace airsim360 {

/// What a large piece of work leaves free in the heap goes back to the system: large tables take their memory elsewhere and
/// would stand beside it. Takes milliseconds.
inline void ReturnFreedMemory() { ::malloc_trim(0); }

}  // namespace airsim360
