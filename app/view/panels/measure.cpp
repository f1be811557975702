#include <imgui.h>

#include <algorithm>
#include <cstdio>

#include "app/view/panels/list.h"
#include "app/view/text.h"

namespace app::view {
namespace {

constexpr ImU32 kLine = IM_COL32(128, 230, 255, 255);
constexpr ImU32 kShadow = IM_COL32(0, 0, 0, 160);

/// Where a place is seen in the units of widgets; nothing behind the camera or the planet's horizon.
std::optional<ImVec2> on_screen(const Session& session, const globe::geo::Geodetic& place) {
  const globe::geo::Ellipsoid& ellipsoid = session.scenery.ellipsoid();
  const globe::render::Camera camera = session.navigator.camera();
  const glm::dvec3 at = globe::geo::ecef_from_geodetic(ellipsoid, place);
  // In front of the planet when the way to it does not lead through a ball a little smaller than the planet.
  const glm::dvec3 way = at - camera.position;
  const double t = std::clamp(-glm::dot(camera.position, way) / glm::dot(way, way), 0.0, 1.0);
  if (glm::length(camera.position + t * way) < ellipsoid.b() * 0.998) return std::nullopt;
  const auto pixel = session.navigator.eye().pixel_of(camera, at);
  if (!pixel) return std::nullopt;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  return ImVec2(static_cast<float>(pixel->x / session.navigator.eye().size.x) * size.x,
                static_cast<float>(pixel->y / session.navigator.eye().size.y) * size.y);
}

void mark(const Session& session, const globe::geo::Geodetic& place) {
  const auto at = on_screen(session, place);
  if (!at) return;
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  list->AddCircleFilled(*at, 5.0f, kShadow);
  list->AddCircleFilled(*at, 3.5f, kLine);
}

}  // namespace

void draw_measure(Session& session) {
  bool on = session.measure.is_on();
  if (ImGui::Checkbox("lay a line by two clicks", &on)) session.measure.set_on(on);
  if (!on) return;
  const std::optional<MeasuredLine>& line = session.measure.line();
  if (!line) {
    ImGui::TextDisabled(session.measure.begun_at() ? "click its end" : "click its beginning");
    return;
  }
  ImGui::Text("%s along the ellipsoid", length(line->geodesic.s12_m).c_str());
  ImGui::Text("%.3f m", line->geodesic.s12_m);
  ImGui::Text("azimuth %.2f° there, %.2f° on arrival", line->geodesic.azi1_deg, line->geodesic.azi2_deg);
  const auto [low, high] = std::minmax_element(line->ground_m.begin(), line->ground_m.end());
  char title[64];
  std::snprintf(title, sizeof title, "%s to %s", length(static_cast<double>(*low)).c_str(),
                length(static_cast<double>(*high)).c_str());
  const float margin = 0.1f * std::max(*high - *low, 1.0f);
  ImGui::PlotLines("##profile", line->ground_m.data(), static_cast<int>(line->ground_m.size()), 0, title,
                   *low - margin, *high + margin,
                   {ImGui::GetContentRegionAvail().x, 5.0f * ImGui::GetTextLineHeight()});
}

void draw_marks(Session& session) {
  if (const auto& begin = session.measure.begun_at()) mark(session, *begin);
  const std::optional<MeasuredLine>& line = session.measure.line();
  if (!line) return;
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  std::optional<ImVec2> before;
  for (std::size_t k = 0; k < line->places.size(); ++k) {
    globe::geo::Geodetic place = line->places[k];
    place.h_m = static_cast<double>(line->ground_m[k]);
    const auto at = on_screen(session, place);
    if (before && at) {
      list->AddLine(*before, *at, kShadow, 5.0f);
      list->AddLine(*before, *at, kLine, 2.5f);
    }
    before = at;
  }
  mark(session, line->from);
  mark(session, line->to);
}

}  // namespace app::view
