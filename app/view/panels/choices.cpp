#include <imgui.h>

#include "app/view/panels/list.h"

namespace app::view {
namespace {

void draw_switch(Session& session, const Choice& choice) {
  bool on = choice.get() == 1;
  if (ImGui::Checkbox(choice.name.c_str(), &on)) session.attempt([&] { choice.set(on ? 1 : 0); });
}

void draw_words(Session& session, const Choice& choice) {
  const std::size_t now = choice.get();
  ImGui::SetNextItemWidth(ImGui::GetWindowContentRegionWidth() * 0.5f);
  if (!ImGui::BeginCombo(choice.name.c_str(), choice.words[now].c_str())) return;
  for (std::size_t k = 0; k < choice.words.size(); ++k) {
    if (ImGui::Selectable(choice.words[k].c_str(), k == now) && k != now)
      session.attempt([&] { choice.set(k); });
  }
  ImGui::EndCombo();
}

}  // namespace

void draw_choices(Session& session) {
  for (const Choice& choice : session.scenery.choices()) {
    if (!choice.is_switch()) draw_words(session, choice);
  }
  int column = 0;
  for (const Choice& choice : session.scenery.choices()) {
    if (!choice.is_switch()) continue;
    if (column++ % 2 == 1) ImGui::SameLine(ImGui::GetWindowContentRegionWidth() * 0.5f);
    draw_switch(session, choice);
  }
}

}  // namespace app::view
