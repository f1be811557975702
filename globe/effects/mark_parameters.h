#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

// Parameters of the effects that draw people's own marks on a planet: what a scene's tables and options on
// the command line both fill. Colours are sRGB in [0, 1], shown as they are whatever the light.

namespace globe::effects {

/// 0xRRGGBB.
constexpr glm::vec3 mark_color(unsigned rgb) {
  return glm::vec3(static_cast<float>(rgb >> 16 & 255u), static_cast<float>(rgb >> 8 & 255u),
                   static_cast<float>(rgb & 255u)) /
         255.0f;
}

/// "graticule": meridians and parallels.
struct GraticuleParameters {
  std::optional<double> step_deg;  ///< divides 90; nothing: by what is in view
  glm::vec3 color{0.93f, 0.95f, 0.97f};
  double width_px = 1.2;
  double opacity = 0.6;
};

/// One GeoJSON file, drawn on the ground.
struct ShapeLayer {
  std::filesystem::path file;
  glm::vec3 color = mark_color(0xffd133);
  double width_px = 2.0;  ///< of lines and borders; 0: none
  double fill = 0.25;     ///< opacity inside polygons; 0: none
  double point_px = 4.0;  ///< radius of points; 0: none
  double halo_px = 1.0;   ///< dark border of lines and points
};

/// "shapes": GeoJSON files, later ones over earlier ones.
struct ShapesParameters {
  std::vector<ShapeLayer> layers;
  double error_px = 0.25;  ///< that a line may be drawn off its place
};

/// "labels": names of features, and of the lines of a graticule.
struct LabelsParameters {
  std::vector<std::filesystem::path> files;
  std::string property;  ///< that holds the name; empty: name, NAME, label, title in this order
  std::string priority;  ///< numeric property: the higher, the more it matters; empty: what files
                         ///< usually have (read_named_places), else their order
  std::optional<GraticuleParameters> graticule;  ///< whose lines are to be named
  glm::vec3 color{1.0f, 1.0f, 1.0f};
  double size_px = 15.0;       ///< of letters
  std::filesystem::path font;  ///< a font's file; empty: DejaVu Sans
};

}  // namespace globe::effects
