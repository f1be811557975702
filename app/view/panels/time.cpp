#include <imgui.h>
#include <imgui_stdlib.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "app/point.h"
#include "app/records.h"
#include "app/view/panels/list.h"
#include "globe/geo/utc.h"

namespace app::view {
namespace {

namespace geo = globe::geo;
constexpr float kSecondsADay = 86400.0f;

void draw_clock(Session& session) {
  const bool has_end = session.flight != nullptr;
  if (ImGui::Button(session.running ? "pause" : "run")) session.running = !session.running;
  ImGui::SameLine();
  if (!has_end) {
    ImGui::Text("%.1f s since the beginning", session.moment_s);
    return;
  }
  const auto duration = static_cast<float>(session.flight->duration_s());
  auto moment = static_cast<float>(session.moment_s);
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::SliderFloat("##moment", &moment, 0.0f, duration, "%.1f s of the path")) {
    session.moment_s = static_cast<double>(moment);
    session.on_path = true;
  }
  if (ImGui::Checkbox("follow the path", &session.on_path) && session.on_path &&
      session.moment_s >= session.flight->duration_s())
    session.moment_s = 0.0;
}

void draw_date(Session& session) {
  TimeBox& box = session.time_box;
  if (box.of != session.time()) box.text = box.of = session.time();
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::InputTextWithHint("##time", "2026-06-21T10:00Z", &box.text,
                               ImGuiInputTextFlags_EnterReturnsTrue))
    session.attempt([&] { session.set_time(box.text); });
  if (session.time().empty()) return;
  const geo::UtcDate date = geo::parse_utc(session.time());
  const std::string text = geo::iso8601(date);
  const geo::UtcDate midnight = geo::parse_utc(text.substr(0, 10));
  const geo::UtcDate new_year = geo::parse_utc(text.substr(0, 4) + "-01-01");
  auto second = static_cast<float>(geo::seconds_between(midnight, date));
  auto day = static_cast<int>(std::floor(geo::seconds_between(new_year, midnight) / kSecondsADay + 0.5)) + 1;
  bool changed = false;
  char hour[16];
  std::snprintf(hour, sizeof hour, "%s", text.substr(11, 5).c_str());
  ImGui::SetNextItemWidth(-70.0f);
  changed |= ImGui::SliderFloat("UTC", &second, 0.0f, kSecondsADay - 60.0f, hour);
  ImGui::SetNextItemWidth(-70.0f);
  changed |= ImGui::SliderInt("day", &day, 1, 365, text.substr(5, 5).c_str());
  if (!changed) return;
  const double minutes = 60.0 * std::round(static_cast<double>(second) / 60.0);
  session.attempt(
      [&] { session.set_time(geo::iso8601(geo::later_by(new_year, (day - 1) * 86400.0 + minutes))); });
}

void draw_overhead(Session& session) {
  const geo::Geodetic over = parse_point(session.overhead()).position;
  auto lat = static_cast<float>(over.lat_deg), lon = static_cast<float>(over.lon_deg);
  ImGui::SetNextItemWidth(-70.0f);
  bool changed = ImGui::SliderFloat("sun lat", &lat, -90.0f, 90.0f, "%.1f°");
  ImGui::SetNextItemWidth(-70.0f);
  changed |= ImGui::SliderFloat("sun lon", &lon, -180.0f, 179.9f, "%.1f°");
  if (!changed) return;
  session.attempt([&] {
    session.set_overhead(number_text(static_cast<double>(lat), 3) + "," +
                         number_text(static_cast<double>(lon), 3));
  });
}

}  // namespace

void draw_time(Session& session) {
  if (session.scenery.is_animated() || session.flight) draw_clock(session);
  if (!session.overhead().empty()) draw_overhead(session);
  const std::string body = session.scenery.body();
  if (body != "moon" && body != "mars") draw_date(session);
}

}  // namespace app::view
