#include <imgui.h>

#include <array>
#include <utility>

#include "app/view/panels/list.h"

namespace app::view {

void draw_keys(Session& /*session*/) {
  static constexpr std::array kKeys = {
      std::pair{"drag", "turn the globe"},
      std::pair{"wheel", "nearer, farther"},
      std::pair{"right drag", "tilt and turn"},
      std::pair{"middle drag", "look around"},
      std::pair{"double-click", "fly there"},
      std::pair{"W A S D", "fly; Shift: faster"},
      std::pair{"R F", "up, down"},
      std::pair{"arrows", "turn and tilt"},
      std::pair{"N, U, Home", "north up, look down, whole globe"},
      std::pair{"Ctrl+F", "search"},
      std::pair{"Space", "run and pause, follow the path"},
      std::pair{"P, V, C", "picture, film, copy command"},
      std::pair{"M", "measuring line"},
      std::pair{"Tab, F11", "overlay, full screen"},
      std::pair{"Ctrl+Q", "close"},
  };
  for (const auto& [key, what] : kKeys) {
    ImGui::TextUnformatted(key);
    ImGui::SameLine(ImGui::GetWindowContentRegionWidth() * 0.35f);
    ImGui::TextDisabled("%s", what);
  }
}

}  // namespace app::view
