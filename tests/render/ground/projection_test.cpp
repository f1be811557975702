// H25: known places land on the pixel that geodesy says, from orbit to the ground. Where they ought to land
// is computed by GeographicLib alone.

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <random>

#include "app/accuracy/mesh_probe.h"
#include "globe/base/angles.h"
#include "globe/clipmap/morph.h"
#include "tests/hard/table.h"
#include "tests/render/ground/views.h"

namespace {

using app::accuracy::MeshProbe;
using app::accuracy::ProbeVertex;
using GeographicLib::Geocentric;
using GeographicLib::LocalCartesian;
using globe::kDegree;
using globe::geo::Ellipsoid;
using globe::geo::Geodetic;
using views::Camera;
using views::dvec3;
using views::Place;

constexpr int kViewWidth = 1280;
constexpr int kViewHeight = 720;
constexpr double kPixels = 0.5;

const std::vector<Place>& known_places() {
  static const std::vector<Place> places{{"Greenwich", 51.477928, 0},
                                         {"Quito", -0.180653, -78.467834},
                                         {"Fiji", -16.5, 180},
                                         {"Everest", 27.988056, 86.925},
                                         {"Ushuaia", -54.801912, -68.302951},
                                         {"Longyearbyen", 78.223, 15.626},
                                         {"Null Island", 0, 0},
                                         {"north pole", 90, 0},
                                         {"south pole", -90, 0},
                                         {"Singapore", 1.352083, 103.819836}};
  return places;
}

/// Where a camera stands and looks, told in degrees and metres.
struct Stand {
  Geodetic place;
  double heading_deg = 0, pitch_deg = 0, fov_deg = 60;
};

/// Pixels from the top left at which a place is seen, by geodesy; nothing behind the camera.
std::optional<glm::dvec2> geodetic_pixel(const Ellipsoid& ellipsoid, const Stand& stand, const Geodetic& of) {
  const Geocentric earth(ellipsoid.a, ellipsoid.f);
  const LocalCartesian local(stand.place.lat_deg, stand.place.lon_deg, stand.place.h_m, earth);
  dvec3 v;  // east, north, up
  local.Forward(of.lat_deg, of.lon_deg, of.h_m, v.x, v.y, v.z);
  const double h = stand.heading_deg * kDegree, p = stand.pitch_deg * kDegree;
  const dvec3 forward(std::sin(h) * std::cos(p), std::cos(h) * std::cos(p), std::sin(p));
  const dvec3 up(-std::sin(h) * std::sin(p), -std::cos(h) * std::sin(p), std::cos(p));
  const dvec3 right(std::cos(h), -std::sin(h), 0.0);
  const double depth = glm::dot(v, forward);
  if (depth <= 0.0) return std::nullopt;
  const double focal = 0.5 * kViewHeight / std::tan(0.5 * stand.fov_deg * kDegree);
  return glm::dvec2(0.5 * kViewWidth + focal * glm::dot(v, right) / depth,
                    0.5 * kViewHeight - focal * glm::dot(v, up) / depth);
}

/// A camera at a height above a place's ellipsoid, aside by a share of the height, that has the place in
/// view.
Stand stand_for(const Ellipsoid& ellipsoid, const Geodetic& place, double above_m, double aside,
                double off_x_deg, double off_y_deg, double direction_deg) {
  const Geocentric earth(ellipsoid.a, ellipsoid.f);
  const LocalCartesian around(place.lat_deg, place.lon_deg, place.h_m, earth);
  const double metres = aside * std::min(above_m, 0.3 * std::sqrt(2.0 * ellipsoid.a * above_m));
  Stand stand;
  double unused = 0;
  around.Reverse(metres * std::sin(direction_deg * kDegree), metres * std::cos(direction_deg * kDegree), 0.0,
                 stand.place.lat_deg, stand.place.lon_deg, unused);
  stand.place.h_m = place.h_m + above_m;
  const LocalCartesian local(stand.place.lat_deg, stand.place.lon_deg, stand.place.h_m, earth);
  dvec3 v;
  local.Forward(place.lat_deg, place.lon_deg, place.h_m, v.x, v.y, v.z);
  stand.heading_deg = std::atan2(v.x, v.y) / kDegree + off_x_deg;
  stand.pitch_deg = std::clamp(std::atan2(v.z, std::hypot(v.x, v.y)) / kDegree + off_y_deg, -90.0, 90.0);
  return stand;
}

Camera camera_of(const Ellipsoid& ellipsoid, const Stand& stand) {
  return globe::render::make_camera(ellipsoid, stand.place, stand.heading_deg, stand.pitch_deg, stand.fov_deg,
                                    static_cast<double>(kViewWidth) / kViewHeight);
}

dvec3 ecef(const Geocentric& earth, const Geodetic& place) {
  dvec3 p;
  earth.Forward(place.lat_deg, place.lon_deg, place.h_m, p.x, p.y, p.z);
  return p;
}

/// Where a place's ground was drawn: its height there and its pixel, from the GPU's own vertices.
struct Drawn {
  double height_m;
  glm::dvec2 pixel;
};

/// Looks for the place among triangles that are not morphed; nothing when another shows it.
std::optional<Drawn> drawn_place(const views::Surface& surface, const std::vector<ProbeVertex>& vertices,
                                 const Geodetic& place) {
  const Geocentric earth(surface.ellipsoid().a, surface.ellipsoid().f);
  const dvec3 foot = ecef(earth, {place.lat_deg, place.lon_deg, 0.0});
  const dvec3 u = (ecef(earth, {place.lat_deg, place.lon_deg, 1e4}) - foot) * 1e-4;
  for (std::size_t k = 0; k < vertices.size(); k += 3) {
    std::array<dvec3, 3> corner;
    bool near = true;
    for (std::size_t c = 0; c < 3 && near; ++c) {
      const auto& node = vertices[k + c].node;
      Geodetic at = globe::geo::degrees_from_normal(globe::planet::node_direction(node));
      near = glm::distance(globe::planet::node_direction(node), u) < 3.2 / (1 << node.level);
      if (!near) break;
      at.h_m = surface.drawn_height(surface.height(node));
      corner[c] = ecef(earth, at) - foot;
    }
    if (!near) continue;
    const dvec3 across = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double steepness = glm::dot(across, u);
    glm::dvec4 clip(0.0);
    bool inside = true;
    for (std::size_t c = 0; c < 3; ++c) {
      const double weight = glm::dot(u, glm::cross(corner[(c + 1) % 3], corner[(c + 2) % 3])) / steepness;
      inside = inside && weight >= 0.0;
      clip += weight * glm::dvec4(vertices[k + c].seen);
    }
    if (!inside) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      if (vertices[k + c].kind != globe::render::Kind::kPlain) return std::nullopt;
    }
    return Drawn{glm::dot(across, corner[0]) / steepness,
                 {0.5 * kViewWidth * (1.0 + clip.x / clip.w), 0.5 * kViewHeight * (1.0 - clip.y / clip.w)}};
  }
  return std::nullopt;
}

TEST_F(GlTest, H25KnownPlacesLandOnThePixelThatGeodesySays) {
  const auto surface = views::builtin_planet();
  const Ellipsoid& ellipsoid = surface->ellipsoid();
  const Ellipsoid sphere{ellipsoid.mean_radius(), 0.0};
  MeshProbe probe(surface, globe::clipmap::Settings::for_detail(16, 0));
  std::mt19937_64 random(251);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double worst = 0, worst_sphere = 0;
  std::size_t seen = 0;
  const std::size_t cameras = hard::full() ? 600 : 60;
  for (std::size_t k = 0; k < cameras; ++k) {
    const Place& known = known_places()[k % known_places().size()];
    Geodetic place{known.lat_deg, known.lon_deg, 0.0};
    place.h_m = surface->drawn_height(
        surface->height(globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg), 20));
    const double above =
        2.0 * std::pow(2e7, (static_cast<double>(k) + unit(random)) / static_cast<double>(cameras));
    const Stand stand =
        stand_for(ellipsoid, place, above, 0.1 + 2.0 * unit(random), 40.0 * (unit(random) - 0.5),
                  20.0 * (unit(random) - 0.5), 360.0 * unit(random));
    const Camera camera = camera_of(ellipsoid, stand);
    const int finest = globe::clipmap::finest_level(probe.settings(), surface->root_edge(), above, 26).level;
    probe.load(camera.position, finest);
    const auto drawn = drawn_place(*surface, probe.triangles(camera, 0.0f, MeshProbe::Space::kClip), place);
    if (!drawn) continue;
    place.h_m = drawn->height_m;
    const auto truth = geodetic_pixel(ellipsoid, stand, place);
    const auto wrong = geodetic_pixel(sphere, stand, place);
    if (!truth || truth->x < 0 || truth->y < 0 || truth->x > kViewWidth || truth->y > kViewHeight) continue;
    ++seen;
    worst = std::max(worst, glm::distance(*truth, drawn->pixel));
    if (wrong) worst_sphere = std::max(worst_sphere, glm::distance(*wrong, drawn->pixel));
  }
  hard::report("H25",
               "known places against the pixel that geodesy says, 2 m to 4e7 m, " + std::to_string(seen),
               "0.5 px", hard::figure(worst) + " px");
  hard::report("H25", "negative control: geodesy on a sphere", "> 0.5 px",
               hard::figure(worst_sphere) + " px");
  EXPECT_LE(worst, kPixels);
  EXPECT_GT(seen, cameras / 6);
  EXPECT_GT(worst_sphere, kPixels);
}

}  // namespace
