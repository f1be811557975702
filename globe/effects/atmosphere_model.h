#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace globe::effects {

/// Air by the units of its field; the Earth's clear air of Bruneton 2017, "A Qualitative and Quantitative
/// Evaluation of 8 Clear Sky Models", at 680, 550 and 440 nm.
struct AirModel {
  double ground_km = 6371.0;                          ///< radius of the planet
  double thickness_km = 100.0;                        ///< no air above
  glm::dvec3 rayleigh{5.802e-3, 13.558e-3, 33.1e-3};  ///< scattering per km at height 0
  double rayleigh_height_km = 8.0;                    ///< over which it falls to 1/e
  double mie_scattering = 3.996e-3;                   ///< of droplets and dust, per km at height 0
  double mie_extinction = 4.44e-3;
  double mie_height_km = 1.2;
  double mie_asymmetry = 0.8;  ///< of the phase function of Cornette and Shanks 1992, below 1
  double turbidity = 1.0;      ///< that droplets and dust are times as dense
  glm::dvec3 ozone{0.650e-3, 1.881e-3, 0.085e-3};  ///< absorption per km where it is densest
  double ozone_height_km = 25.0;                   ///< there; from which it falls linearly
  double ozone_half_width_km = 15.0;               ///< to none
  double albedo = 0.1;                             ///< of the ground, as the air sees it
};

/// How finely the light is summed up, each a knob of accuracy.
/// @approximation atmosphere.tables, atmosphere.samples, atmosphere.haze, atmosphere.map
struct AirTableSizes {
  glm::ivec2 transmittance{128, 64};  ///< zenith angles, heights
  glm::ivec2 moments{32, 20};         ///< suns, heights, where the light is gathered
  glm::ivec2 upload{128, 48};         ///< suns, heights of the table made of that
  int zeniths = 8;                    ///< directions gathered from, above the horizon and below; fours
  int azimuths = 4;                   ///< around half the sky
  int panels = 6;                     ///< of four samples along each; even
  int orders = 6;                     ///< of scattering
};
inline constexpr int kSkyPanels = 8;   ///< of four samples along a ray of the sky's map; even
inline constexpr int kHazePanels = 2;  ///< the same before a vertex

/// The model as shaders have it (std140); shaders/lib/scattering.glsl.
struct AirBlock {
  glm::vec4 rayleigh;  ///< w: 1 / scale height
  glm::vec4 mie;       ///< scattering, extinction, 1 / scale height, asymmetry
  glm::vec4 ozone;     ///< w: 1 / half width
  glm::vec4 bounds;    ///< ground, thickness, height of the ozone, least cosine of the table's suns
  glm::vec4
      mie_moments;  ///< of what dust does not scatter straight on: 3 / 4 pi and 5 / 4 pi times the means
                    ///< of Legendre's P1 and P2; extinction without what goes straight on; scattering
  glm::vec4 sizes{0.0f};  ///< of the tables of transmittance and moments, texels
};

AirBlock air_block(const AirModel& model);

}  // namespace globe::effects
