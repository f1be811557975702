#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/accuracy/measure.h"
#include "globe/clipmap/settings.h"
#include "globe/gl/context.h"
#include "globe/planet/surface.h"
#include "globe/render/camera.h"

namespace app::accuracy {

/// The picture that errors are counted in pixels of.
struct PictureSize {
  int width = 1280;
  int height = 720;
  double fov_y_deg = 60.0;
};
inline constexpr PictureSize kPicture;

inline constexpr int kRowsQuick = 9, kRowsFull = 36;  ///< of its pixels, where a study looks

/// A view that a planet's drawing is judged by.
struct JudgedView {
  std::string name;
  globe::render::Camera camera;
};

/// Orbit, the limb from 1000 km, 100 km, 2 km and eye height, all at the planet's mountains.
std::vector<JudgedView> judged_views(const globe::planet::Surface& surface, const PictureSize& picture);

/// Rays through the picture of each of several views, jittered on a grid of `rows` rows: shares of its width
/// from the left and of its height from the top. The same on every run.
std::vector<std::vector<glm::dvec2>> judged_rays(std::size_t views, const PictureSize& picture, int rows);

/// How far the surface drawn of each of several settings is from the surface at its finest, pixels: a figure
/// for each of the settings.
///
/// Rays (judged_rays) meet the drawn surface in double precision
/// (clipmap/drawn_surface.h). Each point is compared with the finest surface above or below it: triangles
/// of an eighth of a pixel, level 26 at most. What the GPU rounds beside that is the business of the
/// positions. The same on every run. All settings go together, for they share the ground that has to be
/// synthesised.
std::vector<ErrorFigure> drawn_errors(const std::vector<globe::clipmap::Settings>& settings,
                                      const std::shared_ptr<const globe::planet::Surface>& surface,
                                      const PictureSize& picture, int rows);

/// What frames take that have all they need.
struct FrameFigure {
  CostFigure ms;                  ///< of the slowest view
  std::string where;              ///< that view
  std::size_t triangles = 0;      ///< the most of any view
  std::size_t texture_bytes = 0;  ///< of the clipmap, the most of any view
};

/// Draws each view so many times off screen, after it has been loaded. The context has to be
/// current.
FrameFigure frame_figure(const std::shared_ptr<globe::gl::Context>& context,
                         const globe::clipmap::Settings& settings,
                         const std::shared_ptr<const globe::planet::Surface>& surface,
                         const PictureSize& picture, std::size_t frames);

/// What a detail gives on a planet, and takes.
struct DrawingQuality {
  int detail = 0;
  ErrorFigure error_px;
  FrameFigure frame;
};

/// drawn_errors and frame_figure of several details (`--detail`), sizes by the scope.
std::vector<DrawingQuality> drawing_quality(const std::shared_ptr<globe::gl::Context>& context,
                                            const std::vector<int>& details,
                                            const std::shared_ptr<const globe::planet::Surface>& surface,
                                            const PictureSize& picture, const Scope& scope);

}  // namespace app::accuracy
