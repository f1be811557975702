#include <imgui.h>
#include <imgui_stdlib.h>

#include <string>
#include <vector>

#include "app/point.h"
#include "app/view/panels/list.h"
#include "globe/base/error.h"

namespace app::view {
namespace {

constexpr double kViewedFrom = 12e3;  ///< metres from a place that was looked for
constexpr double kViewPitch = -35.0;
constexpr std::size_t kMostHits = 8;

void go_to(Session& session, double lat_deg, double lon_deg, double alt_m, bool has_alt) {
  const globe::geo::Geodetic place{lat_deg, lon_deg,
                                   has_alt ? alt_m : session.scenery.ground_m(lat_deg, lon_deg)};
  const double scale = globe::geo::small_body_scale(session.scenery.ellipsoid());
  session.on_path = false;
  if (has_alt) {
    session.navigator.fly_to({place, {0.0, -90.0, 0.0}});
  } else {
    session.navigator.look_at(globe::geo::ecef_from_geodetic(session.scenery.ellipsoid(), place),
                              kViewedFrom * scale, 0.0, kViewPitch);
  }
}

void look_up(Session& session) {
  SearchBox& box = session.search;
  box.asked = box.text;
  box.found.clear();
  if (!session.features || box.text.empty()) return;
  globe::search::Query query;
  query.name_prefix = box.text;
  query.count = kMostHits;
  session.attempt([&] {
    for (const globe::search::Hit& hit : session.features->find(query))
      box.found.push_back({session.features->read(hit).name, hit.lat_deg, hit.lon_deg});
  });
}

}  // namespace

void draw_search(Session& session) {
  SearchBox& box = session.search;
  if (box.wants_keyboard) {
    ImGui::SetKeyboardFocusHere();
    box.wants_keyboard = false;
  }
  ImGui::SetNextItemWidth(-1.0f);
  const bool entered =
      ImGui::InputTextWithHint("##search", session.features ? "name or coordinates" : "coordinates",
                               &box.text, ImGuiInputTextFlags_EnterReturnsTrue);
  if (box.text != box.asked) look_up(session);
  for (std::size_t k = 0; k < box.found.size(); ++k) {
    const SearchBox::Found& found = box.found[k];
    ImGui::PushID(static_cast<int>(k));
    if (ImGui::Selectable(found.name.c_str())) go_to(session, found.lat_deg, found.lon_deg, 0.0, false);
    ImGui::PopID();
  }
  if (!entered || box.text.empty()) return;
  if (!box.found.empty()) {
    go_to(session, box.found.front().lat_deg, box.found.front().lon_deg, 0.0, false);
    return;
  }
  session.attempt([&] {
    const Point point = parse_point(box.text);
    go_to(session, point.position.lat_deg, point.position.lon_deg, point.position.h_m, point.has_alt);
  });
}

}  // namespace app::view
