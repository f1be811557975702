#include <imgui.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "app/view/panels/list.h"
#include "app/view/text.h"

namespace app::view {

void draw_place(Session& session) {
  const Standpoint& stand = session.navigator.stand();
  ImGui::TextUnformatted(latitude_longitude(stand.place.lat_deg, stand.place.lon_deg).c_str());
  ImGui::Text("%s above ground, height %s", length(session.above_ground_m()).c_str(),
              length(stand.place.h_m).c_str());
  const double heading = std::fmod(stand.look.heading_deg + 360.0, 360.0);
  ImGui::Text("heading %.1f°, pitch %.1f°", heading, stand.look.pitch_deg);
  ImGui::Spacing();
  ImGui::TextDisabled("under the pointer");
  if (!session.pointed) {
    ImGui::TextUnformatted("sky");
    ImGui::TextUnformatted(" ");
    ImGui::TextUnformatted(" ");
    return;
  }
  const globe::geo::Geodetic at = session.geodetic_of(*session.pointed);
  ImGui::TextUnformatted(latitude_longitude(at.lat_deg, at.lon_deg).c_str());
  ImGui::Text("%s  %s", sexagesimal(at.lat_deg, 'N', 'S').c_str(), sexagesimal(at.lon_deg, 'E', 'W').c_str());
  const double way = glm::distance(*session.pointed, session.navigator.camera().position);
  ImGui::Text("ground %s, %s away", length(session.scenery.ground_m(at.lat_deg, at.lon_deg)).c_str(),
              length(way).c_str());
}

}  // namespace app::view
