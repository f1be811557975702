#include "app/view/process_age.h"

#include <time.h>
#include <unistd.h>

#include <fstream>
#include <limits>
#include <string>

namespace app::view {
namespace {

constexpr int kStarted = 22;  ///< field of /proc/self/stat, see proc(5)

/// Seconds from the machine's start to the program's; 0 where /proc is not there.
double started_s() {
  std::ifstream stat("/proc/self/stat");
  stat.ignore(std::numeric_limits<std::streamsize>::max(), ')');  // the name may hold spaces; field 3 follows
  std::string field;
  for (int k = 3; k <= kStarted; ++k) stat >> field;
  return stat ? std::stod(field) / static_cast<double>(sysconf(_SC_CLK_TCK)) : 0.0;
}

}  // namespace

double process_age_s() {
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec) - started_s();
}

}  // namespace app::view
