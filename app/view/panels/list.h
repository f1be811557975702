#pragma once

#include <span>

#include "app/view/session.h"

namespace app::view {

/// A part of the overlay: a heading with widgets under it. A new one takes a file in this folder and a line
/// in list.cpp.
struct Panel {
  const char* title;
  bool is_open_at_first;
  void (*draw)(Session& session);
};

std::span<const Panel> panels();

void draw_place(Session& session);
void draw_search(Session& session);
void draw_time(Session& session);
void draw_choices(Session& session);
void draw_figures(Session& session);
void draw_capture(Session& session);
void draw_measure(Session& session);
void draw_keys(Session& session);

/// What panels mark on the picture itself.
void draw_marks(Session& session);

}  // namespace app::view
