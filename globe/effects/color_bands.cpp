#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <vector>

#include "globe/base/srgb.h"
#include "globe/effects/entry.h"
#include "globe/planet/grid.h"

namespace globe::effects {
namespace {

constexpr int kSummitLevel = 6;  ///< of the nodes among which the planet's summit is looked for

struct Band {
  double below_percent;  ///< of the way from sea level to summit
  glm::vec3 color;       ///< albedo, linear
};

struct Steep {
  double from_deg;  ///< of the ground's slope
  glm::vec3 color;
};

struct ColorBandParameters {
  std::vector<Band> bands;   ///< rising; the last reaches to any height
  std::vector<Steep> steep;  ///< rising
  double blend_percent;      ///< from one band to the next
  double sea_level_m;
  std::optional<double> summit_m;
};

glm::vec3 linear(int rgb) {
  const auto channel = [&](int shift) {
    return linear_from_srgb(static_cast<float>(rgb >> shift & 255) / 255.0f);
  };
  return {channel(16), channel(8), channel(0)};
}

/// Those of Christopoulos 5.4.1.
std::vector<Band> usual_bands() {
  return {{10.0, linear(0x9cc56a)}, {30.0, linear(0x6f9a4a)}, {50.0, linear(0x7d7d45)},
          {70.0, linear(0x82603f)}, {85.0, linear(0xb9b7b2)}, {100.0, linear(0xf6f8fa)}};
}
constexpr double kCliffs = 62.0, kSlopes = 42.0;

std::vector<Band> read_bands(scene::Fields& fields) {
  std::vector<Band> bands;
  for (scene::Fields& one : fields.tables("bands")) {
    const double below =
        one.required("below", one.number("below", {-100.0, 1000.0}), "write its upper limit in percent");
    if (!bands.empty() && below <= bands.back().below_percent)
      one.refuse("below", "it is not above the band before", "give the bands from the lowest to the highest");
    bands.push_back({below, one.required("color", one.light("color"), "write color = \"RRGGBB\"")});
    one.finish();
  }
  return bands.empty() ? usual_bands() : bands;
}

ColorBandParameters read_color_bands(scene::Fields& fields) {
  ColorBandParameters read;
  read.bands = read_bands(fields);
  read.steep = {{fields.angle_deg("slopes_from", {0.0, 90.0}).value_or(kSlopes),
                 fields.light("slopes").value_or(linear(0x7f8672))},
                {fields.angle_deg("cliffs_from", {0.0, 90.0}).value_or(kCliffs),
                 fields.light("cliffs").value_or(linear(0x56524d))}};
  if (read.steep[0].from_deg > read.steep[1].from_deg)
    fields.refuse("slopes_from", "slopes begin steeper than cliffs", "give slopes_from below cliffs_from");
  read.blend_percent = fields.number("blend", {0.0, 100.0}).value_or(2.0);
  read.sea_level_m = fields.length_m("sea_level", {-1e5, 1e5}).value_or(0.0);
  read.summit_m = fields.length_m("summit", {-1e5, 1e6});
  if (read.summit_m && *read.summit_m <= read.sea_level_m)
    fields.refuse("summit", "it is not above sea_level", "give the highest height of the planet");
  return read;
}

double highest_node(const planet::Surface& surface) {
  double highest = 0.0;
  for (int d = 0; d < planet::kDiamonds; ++d) {
    for (int i = 0; i <= planet::nodes_per_side(kSummitLevel); ++i) {
      for (int j = 0; j <= planet::nodes_per_side(kSummitLevel); ++j)
        highest = std::max(highest, surface.height({d, kSummitLevel, i, j}));
    }
  }
  return highest;
}

/// 0 below `from - width / 2`, 1 above `from + width / 2`.
float share_above(double value, double from, double width) {
  return static_cast<float>(width > 0.0 ? std::clamp((value - from) / width + 0.5, 0.0, 1.0)
                                        : (value >= from ? 1.0 : 0.0));
}

/// The color of the ground by its height and slope; water keeps its own.
glm::vec3 banded(const ColorBandParameters& bands, double summit_m, const planet::Ground& ground,
                 const glm::vec3& albedo) {
  if (ground.has_sea && ground.height_m < 0.0) return albedo;
  const double percent = 100.0 * (ground.height_m - bands.sea_level_m) / (summit_m - bands.sea_level_m);
  glm::vec3 color = bands.bands.front().color;
  for (std::size_t k = 1; k < bands.bands.size(); ++k)
    color = glm::mix(color, bands.bands[k].color,
                     share_above(percent, bands.bands[k - 1].below_percent, bands.blend_percent));
  constexpr double kSoftness = 3.0;  // degrees
  const double slope = std::atan(glm::length(ground.slope)) * 180.0 / std::numbers::pi;
  for (const Steep& steep : bands.steep)
    color = glm::mix(color, steep.color, share_above(slope, steep.from_deg, kSoftness));
  return color;
}

/// The ground in colors of height and slope (Christopoulos 5.4.1), in place of the map's or its own.
class ColorBands final : public render::Effect {
 public:
  ColorBands(const ColorBandParameters& bands, const planet::Surface& surface) {
    if (!surface.has_heights())
      throw Refused{"the planet has no heights", "name a planet that was converted with heights"};
    const double summit_m =
        bands.summit_m ? *bands.summit_m : std::max(highest_node(surface), bands.sea_level_m + 1.0);
    coloring_ = std::make_shared<planet::Coloring>(
        [bands, summit_m](const planet::Ground& ground, const glm::vec3& albedo) {
          return banded(bands, summit_m, ground, albedo);
        });
  }

  std::shared_ptr<const planet::Coloring> coloring() const override { return coloring_; }

  render::Verdict judge(const render::EffectView& view) const override {
    if (view.patches.patches == 0) return {false, "the ground is out of view"};
    return {true, "ground is in view"};
  }

 private:
  std::shared_ptr<const planet::Coloring> coloring_;
};

}  // namespace

EffectEntry color_bands() {
  return entry_of<ColorBandParameters, ColorBands, read_color_bands>("color_bands");
}

}  // namespace globe::effects
