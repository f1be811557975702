#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "app/view/panels/list.h"
#include "app/view/text.h"

namespace app::view {

void draw_figures(Session& session) {
  const globe::render::FrameStats& frame = session.figures.last();
  const std::vector<float> times = session.figures.times_ms();
  const double median = session.figures.percentile_ms(50.0), slow = session.figures.percentile_ms(99.0);
  char title[64];
  std::snprintf(title, sizeof title, "p50 %.1f ms   p99 %.1f ms", median, slow);
  const float highest = times.empty() ? 1.0f : *std::max_element(times.begin(), times.end());
  ImGui::PlotLines("##times", times.data(), static_cast<int>(times.size()), 0, title, 0.0f, 1.2f * highest,
                   {ImGui::GetContentRegionAvail().x, 4.0f * ImGui::GetTextLineHeight()});
  if (median > 0.0) ImGui::Text("%.1f frames a second, drawing alone", 1000.0 / median);
  ImGui::Text("%zu triangles in %zu patches", frame.triangles, frame.patches);
  ImGui::Text("%s uploaded, %d jobs wait", bytes(static_cast<double>(frame.upload_bytes)).c_str(),
              frame.queued_jobs);
  ImGui::Text("%s on the GPU", bytes(static_cast<double>(frame.gpu_bytes)).c_str());
  char level[48];
  std::snprintf(level, sizeof level, "level %d, %.0f %% of the levels wanted", frame.finest_level,
                100.0 * frame.completeness);
  ImGui::ProgressBar(static_cast<float>(frame.completeness), {-1.0f, 0.0f}, level);
  ImGui::TextDisabled("%s", session.window.renderer().c_str());
}

}  // namespace app::view
