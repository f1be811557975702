#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <random>

#include "app/accuracy/air_reference.h"
#include "app/accuracy/drawing_quality.h"
#include "app/accuracy/remade.h"
#include "app/accuracy/repeated_frame.h"
#include "app/accuracy/study.h"
#include "globe/render/air.h"

namespace app::accuracy {
namespace {

namespace render = globe::render;
using glm::dvec3;

constexpr double kGround = 6371.0;  ///< km
constexpr double kTop = kGround + 80.0;
constexpr double kDark = 2e-3;  ///< of sunlight: a hundredth of the screen's white
constexpr std::array kSuns{60.0, 20.0, 5.0, 0.5, -2.0, -6.0};  ///< degrees above the horizon of a level eye
constexpr render::AirSteps kDefaultSteps;

/// A ray and words for it.
struct AirCase {
  std::string name;
  ReferenceRay ray;
};

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

dvec3 unit_vector(double elevation_deg, double azimuth_deg) {
  const double e = radians(elevation_deg), a = radians(azimuth_deg);
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

std::string text_of(double eye_km, double sun_deg, const char* what, double value, double azimuth_deg) {
  char text[120];
  std::snprintf(text, sizeof text, "eye at %.4g km, sun %.3g deg high, %s %.3g, %.3g deg from the sun",
                eye_km, sun_deg, what, value, azimuth_deg);
  return text;
}

/// The ray as far as there is air, as shaders/sky_map.frag has it.
ReferenceRay through_air(const dvec3& eye, const dvec3& toward, const dvec3& sun) {
  const double along = glm::dot(eye, toward);
  const dvec3 nearest = eye - toward * along;
  const double half_chord = std::sqrt(std::max(kTop * kTop - glm::dot(nearest, nearest), 0.0));
  return {eye, toward, std::max(-along - half_chord, 0.0), std::max(-along + half_chord, 0.0), sun, kGround};
}

/// Looks at the sky from the ground, the air and space, from noon to nautical twilight; at the limb by its
/// height above ground.
std::vector<AirCase> sky_cases() {
  std::vector<AirCase> cases;
  for (const double eye_km : {0.002, 3.0, 12.0, 400.0}) {
    const dvec3 eye(0.0, 0.0, kGround + eye_km);
    for (const double sun_deg : kSuns) {
      for (const double azimuth_deg : {0.0, 90.0, 180.0}) {
        for (const double value :
             eye_km > 80.0 ? std::vector{3.0, 15.0, 40.0} : std::vector{90.0, 30.0, 5.0, 1.0, 0.1}) {
          const double elevation =
              eye_km > 80.0 ? -std::acos((kGround + value) / eye.z) * 180.0 / std::numbers::pi : value;
          cases.push_back(
              {text_of(eye_km, sun_deg, eye_km > 80.0 ? "limb, km" : "look, deg", value, azimuth_deg),
               through_air(eye, unit_vector(elevation, azimuth_deg), unit_vector(sun_deg, 0.0))});
        }
      }
    }
  }
  return cases;
}

/// Looks at the ground, from the ground's own level to space, from where the terminator is in view by night,
/// too.
std::vector<AirCase> haze_cases() {
  std::vector<AirCase> cases;
  for (const double eye_km : {0.002, 1.0, 12.0, 100.0, 400.0, 2000.0, 20000.0}) {
    const dvec3 eye(0.0, 0.0, kGround + eye_km);
    std::vector<double> suns(kSuns.begin(), kSuns.end());
    if (eye_km > 80.0) suns.insert(suns.end(), {-12.0, -30.0, -60.0});
    for (const double sun_deg : suns) {
      for (const double azimuth_deg : {0.0, 90.0, 180.0}) {
        for (const double away_km : {3.0, 20.0, 100.0, 300.0, 1000.0, 3000.0, 6000.0}) {
          const double turn = away_km / kGround;
          if (std::cos(turn) * eye.z <= kGround) continue;  // beyond the horizon
          const double a = radians(azimuth_deg);
          const dvec3 ground =
              kGround * dvec3(std::sin(turn) * std::cos(a), std::sin(turn) * std::sin(a), std::cos(turn));
          ReferenceRay ray = through_air(eye, glm::normalize(ground - eye), unit_vector(sun_deg, 0.0));
          ray.to = glm::length(ground - eye);
          cases.push_back({text_of(eye_km, sun_deg, "ground, km", away_km, azimuth_deg), ray});
        }
      }
    }
  }
  return cases;
}

render::AirRay as_drawn(const ReferenceRay& ray) {
  return {glm::vec3(ray.eye),         glm::vec3(ray.direction), static_cast<float>(ray.from),
          static_cast<float>(ray.to), glm::vec3(ray.sun),       static_cast<float>(ray.ground)};
}

double largest(const dvec3& light) { return std::max({light.x, light.y, light.z}); }

void add_error(ErrorSum& sum, const dvec3& light, const dvec3& truth, const std::string& place) {
  const double brightness = std::max(largest(truth), kDark);
  sum.add(100.0 * largest(glm::abs(light - truth)) / brightness, [&] { return place; });
}

Study study_of(const std::string& name, const std::string& title, const std::string& reference,
               std::size_t cases, const std::string& cost_unit) {
  return {"sky." + name,
          title,
          "",
          reference,
          std::to_string(cases) +
              " rays from 2 m to 400 km up, suns from 60 degrees above the horizon to 6 below, the limb " +
              "among them; of light darker than a hundredth of white, percent of that",
          "% of the brightest channel",
          cost_unit,
          {}};
}

/// Frames with one part of the air's steps changed.
class Frames {
 public:
  Frames(const Scope& scope, bool upward)
      : context_(scope.context),
        surface_(scope.planet),
        camera_(judged_views(*surface_, kPicture)[upward ? 4 : 3].camera),
        // Upward no ground is in view, and in 64x36 pixels nothing finer than triangles: no need to keep it.
        clipmap_(globe::clipmap::Settings::for_detail(upward ? 16 : 64, 0)) {
    if (!upward) return;
    const auto place = globe::geo::geodetic_from_ecef(surface_->ellipsoid(), camera_.position);
    camera_ = render::make_camera(surface_->ellipsoid(), place, 90.0, 40.0, kPicture.fov_y_deg, 16.0 / 9.0);
  }

  Setting setting(const std::string& name, const ErrorFigure& error, const render::AirSteps& air, int width,
                  int height, bool is_default) const {
    render::RenderSettings ground;
    ground.clipmap = clipmap_;
    ground.air = air;
    const auto frame = remade<RepeatedFrame>(context_, surface_, ground, width, height);
    const auto cost = [frame, camera = camera_, sun = sun_over(*surface_, camera_)] {
      return frame->get().draw_ms(camera, sun);
    };
    return {name, error, cost, is_default, {}, release_of(frame)};
  }

 private:
  std::shared_ptr<globe::gl::Context> context_;
  std::shared_ptr<const globe::planet::Surface> surface_;
  render::Camera camera_;
  globe::clipmap::Settings clipmap_;
};

Study step_study(const Frames& frames) {
  const auto cases = sky_cases();
  Study study = study_of("steps", "Samples of the air along a look at the sky",
                         "the same columns and Mie colours, integrated along the ray in double", cases.size(),
                         "ms a frame of sky, 1280x720");
  std::vector<dvec3> truth;
  for (const AirCase& each : cases) truth.push_back(sky_parts(Columns::kApproximate, each.ray).tinted_sum());
  for (const int steps : {8, 16, 32, 64}) {
    ErrorSum sum;
    for (std::size_t k = 0; k < cases.size(); ++k)
      add_error(sum, render::sky_light(as_drawn(cases[k].ray), steps), truth[k], cases[k].name);
    render::AirSteps air;
    air.sky = steps;
    study.settings.push_back(frames.setting(std::to_string(steps) + " steps", sum.figure(), air,
                                            kPicture.width, kPicture.height, steps == kDefaultSteps.sky));
  }
  return study;
}

Study model_study() {
  const auto cases = std::make_shared<const std::vector<AirCase>>(sky_cases());
  Study study = study_of("model", "Light of the sky: what each approximation costs in truth",
                         "columns toward the sun and rays integrated in double, Mie light in its own colours",
                         cases->size(), "us a ray on one core");
  using Light = dvec3 (*)(const ReferenceRay&);
  const std::array<std::pair<const char*, Light>, 5> ways{
      {{"as drawn",
        [](const ReferenceRay& ray) { return dvec3(render::sky_light(as_drawn(ray), kDefaultSteps.sky)); }},
       {"rays integrated",
        [](const ReferenceRay& ray) { return sky_parts(Columns::kApproximate, ray).tinted_sum(); }},
       {"rays integrated, Mie colours",
        [](const ReferenceRay& ray) { return sky_parts(Columns::kApproximate, ray).sum(); }},
       {"rays, columns integrated",
        [](const ReferenceRay& ray) { return sky_parts(Columns::kIntegrated, ray).tinted_sum(); }},
       {"rays, columns, Mie colours",
        [](const ReferenceRay& ray) { return sky_parts(Columns::kIntegrated, ray).sum(); }}}};
  std::vector<dvec3> truth;
  for (const AirCase& each : *cases) truth.push_back(sky_parts(Columns::kIntegrated, each.ray).sum());
  for (const auto& way : ways) {
    const Light light = way.second;
    ErrorSum sum;
    for (std::size_t k = 0; k < cases->size(); ++k)
      add_error(sum, light((*cases)[k].ray), truth[k], (*cases)[k].name);
    constexpr std::size_t kTimed = 2;
    study.settings.push_back({way.first, sum.figure(),
                              timed(
                                  kTimed,
                                  [cases, light] {
                                    for (std::size_t k = 0; k < kTimed; ++k)
                                      keep(light((*cases)[k * 37 % cases->size()].ray).x);
                                  },
                                  1e3),
                              study.settings.empty()});
  }
  return study;
}

Study column_study() {
  Study study{
      "sky.columns",
      "Column of air toward the sun",
      "",
      "the column integrated in double",
      "700 points, 0 to 60 km high, sun from the zenith to 6 degrees below the horizon; both kinds of air",
      "% of sunlight that gets through, blue",
      "ns a column",
      {}};
  struct Point {
    double height, cos_zenith;
  };
  auto points = std::make_shared<std::vector<Point>>();
  for (int h = 0; h < 20; ++h) {
    for (int z = 0; z < 35; ++z)
      points->push_back({60.0 * h * h / 361.0, std::sin(radians(90.0 - 96.0 * std::sqrt(z / 34.0)))});
  }
  const auto through = [](double rayleigh, double mie) {
    return std::exp(-(33.1e-3 * rayleigh + 3.4e-3 * mie));
  };
  using Column = double (*)(const Point&, double);
  const std::array<std::pair<const char*, Column>, 3> ways{
      {{"level air",
        [](const Point& p, double scale) {
          return scale * std::exp(-p.height / scale) / std::max(p.cos_zenith, 1e-3);
        }},
       {"Schueler's formula",
        [](const Point& p, double scale) {
          return static_cast<double>(
              render::air_column(static_cast<float>(p.height), static_cast<float>(p.cos_zenith),
                                 static_cast<float>(kGround), static_cast<float>(scale)));
        }},
       {"integrated", [](const Point& p, double scale) {
          return air_column(Columns::kIntegrated, p.height, p.cos_zenith, kGround, scale);
        }}}};
  for (const auto& way : ways) {
    const Column column = way.second;
    ErrorSum sum;
    for (const Point& p : *points) {
      const double truth = through(ways[2].second(p, 8.0), ways[2].second(p, 1.2));
      sum.add(100.0 * (through(column(p, 8.0), column(p, 1.2)) - truth), [&] {
        char text[64];
        std::snprintf(text, sizeof text, "%.3g km high, sun's cosine %.4g", p.height, p.cos_zenith);
        return std::string(text);
      });
    }
    study.settings.push_back({way.first, sum.figure(),
                              timed(static_cast<double>(points->size()),
                                    [points, column] {
                                      double all = 0;
                                      for (const Point& p : *points) all += column(p, 8.0);
                                      keep(all);
                                    }),
                              column == ways[1].second});
  }
  return study;
}

/// The sky's map of an eye and a sun, as shaders/sky_map.frag fills it and shaders/sky.frag looks it up.
class SkyMap {
 public:
  SkyMap(const glm::ivec2& size, const dvec3& eye, const dvec3& sun)
      : size_(size), radius_(static_cast<float>(eye.z)) {
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        const glm::vec2 place = glm::vec2(x, y) / glm::vec2(size - 1);
        const glm::vec4 texel = render::sky_texel(
            as_drawn(through_air(eye, toward(render::sky_map_cosines(place, radius_, float(kGround))), sun)),
            kDefaultSteps.sky);
        texels_.push_back(glm::unpackHalf(glm::packHalf(texel)));
      }
    }
  }

  /// Of a ray by the cosines of its azimuth and zenith angle.
  static dvec3 toward(const glm::dvec2& cosines) {
    const double sin_zenith = std::sqrt(std::max(1.0 - cosines.y * cosines.y, 0.0));
    return {cosines.x * sin_zenith, std::sqrt(std::max(1.0 - cosines.x * cosines.x, 0.0)) * sin_zenith,
            cosines.y};
  }

  glm::vec4 at(const glm::dvec2& cosines) const {
    const glm::vec2 place =
        render::sky_map_place(glm::vec2(cosines), radius_, float(kGround)) * glm::vec2(size_ - 1);
    const glm::ivec2 corner = glm::clamp(glm::ivec2(place), glm::ivec2(0), size_ - 2);
    const glm::vec2 t = place - glm::vec2(corner);
    return glm::mix(glm::mix(texel(corner.x, corner.y), texel(corner.x + 1, corner.y), t.x),
                    glm::mix(texel(corner.x, corner.y + 1), texel(corner.x + 1, corner.y + 1), t.x), t.y);
  }

 private:
  const glm::vec4& texel(int x, int y) const { return texels_[static_cast<std::size_t>(y * size_.x + x)]; }

  glm::ivec2 size_;
  float radius_;
  std::vector<glm::vec4> texels_;
};

Study map_study(const Frames& frames) {
  constexpr int kRays = 400;
  Study study =
      study_of("map", "Texels of the sky's map", "the same samples of the air, taken for the ray itself",
               4 * kSuns.size() * kRays, "ms a frame of sky, 1280x720");
  for (const glm::ivec2& size :
       {glm::ivec2(32, 32), glm::ivec2(32, 128), glm::ivec2(96, 64), glm::ivec2(192, 256)}) {
    ErrorSum sum;
    std::mt19937_64 random(41);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const double eye_km : {0.002, 3.0, 12.0, 400.0}) {
      const dvec3 eye(0.0, 0.0, kGround + eye_km);
      for (const double sun_deg : kSuns) {
        const dvec3 sun = unit_vector(sun_deg, 0.0);
        const SkyMap map(size, eye, sun);
        for (int k = 0; k < kRays; ++k) {
          // Spread evenly over the map, so that as many lie by the horizon as the map has rows there.
          const glm::vec2 place(static_cast<float>(unit(random)), static_cast<float>(unit(random)));
          const glm::dvec2 cosines(render::sky_map_cosines(place, float(eye.z), float(kGround)));
          const ReferenceRay ray = through_air(eye, SkyMap::toward(cosines), sun);
          const auto cos_angle = static_cast<float>(glm::dot(ray.direction, sun));
          add_error(sum, render::with_mie(map.at(cosines), cos_angle),
                    render::sky_light(as_drawn(ray), kDefaultSteps.sky),
                    text_of(eye_km, sun_deg, "look's cosine", cosines.y,
                            std::acos(cosines.x) * 180.0 / std::numbers::pi));
        }
      }
    }
    render::AirSteps air;
    air.map = size;
    study.settings.push_back(frames.setting(std::to_string(size.x) + " x " + std::to_string(size.y),
                                            sum.figure(), air, kPicture.width, kPicture.height,
                                            size == kDefaultSteps.map));
  }
  return study;
}

Study haze_study(const Frames& frames) {
  const auto cases = haze_cases();
  Study study = study_of("haze", "Samples of the air between the eye and a vertex",
                         "the same columns, integrated along the ray in double, the sun's share everywhere",
                         cases.size(), "ms a frame of 64x36 pixels, from 2 km");
  std::vector<dvec3> truth;
  for (const AirCase& each : cases) truth.push_back(sky_parts(Columns::kApproximate, each.ray).sum());
  for (const int steps : {2, 4, 8}) {
    ErrorSum sum;
    for (std::size_t k = 0; k < cases.size(); ++k)
      add_error(sum, render::haze(as_drawn(cases[k].ray), steps), truth[k], cases[k].name);
    render::AirSteps air;
    air.haze = steps;
    study.settings.push_back(frames.setting(std::to_string(steps) + " steps", sum.figure(), air, 64, 36,
                                            steps == kDefaultSteps.haze));
  }
  return study;
}

}  // namespace

std::vector<Study> sky_studies(const Scope& scope) {
  const Frames up(scope, true), down(scope, false);
  return {step_study(up), map_study(up), haze_study(down), model_study(), column_study()};
}

}  // namespace app::accuracy
