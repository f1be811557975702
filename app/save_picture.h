#pragma once

#include "app/view_options.h"
#include "globe/gl/framebuffer.h"

namespace app {

/// Writes a finished picture where the options say, or its depth where they ask for that.
/// @param near_m  the near plane it was drawn with. Throws what write_image throws.
void save_picture(const ViewOptions& options, const globe::gl::Framebuffer& picture, double near_m);

}  // namespace app
