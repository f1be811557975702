#include "app/accuracy/drawing_quality.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <glm/geometric.hpp>
#include <random>

#include "app/accuracy/repeated_frame.h"
#include "globe/clipmap/drawn_surface.h"
#include "globe/planet/scenic.h"

namespace app::accuracy {
namespace {

namespace geo = globe::geo;
namespace render = globe::render;
using glm::dvec3;
using globe::clipmap::DrawnPoint;
using globe::clipmap::DrawnSurface;
using globe::clipmap::Settings;
using globe::planet::Surface;

constexpr int kFinest = 26;            ///< level of the finest triangles (render::RenderSettings::max_level)
constexpr double kFinestCell = 0.125;  ///< pixels
constexpr std::size_t kFramesQuick = 9, kFramesFull = 31;

/// Pixels from the picture's middle, y up.
glm::dvec2 pixel_of(const render::Camera& camera, const PictureSize& picture, const dvec3& relative) {
  const double w = glm::dot(relative, camera.forward);
  return {glm::dot(relative, camera.right) / (w * camera.tan_x()) * picture.width / 2.0,
          glm::dot(relative, camera.up) / (w * camera.tan_y()) * picture.height / 2.0};
}

/// How far a point of the drawn surface is from the finest one, along the vertical, pixels.
double error_at(const Surface& surface, const render::Camera& camera, const PictureSize& picture,
                const DrawnPoint& point) {
  const geo::Geodetic place = geo::geodetic_from_ecef(surface.ellipsoid(), point.position);
  const dvec3 u = geo::normal_from_degrees(place.lat_deg, place.lon_deg);
  const double cell_m = kFinestCell * point.distance_m * 2.0 * camera.tan_y() / picture.height;
  const int level = static_cast<int>(std::ceil(std::log2(surface.root_edge() / cell_m)));
  const double height_m = surface.drawn_height(surface.height(u, std::clamp(level, point.level, kFinest)));
  const dvec3 finest = geo::ecef_from_normal(surface.ellipsoid(), u, height_m);
  return glm::length(pixel_of(camera, picture, finest - camera.position) -
                     pixel_of(camera, picture, point.position - camera.position));
}

}  // namespace

std::vector<JudgedView> judged_views(const Surface& surface, const PictureSize& picture) {
  const globe::planet::ScenicView scenic = globe::planet::scenic_place(surface);
  const double scale = surface.ellipsoid().mean_radius() / geo::kWgs84.mean_radius();
  const double aspect = static_cast<double>(picture.width) / picture.height;
  const auto view = [&](const char* name, double above_m, double pitch_deg) {
    geo::Geodetic place = scenic.place;
    place.h_m = surface.drawn_height(place.h_m) + above_m;
    return JudgedView{name, render::make_camera(surface.ellipsoid(), place, scenic.heading_deg, pitch_deg,
                                                picture.fov_y_deg, aspect)};
  };
  // From 1000 km over a planet of the Earth's size the limb is 30 degrees down.
  return {view("orbit", 2e7 * scale, -90.0), view("limb", 1e6 * scale, -30.0),
          view("100 km", 1e5 * scale, -35.0), view("2 km", 2000.0, -12.0), view("eye height", 2.0, -3.0)};
}

std::vector<std::vector<glm::dvec2>> judged_rays(std::size_t views, const PictureSize& picture, int rows) {
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const int columns = std::max(rows * picture.width / picture.height, 1);
  std::vector<std::vector<glm::dvec2>> rays(views);
  for (auto& through : rays) {
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        const double across = (x + unit(random)) / columns, down = (y + unit(random)) / rows;
        through.emplace_back(across, down);
      }
    }
  }
  return rays;
}

std::vector<ErrorFigure> drawn_errors(const std::vector<Settings>& settings,
                                      const std::shared_ptr<const Surface>& surface,
                                      const PictureSize& picture, int rows) {
  std::vector<ErrorSum> sums(settings.size());
  const std::vector<JudgedView> views = judged_views(*surface, picture);
  const auto rays = judged_rays(views.size(), picture, rows);
  for (std::size_t v = 0; v < views.size(); ++v) {
    const JudgedView& view = views[v];
    std::deque<DrawnSurface> drawn;
    for (const Settings& each : settings)
      drawn.push_back(globe::clipmap::complete_surface(each, surface, view.camera.position, kFinest));
    for (const glm::dvec2& through : rays[v]) {
      const globe::clipmap::Ray ray(view.camera.position,
                                    render::direction_through(view.camera, through.x, through.y));
      for (std::size_t k = 0; k < settings.size(); ++k) {
        const auto hit = drawn[k].first_hit(ray);
        if (!hit) continue;
        sums[k].add(error_at(*surface, view.camera, picture, *hit), [&] {
          char text[64];
          std::snprintf(text, sizeof text, "%s, pixel %.0f,%.0f", view.name.c_str(),
                        through.x * picture.width, through.y * picture.height);
          return std::string(text);
        });
      }
    }
  }
  std::vector<ErrorFigure> figures;
  figures.reserve(sums.size());
  for (const ErrorSum& sum : sums) figures.push_back(sum.figure());
  return figures;
}

FrameFigure frame_figure(const std::shared_ptr<globe::gl::Context>& context, const Settings& settings,
                         const std::shared_ptr<const Surface>& surface, const PictureSize& picture,
                         std::size_t frames) {
  render::RenderSettings ground;
  ground.clipmap = settings;
  RepeatedFrame frame(context, surface, ground, picture.width, picture.height);
  FrameFigure figure;
  for (const JudgedView& view : judged_views(*surface, picture)) {
    const dvec3 sun = sun_over(*surface, view.camera);
    PassCosts times;
    for (std::size_t k = 0; k < frames; ++k) times.push_back({frame.draw_ms(view.camera, sun)});
    figure.triangles = std::max(figure.triangles, frame.stats().triangles);
    figure.texture_bytes = std::max(figure.texture_bytes, frame.stats().gpu_bytes);
    const CostFigure ms = cost_figure(times);
    if (ms.median <= figure.ms.median) continue;
    figure.ms = ms;
    figure.where = view.name;
  }
  return figure;
}

std::vector<DrawingQuality> drawing_quality(const std::shared_ptr<globe::gl::Context>& context,
                                            const std::vector<int>& details,
                                            const std::shared_ptr<const Surface>& surface,
                                            const PictureSize& picture, const Scope& scope) {
  std::vector<Settings> settings;
  settings.reserve(details.size());
  for (const int detail : details) settings.push_back(Settings::for_detail(detail));
  const std::vector<ErrorFigure> errors =
      drawn_errors(settings, surface, picture, scope.full ? kRowsFull : kRowsQuick);
  std::vector<DrawingQuality> qualities;
  for (std::size_t k = 0; k < details.size(); ++k)
    qualities.push_back(
        {details[k], errors[k],
         frame_figure(context, settings[k], surface, picture, scope.full ? kFramesFull : kFramesQuick)});
  return qualities;
}

}  // namespace app::accuracy
