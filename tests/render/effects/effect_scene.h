#pragma once

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "globe/effects/list.h"
#include "globe/render/globe_renderer.h"
#include "globe/scene/scene.h"
#include "tests/temporary_folder.h"

/// Scenes of effects on the built-in planet, for tests that look at their pictures.
namespace effect_scene {

inline std::shared_ptr<const globe::planet::Surface> planet() {
  static const std::shared_ptr<const globe::planet::Surface> surface = globe::planet::Surface::builtin(1);
  return surface;
}

/// A grey map of a planet, 8 bits a pixel.
inline std::filesystem::path write_pixels(const std::filesystem::path& file, int width,
                                          const std::vector<std::uint8_t>& pixels) {
  const auto output = OIIO::ImageOutput::create(file.string());
  output->open(file.string(), OIIO::ImageSpec(width, width / 2, 1, OIIO::TypeDesc::UINT8));
  output->write_image(OIIO::TypeDesc::UINT8, pixels.data());
  return file;
}

/// Black but for some pixels (column, row).
inline std::filesystem::path write_map(const std::filesystem::path& file, int width,
                                       const std::vector<std::pair<int, int>>& white) {
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(width / 2), 0);
  for (const auto& [column, row] : white)
    pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column)] = 255;
  return write_pixels(file, width, pixels);
}

/// A renderer of the built-in planet with the effects of a scene's tables.
inline globe::render::GlobeRenderer renderer(const std::string& effects) {
  const auto kinds = globe::effects::effect_kinds();
  const globe::scene::Scene scene =
      globe::scene::parse_scene("planet = \"procedural\"\n" + effects, "scene.toml", kinds);
  globe::render::RenderSettings settings;
  settings.clipmap = globe::clipmap::Settings::for_detail(16, 0);
  return {planet(), settings, globe::effects::make_effects(scene, *planet())};
}

/// A picture's green, top row first, after some frames that lead to a moment.
struct Picture {
  std::vector<std::uint8_t> rgba;

  double green(int x, int y, int width) const {
    return rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x)) +
                1];
  }
};

inline Picture picture(globe::render::GlobeRenderer& renderer, const globe::render::Camera& camera,
                       const glm::dvec3& sun, int width, int height, double time_s = 0.0, int frames = 1) {
  const globe::gl::Framebuffer target(width, height);
  for (int k = 1; k <= frames; ++k) {
    renderer.set_instant({time_s * k / frames, glm::dmat3(1.0)});
    renderer.draw(camera, sun, true, target);
  }
  return {target.read_rgba8()};
}

/// Middle of what one picture has more of than another, pixels from the left and top edges.
inline glm::dvec2 middle_of_difference(const Picture& more, const Picture& less, int width, int height) {
  glm::dvec2 sum(0.0);
  double all = 0.0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double weight = std::max(more.green(x, y, width) - less.green(x, y, width), 0.0);
      sum += weight * glm::dvec2(x + 0.5, y + 0.5);
      all += weight;
    }
  }
  return sum / all;
}

}  // namespace effect_scene
