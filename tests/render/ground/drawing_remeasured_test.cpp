// What `globe accuracy` reports of places of vertices, details, samples and domes, measured again by other
// means: they agree to 5 %.

#include <epoxy/gl.h>
#include <tbb/parallel_for.h>

#include <GeographicLib/Geocentric.hpp>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "app/accuracy/drawing_quality.h"
#include "app/accuracy/mesh_probe.h"
#include "app/accuracy/position_error.h"
#include "app/accuracy/repeated_frame.h"
#include "app/accuracy/samples.h"
#include "globe/clipmap/ground_below.h"
#include "globe/clipmap/morph.h"
#include "globe/render/wide_view.h"
#include "tests/render/ground/views.h"
#include "tests/second_method.h"

namespace {

namespace accuracy = app::accuracy;
using accuracy::MeshProbe;
using globe::clipmap::Settings;
using globe::planet::Node;
using globe::planet::Surface;
using globe::render::Camera;
using second::Long;
using second::Second;
using second::Vec;
using views::dvec3;

accuracy::Scope scope_in(globe::gl::Context& context) {
  return {false, {&context, [](globe::gl::Context*) {}}, views::builtin_planet()};
}

/// The triangles that the GPU makes of the whole ground, from the camera.
struct Mesh {
  std::vector<accuracy::ProbeVertex> corners;

  struct Hit {
    double distance;
    int level;
  };
  /// The nearest triangle that faces the camera, by the volumes that a direction makes with its sides.
  std::optional<Hit> first_hit(const dvec3& direction) const {
    std::optional<Hit> nearest;
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      const dvec3 a(corners[k].seen), b(corners[k + 1].seen), c(corners[k + 2].seen);
      const double u = glm::dot(direction, glm::cross(c, b)), v = glm::dot(direction, glm::cross(a, c)),
                   w = glm::dot(direction, glm::cross(b, a));
      if (u < 0.0 || v < 0.0 || w < 0.0 || u + v + w <= 0.0) continue;
      const double distance = glm::dot(direction, (u * a + v * b + w * c) / (u + v + w));
      if (distance > 0.0 && (!nearest || distance < nearest->distance))
        nearest = Hit{distance, corners[k].node.level};
    }
    return nearest;
  }
};

/// All that a view is drawn with, as the renderer decides it.
Mesh mesh_of(MeshProbe& probe, const Camera& camera) {
  const auto surface = views::builtin_planet();
  const double above =
      std::max(globe::clipmap::height_above_ground(probe.settings(), *surface, camera.position, 26, true),
               globe::clipmap::least_above_ground(surface->ellipsoid()));
  const auto finest = globe::clipmap::finest_level(probe.settings(), surface->root_edge(), above, 26);
  probe.load(camera.position, finest.level);
  return {probe.triangles(camera, finest.fade, MeshProbe::Space::kRelative)};
}

/// Pixels between the drawn point and the finest ground above or below it, in long double.
Long pixels_off(const Camera& camera, const accuracy::PictureSize& picture, const dvec3& relative,
                int level) {
  const auto surface = views::builtin_planet();
  const GeographicLib::Geocentric earth(surface->ellipsoid().a, surface->ellipsoid().f);
  const dvec3 drawn = camera.position + relative;
  globe::geo::Geodetic place;
  earth.Reverse(drawn.x, drawn.y, drawn.z, place.lat_deg, place.lon_deg, place.h_m);
  const double pixel_m = glm::length(relative) * 2.0 * camera.tan_y() / picture.height;
  int finest = level;
  while (finest < 26 && surface->root_edge() / std::exp2(finest) > pixel_m / 8.0) ++finest;
  const Long height = std::max(
      second::ground(*surface, globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg), finest), 0.0L);
  double x = 0, y = 0, z = 0;
  earth.Forward(place.lat_deg, place.lon_deg, static_cast<double>(height), x, y, z);
  const auto on_screen = [&](const dvec3& from_camera) {
    const Vec p = second::to_long(from_camera);
    const Long ahead = second::dot(p, second::to_long(camera.forward));
    return std::array<Long, 2>{
        second::dot(p, second::to_long(camera.right)) / (ahead * camera.tan_x()) * picture.width / 2,
        second::dot(p, second::to_long(camera.up)) / (ahead * camera.tan_y()) * picture.height / 2};
  };
  const auto a = on_screen(relative), b = on_screen(dvec3(x, y, z) - camera.position);
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

TEST_F(GlTest, DetailErrsByWhatRaysThroughTheTrianglesOfTheGpuSay) {
  const int rows = std::getenv("GLOBE_TEST_FULL") != nullptr ? 9 : 4;
  const accuracy::PictureSize picture;
  const auto surface = views::builtin_planet();
  std::vector<Settings> settings{Settings::for_detail(16)};
  if (std::getenv("GLOBE_TEST_FULL") != nullptr)
    settings.insert(settings.end(), {Settings::for_detail(64), Settings::for_detail(128)});
  const auto reported = accuracy::drawn_errors(settings, surface, picture, rows);
  const auto views = accuracy::judged_views(*surface, picture);
  const auto rays = accuracy::judged_rays(views.size(), picture, rows);
  for (std::size_t k = 0; k < settings.size(); ++k) {
    Settings plain = settings[k];
    plain.shading_levels = 0;
    MeshProbe probe(surface, plain);
    Second second;
    for (std::size_t v = 0; v < views.size(); ++v) {
      const Camera& camera = views[v].camera;
      const Mesh mesh = mesh_of(probe, camera);
      std::vector<Long> errors(rays[v].size(), -1.0L);
      tbb::parallel_for(std::size_t{0}, errors.size(), [&](std::size_t r) {
        const dvec3 direction =
            glm::normalize(camera.forward + camera.right * ((2.0 * rays[v][r].x - 1.0) * camera.tan_x()) -
                           camera.up * ((2.0 * rays[v][r].y - 1.0) * camera.tan_y()));
        if (const auto hit = mesh.first_hit(direction))
          errors[r] = pixels_off(camera, picture, direction * hit->distance, hit->level);
      });
      for (const Long error : errors)
        if (error >= 0.0L) second.add(error);
    }
    expect_agreement(reported[k], second, "s = " + std::to_string(settings[k].s));
  }
}

/// The ground of a level as patches between knots have it, in long double: each triangle of `step` cells a
/// side spans chords between the points of the ellipsoid at its corners, or a parabola through those in the
/// middle of its edges, too; heights go along the mean of the corners' normals.
class PatchGround {
 public:
  PatchGround(const Surface& surface, int step, bool parabola)
      : surface_(surface),
        earth_(surface.ellipsoid().a, surface.ellipsoid().f),
        step_(step),
        parabola_(parabola) {}

  /// Where a node should stand, ECEF metres.
  Vec truth(const Node& node) const {
    return on_ellipsoid(node, surface_.drawn_height(surface_.height(node)));
  }
  /// Where its patch puts it.
  Vec drawn(const Node& node) const {
    const int most = globe::planet::nodes_per_side(node.level) - step_;
    const int west = std::min(node.i / step_ * step_, most), south = std::min(node.j / step_ * step_, most);
    const int a = node.i - west, b = node.j - south;
    std::array<Node, 3> corners{{{node.d, node.level, west, south},
                                 {node.d, node.level, west + step_, south},
                                 {node.d, node.level, west, south + step_}}};
    std::array<Long, 3> shares{1.0L - Long(a + b) / step_, Long(a) / step_, Long(b) / step_};
    if (a + b > step_) {
      corners[0] = {node.d, node.level, west + step_, south + step_};
      shares = {Long(a + b) / step_ - 1.0L, 1.0L - Long(b) / step_, 1.0L - Long(a) / step_};
    }
    const Long height = surface_.drawn_height(surface_.height(node));
    Vec result{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec point = on_ellipsoid(corners[k], 0.0),
                normal = second::to_long(globe::planet::node_direction(corners[k]));
      for (std::size_t axis = 0; axis < 3; ++axis)
        result[axis] += shares[k] * (point[axis] + height * normal[axis]);
      if (!parabola_) continue;
      const Node &next = corners[(k + 1) % 3], &last = corners[(k + 2) % 3];
      const Vec middle =
                    on_ellipsoid({node.d, node.level, (next.i + last.i) / 2, (next.j + last.j) / 2}, 0.0),
                from = on_ellipsoid(next, 0.0), to = on_ellipsoid(last, 0.0);
      for (std::size_t axis = 0; axis < 3; ++axis)
        result[axis] += 4.0L * shares[(k + 1) % 3] * shares[(k + 2) % 3] *
                        (middle[axis] - (from[axis] + to[axis]) / 2.0L);
    }
    return result;
  }

 private:
  Vec on_ellipsoid(const Node& node, double height) const {
    const auto place = second::place_of(globe::planet::node_direction(node));
    double x = 0, y = 0, z = 0;
    earth_.Forward(place.lat_deg, place.lon_deg, height, x, y, z);
    return {x, y, z};
  }

  const Surface& surface_;
  GeographicLib::Geocentric earth_;
  int step_;
  bool parabola_;
};

/// Where a drawn vertex stands by what gives its nodes' places: halfway into the next level as far as it is.
template <typename Place>
Vec vertex_by(const MeshProbe& probe, const accuracy::ProbeVertex& vertex, const Place& place) {
  const Node& node = vertex.node;
  const Vec own = place(vertex.on_rim ? Node{node.d, node.level - 1, node.i / 2, node.j / 2} : node);
  if (vertex.on_rim || node.level == probe.settings().base_level || (node.i % 2 == 0 && node.j % 2 == 0))
    return own;
  const auto at = globe::clipmap::nadir(probe.state().target.u, node.level);
  const Long share = static_cast<Long>(globe::clipmap::morph_factor(
      globe::clipmap::morph_band(probe.settings()),
      globe::clipmap::hex_distance(globe::clipmap::images(at, node.d),
                                   {node.i * globe::clipmap::kSubcell, node.j * globe::clipmap::kSubcell})));
  // The edge it halves: along i, along j, or, where both are odd, across.
  const int di = node.i % 2, dj = node.i % 2 != 0 && node.j % 2 != 0 ? -1 : node.j % 2;
  const Vec from = place({node.d, node.level, node.i - di, node.j - dj}),
            to = place({node.d, node.level, node.i + di, node.j + dj});
  Vec result{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    result[axis] = (1.0L - share) * own[axis] + share * (from[axis] + to[axis]) / 2.0L;
  return result;
}

TEST_F(GlTest, ChordsAndParabolasErrByWhatTheirFormulasSay) {
  using globe::clipmap::Positions;
  const auto surface = views::builtin_planet();
  for (const Positions positions : {Positions::kChord, Positions::kQuadratic}) {
    const Settings settings = accuracy::position_settings(positions);
    const PatchGround ground(*surface, settings.m, positions == Positions::kQuadratic);
    MeshProbe probe(surface, settings);
    for (const accuracy::PositionHeight& height : accuracy::position_heights()) {
      if (positions == Positions::kQuadratic && height.above_m < 1e6) continue;  // fp32 errs by more
      if (std::getenv("GLOBE_TEST_FULL") == nullptr && height.above_m < 1e4) continue;
      accuracy::ErrorSum reported;
      Second second;
      for (const auto& place : accuracy::position_places({})) {
        const Camera camera = accuracy::position_camera(*surface, place, height);
        const auto on_screen = [&](const Vec& at) {
          Vec p{};
          for (std::size_t axis = 0; axis < 3; ++axis)
            p[axis] = at[axis] - second::to_long(camera.position)[axis];
          const Long ahead = second::dot(p, second::to_long(camera.forward));
          return std::array<Long, 2>{
              second::dot(p, second::to_long(camera.right)) / (ahead * camera.tan_x()) * 640.0L,
              second::dot(p, second::to_long(camera.up)) / (ahead * camera.tan_y()) * 360.0L};
        };
        accuracy::see_vertices(
            *surface, probe, camera, height.above_m, accuracy::kPositionVertices,
            [&](const accuracy::Sighting& seen) {
              if (accuracy::is_hidden(*surface, camera, seen.truth)) return;
              reported.add(seen.off_px, [] { return std::string(); });
              const auto truth = on_screen(vertex_by(probe, seen.vertex,
                                                     [&](const Node&node) { return ground.truth(node); })),
                         drawn = on_screen(vertex_by(probe, seen.vertex,
                                                     [&](const Node&node) { return ground.drawn(node); }));
              second.add(std::hypot(truth[0] - drawn[0], truth[1] - drawn[1]));
            });
      }
      expect_agreement(reported.figure(), second,
                       std::string(globe::clipmap::name_of(positions)) + " from " + height.words);
    }
  }
}

/// The share of a pixel's area on the drawn side of an edge: of a square whose corner the line's half-plane
/// cuts off, less what of it lies outside.
Long share_of_pixel(const accuracy::Edge& edge, int x, int y) {
  const Long a = std::abs(Long(edge.normal.x)), b = std::abs(Long(edge.normal.y));
  // From the corner that is drawn first, both axes toward the line.
  constexpr int kHalf = accuracy::kEdgeSide / 2;
  const Long corner_x = x - kHalf + (edge.normal.x < 0 ? 1 : 0),
             corner_y = y - kHalf + (edge.normal.y < 0 ? 1 : 0);
  const Long d = edge.offset - (corner_x * edge.normal.x + corner_y * edge.normal.y);
  const auto half_square = [](Long t) { return t > 0.0L ? t * t / 2.0L : 0.0L; };
  return (half_square(d) - half_square(d - a) - half_square(d - b) + half_square(d - a - b)) / (a * b);
}

TEST_F(GlTest, SamplesErrByWhatTheirPlacesInThePixelSay) {
  const std::vector<accuracy::Study> studies = accuracy::sample_studies(scope_in(context()));
  for (const accuracy::Setting& setting : studies.front().settings) {
    const int samples = std::stoi(setting.name);
    globe::gl::FramebufferFormat format;
    format.samples = samples;
    const globe::gl::Framebuffer target(8, 8, format);
    target.bind();
    std::vector<std::array<float, 2>> places(static_cast<std::size_t>(samples), {0.5f, 0.5f});
    for (int s = 0; samples > 1 && s < samples; ++s)
      glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(s),
                         places[static_cast<std::size_t>(s)].data());
    Second second;
    for (const accuracy::Edge& edge : accuracy::sample_edges()) {
      for (int y = 0; y < accuracy::kEdgeSide; ++y) {
        for (int x = 0; x < accuracy::kEdgeSide; ++x) {
          const Long share = share_of_pixel(edge, x, y);
          if (share <= 1e-12L || share >= 1.0L - 1e-12L) continue;
          int drawn = 0;
          for (const auto& place : places) {
            constexpr int kHalf = accuracy::kEdgeSide / 2;
            const dvec3 at(x - kHalf + double(place[0]), y - kHalf + double(place[1]), 0.0);
            drawn += at.x * edge.normal.x + at.y * edge.normal.y < edge.offset ? 1 : 0;
          }
          second.add(100.0L * (Long(drawn) / samples - share));
        }
      }
    }
    expect_agreement(setting.error, second, setting.name + " samples");
  }
}

constexpr int kDomeSide = 512,
              kRaysAcross = 6;  ///< pixels of a dome's picture, and rays in one of them, a side

/// Colours seen from a place, by five pictures of a pinhole camera 90 degrees wide, the middle one ahead.
class Pictures {
 public:
  Pictures(const Camera& camera, const dvec3& sun) : camera_(camera) {
    globe::gl::Framebuffer target(kSide, kSide);
    globe::render::GlobeRenderer renderer(views::builtin_planet(), {});
    for (std::size_t k = 0; k < kTurns.size(); ++k) {
      Camera turned = camera;
      turned.aspect = 1.0;
      turned.fov_y_deg = 90.0;
      turned.right = in_space(kTurns[k][0]);
      turned.up = in_space(kTurns[k][1]);
      turned.forward = in_space(kTurns[k][2]);
      renderer.draw(turned, sun, true, target);
      pictures_[k] = target.read_rgba8();
    }
  }

  /// Along a direction, x to the right, y up, z ahead; not averaged.
  std::array<Long, 3> at(const dvec3& direction) const {
    std::size_t best = 0;
    for (std::size_t k = 1; k < kTurns.size(); ++k)
      if (glm::dot(kTurns[k][2], direction) > glm::dot(kTurns[best][2], direction)) best = k;
    const auto& [right, up, forward] = kTurns[best];
    const double ahead = glm::dot(forward, direction);
    const auto texel = [](double at) {
      return std::min(static_cast<int>((at * 0.5 + 0.5) * kSide), kSide - 1);
    };
    const int x = texel(glm::dot(right, direction) / ahead), y = texel(-glm::dot(up, direction) / ahead);
    const std::uint8_t* color = &pictures_[best][4 * static_cast<std::size_t>(y * kSide + x)];
    return {Long(color[0]), Long(color[1]), Long(color[2])};
  }

 private:
  static constexpr int kSide = 2600;
  static constexpr std::array<std::array<dvec3, 3>, 5> kTurns{
      {{dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)},
       {dvec3(0, 0, -1), dvec3(0, 1, 0), dvec3(1, 0, 0)},
       {dvec3(0, 0, 1), dvec3(0, 1, 0), dvec3(-1, 0, 0)},
       {dvec3(1, 0, 0), dvec3(0, 0, -1), dvec3(0, 1, 0)},
       {dvec3(1, 0, 0), dvec3(0, 0, 1), dvec3(0, -1, 0)}}};

  dvec3 in_space(const dvec3& v) const {
    return camera_.right * v.x + camera_.up * v.y + camera_.forward * v.z;
  }

  Camera camera_;
  std::array<std::vector<std::uint8_t>, kTurns.size()> pictures_;
};

TEST_F(GlTest, DomesErrByWhatPicturesOfAPinholeCameraSay) {
  if (std::getenv("GLOBE_TEST_FULL") == nullptr) GTEST_SKIP() << "a dozen seconds: GLOBE_TEST_FULL=1";
  const auto surface = views::builtin_planet();
  const Camera camera = accuracy::judged_views(*surface, {})[3].camera;
  const dvec3 sun = accuracy::sun_over(*surface, camera);
  std::vector<std::array<Long, 3>> truth(std::size_t{kDomeSide} * kDomeSide);
  {
    const Pictures pictures(camera, sun);
    tbb::parallel_for(std::size_t{0}, truth.size(), [&](std::size_t k) {
      for (int part = 0; part < kRaysAcross * kRaysAcross; ++part) {
        const auto place = [](std::size_t pixel, int of) {
          return (static_cast<double>(pixel) + (of + 0.5) / kRaysAcross) * 2.0 / kDomeSide - 1.0;
        };
        const double x = place(k % kDomeSide, part % kRaysAcross);
        const double y = -place(k / kDomeSide, part / kRaysAcross);
        const double radius = std::hypot(x, y);
        const double turn = radius * std::numbers::pi / 2.0;
        if (radius > 1.0) continue;  // black
        const auto color =
            pictures.at({x / radius * std::sin(turn), y / radius * std::sin(turn), std::cos(turn)});
        for (std::size_t c = 0; c < 3; ++c) truth[k][c] += color[c] / (kRaysAcross * kRaysAcross);
      }
    });
  }
  globe::render::GlobeRenderer renderer(surface, {});
  const globe::gl::Framebuffer target(kDomeSide, kDomeSide);
  const std::vector<accuracy::Study> studies = accuracy::dome_studies(scope_in(context()));
  for (const accuracy::Setting& setting : studies.front().settings) {
    globe::render::WideView view(
        {globe::render::Projection::kFisheye, kDomeSide, kDomeSide, 180.0, 1, std::stoi(setting.name)});
    view.draw(renderer, camera, sun, true, target);
    const std::vector<std::uint8_t> drawn = target.read_rgba8();
    Second second;
    for (std::size_t k = 0; k < truth.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c) second.add(drawn[4 * k + c] - truth[k][c]);
    expect_agreement(setting.error, second, setting.name);
  }
}

}  // namespace
