// What `globe accuracy` reports of flat drawing, measured again by the depth of pictures, by other meshes and
// by GeographicLib: they agree to 5 %.

#include <GeographicLib/LocalCartesian.hpp>
#include <array>
#include <cstdlib>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>

#include "app/accuracy/endless_quality.h"
#include "app/accuracy/flat_quality.h"
#include "app/accuracy/seen_ground.h"
#include "flat/fractal/ground.h"
#include "tests/render/ground/views.h"
#include "tests/second_method.h"
#include "tests/unit/flat/mesh.h"

namespace {

namespace accuracy = app::accuracy;
namespace flat = globe::flat;
namespace fractal = globe::flat::fractal;
using globe::render::Camera;
using second::Long;
using second::Second;
using views::dvec3;

const accuracy::PictureSize kFlatPicture;

bool full() { return std::getenv("GLOBE_TEST_FULL") != nullptr; }

/// Pixels between what a camera sees in two directions, by the matrix that pictures are drawn with.
double pixels_apart(const Camera& camera, const dvec3& a, const dvec3& b) {
  const glm::dmat4 clip = globe::render::clip_from_relative(camera, 1.0);
  const glm::dvec4 p = clip * glm::dvec4(a, 1.0), q = clip * glm::dvec4(b, 1.0);
  return std::hypot((p.x / p.w - q.x / q.w) * kFlatPicture.width / 2.0,
                    (p.y / p.w - q.y / q.w) * kFlatPicture.height / 2.0);
}

/// z over a place, posts, of the plane through three posts of its cell: the diagonals of a chess board's
/// squares go from south-west to north-east, the others' across.
template <typename Z>
Long plane_z(Long x, Long y, const Z& z) {
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const Long u = x - i, v = y - j;
  const bool north_east = ((i + j) & 1) == 0;
  // From the corner where the cell's right angle lies, along both axes.
  const int right_i = north_east ? (u >= v ? i + 1 : i) : (u + v <= 1.0L ? i : i + 1),
            right_j = north_east ? (u >= v ? j : j + 1) : (u + v <= 1.0L ? j : j + 1);
  const int other_i = 2 * i + 1 - right_i, other_j = 2 * j + 1 - right_j;
  const Long corner = z(right_i, right_j);
  return corner + std::abs(x - right_i) * (z(other_i, right_j) - corner) +
         std::abs(y - right_j) * (z(right_i, other_j) - corner);
}

/// A picture of ground in a frame whose z is up, by the depth the GPU drew.
class DepthOfGround {
 public:
  /// @param camera  place and directions in the frame
  DepthOfGround(const Camera& camera, const globe::gl::Framebuffer& target, double near_m)
      : camera_(camera), depth_(target.read_depth()), near_m_(near_m) {}

  /// Adds how far the ground shown in the pixels that the report looks at is from that over the same place of
  /// the plane.
  ///
  /// Where triangles are seen along their edges, a place a little beside the pixel's middle is far along the
  /// ray, off the ground: what is more than `doubted` pixels off counts by the nearest to the ground that
  /// lies within a step of the GPU's 256 in a pixel; on ridges, where the next pixel is farther by more than
  /// a fiftieth, within a tenth of a pixel (H1).
  template <typename Z>
  void add_to(Second& second, double doubted, const Z& z_at) const {
    for (int y = 0; y < kFlatPicture.height; y += accuracy::kPixelStep) {
      for (int x = 0; x < kFlatPicture.width; x += accuracy::kPixelStep) {
        const double shown = depth(x, y);
        if (shown == 0.0) continue;
        const dvec3 ray = globe::render::direction_through(camera_, (x + 0.5) / kFlatPicture.width,
                                                           (y + 0.5) / kFlatPicture.height);
        const auto off = [&](double at_depth) {
          const dvec3 from_eye = ray * (near_m_ / at_depth / glm::dot(ray, camera_.forward));
          const dvec3 at = camera_.position + from_eye;
          return pixels_apart(camera_, from_eye,
                              {from_eye.x, from_eye.y,
                               static_cast<double>(z_at(Long(at.x), Long(at.y))) - camera_.position.z});
        };
        double error = off(shown);
        const double to_next = largest_step(x, y);
        const double step = to_next * (to_next > 0.02 * shown ? 0.1 : 1.0 / 256.0);
        for (const double share : {-1.0, -0.5, 0.5, 1.0}) {
          if (error > doubted) error = std::min(error, off(shown + share * step));
        }
        second.add(error);
      }
    }
  }

 private:
  double depth(int x, int y) const {
    return static_cast<double>(
        depth_[static_cast<std::size_t>(y) * static_cast<std::size_t>(kFlatPicture.width) +
               static_cast<std::size_t>(x)]);
  }
  double largest_step(int x, int y) const {
    double largest = 0;
    for (const auto& [i, j] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
      if (i >= 0 && j >= 0 && i < kFlatPicture.width && j < kFlatPicture.height && depth(i, j) != 0.0)
        largest = std::max(largest, std::abs(depth(i, j) - depth(x, y)));
    }
    return largest;
  }

  Camera camera_;
  std::vector<float> depth_;
  double near_m_;
};

TEST_F(GlTest, LevelsOfARegionErrByWhatTheDepthOfPicturesSays) {
  const auto terrain = accuracy::judged_region();
  auto views = accuracy::judged_region_views(*terrain, kFlatPicture);
  if (!full()) views.erase(views.begin() + 2, views.end());
  const double spacing = terrain->spacing_m();
  const auto& posts = terrain->posts();
  const auto z = [&](int i, int j) {
    return Long(terrain->z(std::clamp(i, 0, posts.columns - 1), std::clamp(j, 0, posts.rows - 1)));
  };
  for (const double error_px :
       full() ? std::vector{0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0} : std::vector{0.5, 2.0}) {
    const accuracy::ErrorFigure reported = accuracy::displacement(*terrain, error_px, views, kFlatPicture);
    EXPECT_LE(reported.max, error_px) << "what --error promises";
    flat::GeomipmapSettings settings;
    settings.error_px = error_px;
    accuracy::RegionFrame frame(lent(context()), terrain, settings, kFlatPicture);
    Second second;
    for (const accuracy::JudgedView& view : views) {
      frame.draw_ms(view.camera);
      Camera camera = view.camera;
      camera.position = terrain->frame().local_from_ecef(view.camera.position);
      for (dvec3* axis : {&camera.right, &camera.up, &camera.forward})
        *axis = glm::transpose(terrain->frame().axes()) * *axis;
      const double near_m = globe::render::near_distance(
          terrain->frame().ellipsoid(), frame.renderer().nearest_drawn(view.camera.position));
      DepthOfGround(camera, frame.target(), near_m).add_to(second, 0.2 * error_px, [&](Long x, Long y) {
        return plane_z(x / spacing - Long(posts.i0), y / spacing - Long(posts.j0), z);
      });
    }
    expect_agreement(reported, second, std::to_string(error_px) + " px");
  }
}

TEST_F(GlTest, EndlessGroundErrsByWhatTheDepthOfPicturesSays) {
  auto views = accuracy::judged_endless_views(kFlatPicture);
  if (!full()) views.resize(1);
  for (const double fine : full() ? std::vector{5.12, 10.24, 20.48} : std::vector{5.12}) {
    const fractal::TerrainSettings settings = accuracy::endless_ground(fractal::Rings{fine, 2.0 * fine});
    const double spacing = settings.ground.area_m / std::exp2(settings.ground.iterations);
    const accuracy::ErrorFigure reported = accuracy::displacement(settings, views, kFlatPicture);
    accuracy::EndlessFrame frame(lent(context()), settings, kFlatPicture);
    Second second;
    for (const accuracy::EndlessView& view : views) {
      frame.draw_ms(view);
      // Wider than what is there, from the source itself.
      constexpr int kHalf = 600, kPosts = 2 * kHalf + 1;
      const auto even = [](double posts) { return 2 * static_cast<int>(std::floor(posts / 2.0)); };
      const int west = even(view.eye.x) - kHalf, south = even(view.eye.y) - kHalf;
      std::vector<float> heights(std::size_t{kPosts} * kPosts);
      fractal::FractalSource(settings.ground).posts({west, south, kPosts, kPosts, 1}, heights);
      Camera camera = view.camera;
      camera.position = view.eye * dvec3(spacing, spacing, 1.0);
      const DepthOfGround shown(camera, frame.target(), accuracy::kEndlessNear_m);
      shown.add_to(second, 1.0, [&](Long x, Long y) {
        return plane_z(x / spacing - west, y / spacing - south, [&](int i, int j) {
          return Long(heights[static_cast<std::size_t>(j) * kPosts + static_cast<std::size_t>(i)]);
        });
      });
    }
    expect_agreement(reported, second, std::to_string(fine) + " blocks");
  }
}

TEST_F(GlTest, LeapsOfARegionsLevelsAreThoseOfTheTrianglesBeforeAndAfter) {
  const auto terrain = accuracy::judged_region();
  const auto walk = accuracy::walk_over(*terrain, kFlatPicture, full() ? accuracy::kWalked : 12);
  const int columns = terrain->posts().columns, rows = terrain->posts().rows;
  for (const flat::Morph morph : {flat::Morph::kOff, flat::Morph::kGpu}) {
    if (!full() && morph == flat::Morph::kGpu) continue;
    Second second;
    for (const accuracy::WalkStep& step : walk) {
      std::array<std::vector<double>, 2> z;
      for (std::size_t k = 0; k < 2; ++k) {
        const Camera& camera = k == 0 ? step.before : step.after;
        z[k] = surface_of(
            mesh_of(*terrain, flat::patch_levels(
                                  *terrain, terrain->frame().local_from_ecef(camera.position),
                                  flat::error_bound(1.0, camera.fov_y_deg, camera.aspect, kFlatPicture.height,
                                                    camera.forward * terrain->frame().axes()),
                                  morph)),
            columns, rows);
      }
      const Camera& camera = step.after;
      for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
          const auto k = static_cast<std::size_t>(2 * j * (2 * columns - 1) + 2 * i);
          const auto from_eye = [&](double height) {
            return terrain->frame().ecef_from_local({terrain->x_m(i), terrain->y_m(j), height}) -
                   camera.position;
          };
          const dvec3 now = from_eye(z[1][k]);
          const glm::dvec4 p = globe::render::clip_from_relative(camera, 1.0) * glm::dvec4(now, 1.0);
          if (p.w <= 0.0 || std::abs(p.x) > p.w || std::abs(p.y) > p.w) continue;
          second.add(pixels_apart(camera, now, from_eye(z[0][k])));
        }
      }
    }
    expect_agreement(accuracy::leaps(*terrain, morph, 1.0, kFlatPicture, walk), second,
                     morph == flat::Morph::kOff ? "off" : "on");
  }
}

TEST_F(GlTest, PostsOfAPlanetsPartErrByWhatGeographicLibsFrameSays) {
  const auto surface = views::builtin_planet();
  const accuracy::PlanetGround ground(surface);
  const double spacing = 5000.0 / 128;
  const auto region = ground.terrain(spacing);
  const globe::geo::Geodetic& origin = region->frame().origin();
  const GeographicLib::LocalCartesian frame(
      origin.lat_deg, origin.lon_deg, 0.0,
      GeographicLib::Geocentric(surface->ellipsoid().a, surface->ellipsoid().f));
  /// z over a place of the plane, until it moves no more.
  const auto ground_z = [&](double x, double y, int level) {
    double z = 0;
    for (int k = 0; k < 8; ++k) {
      globe::geo::Geodetic place;
      frame.Reverse(x, y, z, place.lat_deg, place.lon_deg, place.h_m);
      const Long height = std::max(
          second::ground(*surface, globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg), level),
          0.0L);
      z += static_cast<double>(height) - place.h_m;
    }
    return Long(z);
  };
  int level = 0;
  while (surface->root_edge() / std::exp2(level) > spacing) ++level;
  Second second;
  for (const dvec3& place : ground.places()) {
    const Long drawn = plane_z(place.x / spacing, place.y / spacing,
                               [&](int i, int j) { return ground_z(i * spacing, j * spacing, level); });
    second.add(drawn - ground_z(place.x, place.y, accuracy::PlanetGround::kFinest));
  }
  expect_agreement(ground.error(spacing), second, "39 m");
}

}  // namespace
