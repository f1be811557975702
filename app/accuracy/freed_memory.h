#pragma once

#include <malloc.h>

namespace app::accuracy {

/// Gives the system back what was freed. Where large things were made and freed the C library keeps hundreds
/// of megabytes, in pieces that the next large thing does not fit into.
inline void return_freed_memory() { ::malloc_trim(0); }

}  // namespace app::accuracy
