#include "app/flight_stats.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "globe/base/text_file.h"

namespace app {

double percentile(std::vector<double> values, double p) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(p / 100.0 * static_cast<double>(values.size())));
  return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
}

FlightStats::FlightStats(std::string renderer, std::string gl_version, int width, int height, int detail,
                         int planet_level)
    : renderer_(std::move(renderer)),
      gl_version_(std::move(gl_version)),
      width_(width),
      height_(height),
      detail_(detail),
      planet_level_(planet_level) {}

void FlightStats::write(const std::string& path) const {
  using nlohmann::json;
  json frames = json::array();
  std::vector<double> times, cpu_times;
  std::size_t upload_bytes = 0, complete = 0;
  double completeness = 0.0;
  for (const Frame& f : frames_) {
    times.push_back(f.frame_ms);
    cpu_times.push_back(f.drawn.cpu_ms);
    frames.push_back({{"frame", f.frame},
                      {"lat", f.place.lat_deg},
                      {"lon", f.place.lon_deg},
                      {"alt_m", f.place.h_m},
                      {"above_ground_m", f.above_ground_m},
                      {"frame_ms", f.frame_ms},
                      {"cpu_ms", f.drawn.cpu_ms},
                      {"gpu_ms", f.gpu_ms},
                      {"triangles", f.drawn.triangles},
                      {"patches", f.drawn.patches},
                      {"upload_bytes", f.drawn.upload_bytes},
                      {"upload_ms", f.drawn.upload_ms},
                      {"queued_jobs", f.drawn.queued_jobs},
                      {"queued_bytes", f.drawn.queued_bytes},
                      {"gpu_bytes", f.drawn.gpu_bytes},
                      {"finest_level", f.drawn.finest_level},
                      {"completeness", f.drawn.completeness},
                      {"complete", f.drawn.complete}});
    upload_bytes += f.drawn.upload_bytes;
    completeness += f.drawn.completeness;
    complete += f.drawn.complete ? 1 : 0;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(frames_.size(), 1));
  const json document{{"renderer", renderer_},
                      {"gl_version", gl_version_},
                      {"width", width_},
                      {"height", height_},
                      {"detail", detail_},
                      {"planet_level", planet_level_},
                      {"frames", frames},
                      {"summary",
                       {{"frames", frames_.size()},
                        {"frame_ms_median", percentile(times, 50)},
                        {"frame_ms_p10", percentile(times, 10)},
                        {"frame_ms_p90", percentile(times, 90)},
                        {"frame_ms_p99", percentile(times, 99)},
                        {"frame_ms_max", percentile(times, 100)},
                        {"cpu_ms_median", percentile(cpu_times, 50)},
                        {"cpu_ms_p99", percentile(cpu_times, 99)},
                        {"upload_bytes", upload_bytes},
                        {"completeness", completeness / count},
                        {"complete", static_cast<double>(complete) / count}}}};
  globe::write_text_file(path, document.dump(1) + "\n", true);
}

std::string FlightStats::table(std::size_t gpu_bytes) const {
  std::string text = "   frame   above ground  level  triangles  patches      ms    uploaded  complete\n";
  char line[160];
  const int rows = std::min<int>(12, static_cast<int>(frames_.size()));
  for (int row = 0; row < rows; ++row) {
    const auto k =
        rows == 1 ? 0
                  : static_cast<std::size_t>(row) * (frames_.size() - 1) / static_cast<std::size_t>(rows - 1);
    const Frame& f = frames_[k];
    std::snprintf(line, sizeof line, "%8d %12.1f m %6d %10zu %8zu %7.1f %8.0f KiB  %6.0f %%\n", f.frame,
                  f.above_ground_m, f.drawn.finest_level, f.drawn.triangles, f.drawn.patches, f.frame_ms,
                  static_cast<double>(f.drawn.upload_bytes) / 1024.0, 100.0 * f.drawn.completeness);
    text += line;
  }
  std::vector<double> times;
  std::size_t complete = 0;
  for (const Frame& f : frames_) {
    times.push_back(f.frame_ms);
    complete += f.drawn.complete ? 1 : 0;
  }
  std::snprintf(line, sizeof line,
                "%zu frames of %dx%d, detail %d: median %.1f ms, p90 %.1f, p99 %.1f, max %.1f; ",
                frames_.size(), width_, height_, detail_, percentile(times, 50), percentile(times, 90),
                percentile(times, 99), percentile(times, 100));
  text += line;
  std::snprintf(line, sizeof line, "%zu complete; %.0f MiB of textures\n", complete,
                static_cast<double>(gpu_bytes) / (1024.0 * 1024.0));
  return text + line + renderer_ + ", OpenGL " + gl_version_ + "\n";
}

}  // namespace app
