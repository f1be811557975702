#include <imgui.h>

#include <string>

#include "app/view/panels/list.h"

namespace app::view {

void draw_capture(Session& session) {
  if (ImGui::Button("save picture")) session.save_picture();
  ImGui::SameLine();
  if (ImGui::Button(session.recorder ? "stop film" : "film")) session.toggle_recording();
  if (session.recorder) {
    ImGui::SameLine();
    ImGui::Text("%.1f s", session.recorder->seconds());
  }
  const std::string line = session.shot_line("picture.png");
  if (ImGui::Button("copy command")) {
    session.window.set_clipboard(line);
    session.tell("copied");
  }
  ImGui::TextWrapped("%s", line.c_str());
}

}  // namespace app::view
