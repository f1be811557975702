#include "app/progress.h"

#include <unistd.h>

#include <cstdio>
#include <nlohmann/json.hpp>

namespace app {

ProgressStyle progress_style(bool quiet, bool json) {
  if (json) return ProgressStyle::kJson;
  return !quiet && ::isatty(STDERR_FILENO) != 0 ? ProgressStyle::kBar : ProgressStyle::kNone;
}

void Progress::show(const std::string& stage, double fraction) {
  const int percent = static_cast<int>(fraction * 100.0);
  if (style_ == ProgressStyle::kNone || (stage == stage_ && percent <= percent_)) return;
  stage_ = stage;
  percent_ = percent;
  if (style_ == ProgressStyle::kJson) {
    const nlohmann::ordered_json line{{"stage", stage}, {"percent", percent}};
    std::fprintf(stderr, "%s\n", line.dump().c_str());
    return;
  }
  constexpr int kWidth = 40;
  const int filled = percent * kWidth / 100;
  const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                          std::string(static_cast<std::size_t>(kWidth - filled), '.');
  std::fprintf(stderr, "\r%-18s [%s] %3d %%", stage.c_str(), bar.c_str(), percent);
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::clear() {
  if (!drawn_) return;
  std::fprintf(stderr, "\r\033[K");
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace app
