#include "converters/resources.h"

#include <unistd.h>

#include <algorithm>
#include <thread>

namespace converters {

std::size_t memory_cap(std::size_t asked_bytes) {
  if (asked_bytes > 0) return asked_bytes;
  return static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) / 2;
}

int thread_count(int asked) {
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace converters
