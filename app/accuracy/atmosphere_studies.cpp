#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/accuracy/scattering_cases.h"
#include "app/accuracy/study.h"
#include "globe/effects/atmosphere_tables.h"
#include "globe/render/air.h"

namespace app::accuracy {
namespace {

namespace effects = globe::effects;
using glm::dvec3;

effects::ScatteredRay as_drawn(const ScatteringRay& ray) {
  return {glm::vec3(ray.eye), glm::vec3(ray.direction), static_cast<float>(ray.from),
          static_cast<float>(ray.to), glm::vec3(ray.sun)};
}

bool meets_ground(const ScatteringRay& ray) {
  return glm::length(ray.eye + ray.direction * ray.to) < kModel.ground_km + 1.0;
}

/// Every channel counts for itself, by its own light.
void add(ErrorSum& sum, const dvec3& light, const dvec3& truth, const std::string& place) {
  const dvec3 error = 100.0 * glm::abs(light - truth) / truth;
  sum.add(std::max({error.x, error.y, error.z}), [&] { return place; });
}

Study study_of(const std::string& name, const std::string& title, const std::string& cost_unit) {
  return {
      "atmosphere." + name,
      title,
      "",
      "light scattered once integrated in double, light scattered again by Monte Carlo (95 % within about "
      "1 %, in twilight and at night within as much as 40 %)",
      "50 looks and more from 2 m to 20,000 km up, suns from 60 degrees above the horizon to 60 below, dawn, "
      "the limb and the ground from above among them",
      "% of the light, the worst channel",
      cost_unit,
      {}};
}

struct Known {
  std::vector<ScatteringCase> cases = scattering_cases();
  std::vector<ScatteredLight> values = scattering_values();
};

template <class Use>
ErrorFigure error_over(const Known& known, const Use& light) {
  ErrorSum sum;
  for (std::size_t k = 0; k < known.cases.size(); ++k)
    if (const auto drawn = light(known.cases[k].ray))
      add(sum, *drawn, known.values[k].sum(), known.cases[k].name);
  return sum.figure();
}

/// Light scattered at most so often, gathered over more and fewer places and directions.
Study table_study(const Known& known) {
  Study study = study_of("tables", "Tables of the air: orders of scattering, places and directions",
                         "ms for the tables");
  const auto setting = [&](const std::string& name, const effects::AirTableSizes& sizes, bool is_default) {
    const effects::AirTables tables = effects::air_tables(kModel, sizes);
    study.settings.push_back(
        {name,
         error_over(known,
                    [&](const ScatteringRay& ray) {
                      return std::optional<dvec3>(effects::air_radiance(kModel, tables, as_drawn(ray), 20));
                    }),
         timed(
             1, [sizes] { keep(effects::air_tables(kModel, sizes).moments[0][0].x); }, 1e6),
         is_default});
  };
  const effects::AirTableSizes sizes;
  for (const int orders : {1, 2, 4}) {
    effects::AirTableSizes fewer = sizes;
    fewer.orders = orders;
    setting(std::to_string(orders) + (orders == 1 ? " order" : " orders"), fewer, false);
  }
  effects::AirTableSizes coarse = sizes;
  coarse.moments = {20, 12};
  coarse.upload = {64, 24};
  coarse.panels = 4;
  setting("coarse, 6 orders", coarse, false);
  setting("6 orders", sizes, true);
  effects::AirTableSizes fine = sizes;
  fine.moments = {48, 32};
  fine.upload = {192, 64};
  fine.zeniths = 12;
  fine.panels = 8;
  fine.orders = 9;
  setting("fine, 9 orders", fine, false);
  return study;
}

Study sample_study(const Known& known, const std::shared_ptr<const effects::AirTables>& tables) {
  Study study =
      study_of("samples", "Samples of the air by tables along a look at the sky", "us a ray on one core");
  for (const int panels : {2, 4, 8, 16}) {
    const auto ray = as_drawn(known.cases.front().ray);
    study.settings.push_back({std::to_string(4 * panels) + " samples",
                              error_over(known,
                                         [&](const ScatteringRay& look) {
                                           return meets_ground(look)
                                                      ? std::nullopt
                                                      : std::optional<dvec3>(effects::air_radiance(
                                                            kModel, *tables, as_drawn(look), panels));
                                         }),
                              timed(
                                  20,
                                  [tables, panels, ray] {
                                    for (int k = 0; k < 20; ++k)
                                      keep(effects::air_radiance(kModel, *tables, ray, panels).x);
                                  },
                                  1e3),
                              panels == effects::kSkyPanels});
  }
  return study;
}

Study haze_study(const Known& known, const std::shared_ptr<const effects::AirTables>& tables) {
  Study study = study_of("haze", "Samples of the air by tables before a vertex", "us a ray on one core");
  study.sample = "the looks at the ground among those of atmosphere.samples, from 12 km to 2000 km up";
  for (const int panels : {1, 2, 4, 8}) {
    const auto ray = as_drawn(known.cases.back().ray);
    study.settings.push_back({std::to_string(4 * panels) + " samples",
                              error_over(known,
                                         [&](const ScatteringRay& look) {
                                           return meets_ground(look)
                                                      ? std::optional<dvec3>(effects::air_radiance(
                                                            kModel, *tables, as_drawn(look), panels, true))
                                                      : std::nullopt;
                                         }),
                              timed(
                                  20,
                                  [tables, panels, ray] {
                                    for (int k = 0; k < 20; ++k)
                                      keep(effects::air_radiance(kModel, *tables, ray, panels, true).x);
                                  },
                                  1e3),
                              panels == effects::kHazePanels});
  }
  return study;
}

/// The sky's map of an eye and a sun, looked up for one ray: the four texels around it.
dvec3 mapped(const effects::AirTables& tables, const ScatteringRay& ray, const glm::ivec2& size) {
  const auto radius = static_cast<float>(glm::length(ray.eye));
  const dvec3 up = ray.eye / glm::length(ray.eye),
              level_sun = glm::normalize(ray.sun - up * glm::dot(ray.sun, up));
  const dvec3 aside = glm::cross(up, level_sun);
  const dvec3 level = ray.direction - up * glm::dot(ray.direction, up);
  const double cos_azimuth = glm::dot(level, level_sun) / std::max(glm::length(level), 1e-9);
  const glm::vec2 at =
      effects::air_map_place(kModel, glm::vec2(cos_azimuth, glm::dot(ray.direction, up)), radius) *
      glm::vec2(size - 1);
  const glm::ivec2 corner = glm::clamp(glm::ivec2(at), glm::ivec2(0), size - 2);
  const auto texel = [&](int x, int y) {
    const glm::dvec2 cosines(
        effects::air_map_cosines(kModel, glm::vec2(corner + glm::ivec2(x, y)) / glm::vec2(size - 1), radius));
    const double sine = std::sqrt(std::max(1.0 - cosines.y * cosines.y, 0.0));
    const double across = std::sqrt(std::max(1.0 - cosines.x * cosines.x, 0.0));
    const dvec3 direction = up * cosines.y + (level_sun * cosines.x + aside * across) * sine;
    // As shaders/sky_map.frag has it: through the ground, where rounding makes the horizon's ray meet it.
    const double along = glm::dot(ray.eye, direction), top = kModel.ground_km + kModel.thickness_km;
    const double half = std::sqrt(std::max(top * top - glm::dot(ray.eye, ray.eye) + along * along, 0.0));
    const ScatteringRay look{ray.eye, direction, std::max(-along - half, 0.0), std::max(-along + half, 0.0),
                             ray.sun};
    const glm::vec3 light = effects::air_radiance(kModel, tables, as_drawn(look), effects::kSkyPanels);
    return glm::vec3(glm::unpackHalf(glm::packHalf(glm::vec4(glm::log2(glm::max(light, 1e-9f)), 0.0f))));
  };
  const glm::vec2 t = at - glm::vec2(corner);
  return dvec3(glm::exp2(
      glm::mix(glm::mix(texel(0, 0), texel(1, 0), t.x), glm::mix(texel(0, 1), texel(1, 1), t.x), t.y)));
}

Study map_study(const Known& known, const std::shared_ptr<const effects::AirTables>& tables) {
  Study study = study_of("map", "Texels of the sky's map of the air by tables", "us a map on one core");
  for (const glm::ivec2& size :
       {glm::ivec2(32, 32), glm::ivec2(64, 48), glm::ivec2(96, 64), glm::ivec2(192, 128)}) {
    const auto ray = as_drawn(known.cases.front().ray);
    const int texels = size.x * size.y;
    study.settings.push_back(
        {std::to_string(size.x) + " x " + std::to_string(size.y),
         error_over(known,
                    [&](const ScatteringRay& look) {
                      return meets_ground(look) ? std::nullopt
                                                : std::optional<dvec3>(mapped(*tables, look, size));
                    }),
         [texels, time = timed(
                      20,
                      [tables, ray] {
                        for (int k = 0; k < 20; ++k)
                          keep(effects::air_radiance(kModel, *tables, ray, effects::kSkyPanels).x);
                      },
                      1e3)] { return time() * texels; },
         size == globe::render::AirSteps{}.map});
  }
  return study;
}

}  // namespace

std::vector<Study> atmosphere_studies(const Scope&) {
  const Known known;
  const auto tables = std::make_shared<const effects::AirTables>(effects::air_tables(kModel));
  return {table_study(known), sample_study(known, tables), haze_study(known, tables),
          map_study(known, tables)};
}

}  // namespace app::accuracy
