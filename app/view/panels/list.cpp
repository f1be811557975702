#include "app/view/panels/list.h"

#include <array>

namespace app::view {

std::span<const Panel> panels() {
  static constexpr std::array kPanels = {
      Panel{"Place", true, draw_place},        Panel{"Search", true, draw_search},
      Panel{"Time and sun", false, draw_time}, Panel{"Show", false, draw_choices},
      Panel{"Measure", false, draw_measure},   Panel{"Picture and film", false, draw_capture},
      Panel{"Figures", false, draw_figures},   Panel{"Keys", false, draw_keys},
  };
  return kPanels;
}

}  // namespace app::view
