// H8: where diamonds meet, both sides have the same ground, and no pixel tells that there is a seam.

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <map>

#include "converters/convert.h"
#include "tests/hard/table.h"
#include "tests/render/ground/shader_variant.h"
#include "tests/render/ground/views.h"
#include "tests/temporary_folder.h"

namespace {

using globe::clipmap::ClipmapState;
using globe::clipmap::NodeRect;
using globe::clipmap::Settings;
using globe::gl::Framebuffer;
using globe::planet::kDiamonds;
using globe::planet::Node;
using globe::planet::nodes_per_side;
using globe::render::ClipmapTextures;
using views::Camera;
using views::dvec3;
using views::GlobeRenderer;
using views::Place;

/// Places on the edges of diamonds, both hemispheres, and the corners where four of them meet.
const std::vector<Place>& seams() {
  static const std::vector<Place> places{
      {"north pole", 90, 0},     {"south pole", -90, 0},   {"0 north", 33.1, 0},   {"90 north", 8.3, 90},
      {"180 north", 61.7, -180}, {"270 north", 47.2, -90}, {"0 south", -21.4, 0},  {"90 south", -70.3, 90},
      {"180 south", -5.9, 180},  {"270 south", -44, -90},  {"corner at 90", 0, 90}};
  return places;
}

/// The other names of a node on a diamond's border.
std::vector<Node> partners(const Node& node) {
  const int n = nodes_per_side(node.level);
  std::vector<Node> found;
  const auto add = [&](int d, int i, int j) {
    found.push_back({(d + kDiamonds) % kDiamonds, node.level, i, j});
  };
  const bool pole = (node.i == 0 && node.j == 0) || (node.i == n && node.j == n);
  for (int k = 1; pole && k < kDiamonds; ++k) add(node.d + k, node.i, node.j);
  if (pole) return found;
  if (node.i == 0) add(node.d + 1, node.j, 0);
  if (node.j == 0) add(node.d - 1, 0, node.i);
  if (node.j == n) add(node.d + 1, n, node.i);
  if (node.i == n) add(node.d - 1, node.j, n);
  return found;
}

struct Shared {
  std::size_t nodes = 0;
  std::size_t different = 0;
  int farthest = 0;
};

/// Compares what two diamonds hold of the nodes they share: `difference(node, the same by another name)`.
template <class Difference>
void compare_borders(int level, const std::array<NodeRect, kDiamonds>& held, const Difference& difference,
                     Shared& sum) {
  const int n = nodes_per_side(level);
  for (int d = 0; d < kDiamonds; ++d) {
    const NodeRect& rect = held[static_cast<std::size_t>(d)];
    for (int j = rect.j0; j <= rect.j1; ++j) {
      for (int i = rect.i0; i <= rect.i1; ++i) {
        if (i != 0 && j != 0 && i != n && j != n) continue;
        for (const Node& other : partners({d, level, i, j})) {
          if (!held[static_cast<std::size_t>(other.d)].holds(other.i, other.j)) continue;
          ++sum.nodes;
          const int apart = difference(Node{d, level, i, j}, other);
          sum.different += apart == 0 ? 0 : 1;
          sum.farthest = std::max(sum.farthest, apart);
        }
      }
    }
  }
}

/// Texels of a layer, by node.
template <class T>
class Texels {
 public:
  Texels(const globe::gl::Texture& texture, int layer)
      : width_(texture.width()),
        height_(texture.height()),
        all_(texture.read<T>({0, 0, texture.width(), texture.height(), layer})) {}
  T at(int i, int j) const {
    const auto wrapped = [](int x, int n) { return static_cast<std::size_t>((x % n + n) % n); };
    return all_[wrapped(j, height_) * static_cast<std::size_t>(width_) + wrapped(i, width_)];
  }

 private:
  int width_, height_;
  std::vector<T> all_;
};

TEST_F(GlTest, H8DiamondsHoldTheSameOfTheNodesTheyShareAtEveryLevel) {
  const auto surface = views::builtin_planet();
  const Settings settings = Settings::for_detail(16, 2);
  Shared vertices, ground;
  const std::size_t places = hard::full() ? seams().size() : 5;
  for (std::size_t p = 0; p < places; ++p) {
    const Place& place = seams()[p * seams().size() / places];
    const globe::clipmap::Target target{globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg),
                                        22,
                                        {glm::normalize(dvec3(1, 2, 1)), false}};
    ClipmapTextures textures(settings);
    const auto update =
        globe::clipmap::advance(settings, *surface, target, nullptr, globe::clipmap::Stride::kWhole);
    textures.apply(update);
    for (const auto& level : update.state->levels) {
      const int l = level->region.level;
      std::map<int, Texels<glm::vec4>> positions;
      std::map<int, Texels<glm::u8vec4>> lit;
      for (int d = 0; d < kDiamonds; ++d) {
        if (textures.vertex_layer(l, d) < 0) continue;
        positions.emplace(d, Texels<glm::vec4>(textures.positions(), textures.vertex_layer(l, d)));
        lit.emplace(d, Texels<glm::u8vec4>(textures.lit(), textures.shading_layer(l, d)));
      }
      compare_borders(
          l, level->vertices,
          [&](const Node& a, const Node& b) {
            return positions.at(a.d).at(a.i, a.j) == positions.at(b.d).at(b.i, b.j) ? 0 : 1;
          },
          vertices);
      compare_borders(
          l + settings.shading_levels_at(l), level->shading,
          [&](const Node& a, const Node& b) {
            const glm::ivec4 apart =
                glm::abs(glm::ivec4(lit.at(a.d).at(a.i, a.j)) - glm::ivec4(lit.at(b.d).at(b.i, b.j)));
            return std::max({apart.r, apart.g, apart.b, apart.a});
          },
          ground);
    }
  }
  hard::report("H8", "vertices that two diamonds place differently, of " + std::to_string(vertices.nodes),
               "0", std::to_string(vertices.different));
  hard::report(
      "H8", "lit ground of a node in two diamonds, " + std::to_string(ground.nodes) + ", largest difference",
      "1/255", std::to_string(ground.farthest) + "/255");
  EXPECT_GT(vertices.nodes, 1000u);
  EXPECT_GT(ground.nodes, 5000u);
  EXPECT_EQ(vertices.different, 0u);
  EXPECT_LE(ground.farthest, 1);
}

/// Triangles so coarse that ground is shaded by the map alone, nothing made up.
constexpr int kFinest = 5;

/// A planet of smooth colours, without heights.
std::shared_ptr<const views::Surface> smooth_planet(const std::filesystem::path& folder) {
  constexpr int kMapWidth = 1024, kMapHeight = 512;
  std::vector<std::uint16_t> samples;
  for (int y = 0; y < kMapHeight; ++y) {
    const double lat = (0.5 - (y + 0.5) / kMapHeight) * M_PI;
    for (int x = 0; x < kMapWidth; ++x) {
      const double lon = ((x + 0.5) / kMapWidth * 2.0 - 1.0) * M_PI;
      for (const double wave : {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)})
        samples.push_back(static_cast<std::uint16_t>(65535.0 * (0.5 + 0.35 * wave)));
    }
  }
  const std::string map = (folder / "smooth.png").string();
  const auto output = OIIO::ImageOutput::create(map);
  if (!output || !output->open(map, OIIO::ImageSpec(kMapWidth, kMapHeight, 3, OIIO::TypeDesc::UINT16)) ||
      !output->write_image(OIIO::TypeDesc::UINT16, samples.data()) || !output->close())
    throw std::runtime_error("cannot write " + map);
  converters::ConvertOptions options;
  options.colors = {{map}};
  options.planet = folder / "smooth";
  options.level = kFinest + 3;
  converters::convert(
      options, {[](const std::string&) {}, [](const std::string&) {}, [](const std::string&, double) {}});
  using globe::planet::Dataset;
  return views::Surface::from_dataset(
      std::make_shared<const Dataset>(Dataset::open(options.planet, std::size_t{64} << 20)));
}

struct Steps {
  std::size_t crossings = 0;  ///< pairs of neighbouring pixels on two diamonds
  double across = 0;          ///< sums of how much the channels of pairs differ, of 255
  double beside = 0;
  std::size_t pairs_beside = 0;

  /// How much larger the mean step across is than the mean one beside it.
  double excess() const {
    return across / static_cast<double>(3 * crossings) - beside / static_cast<double>(pairs_beside);
  }
};

constexpr int kSeamWidth = 320, kSeamHeight = 180;

/// Diamonds that the pixels show; -1: none.
std::vector<int> diamonds_of(const Camera& camera) {
  std::vector<int> result;
  for (int y = 0; y < kSeamHeight; ++y) {
    for (int x = 0; x < kSeamWidth; ++x) {
      const dvec3 direction =
          views::ray(camera, (2.0 * x + 1.0) / kSeamWidth - 1.0, 1.0 - (2.0 * y + 1.0) / kSeamHeight);
      const double away = globe::geo::ray_ellipsoid(globe::geo::kWgs84, 0.0, camera.position, direction);
      if (away < 0.0) {
        result.push_back(-1);
        continue;
      }
      const auto place =
          globe::geo::geodetic_from_ecef(globe::geo::kWgs84, camera.position + away * direction);
      result.push_back(
          globe::planet::locate(globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg), 4).d);
    }
  }
  return result;
}

Steps steps_of(const std::vector<std::uint8_t>& rgba, const std::vector<int>& diamonds) {
  constexpr int kBeside = 8;
  const auto at = [](int x, int y) { return static_cast<std::size_t>(y * kSeamWidth + x); };
  Steps sum;
  for (int y = 0; y < kSeamHeight; ++y) {
    for (int x = kBeside; x + 1 + kBeside < kSeamWidth; ++x) {
      const auto first = diamonds.begin() + static_cast<std::ptrdiff_t>(at(x - kBeside, y));
      const bool all_ground = std::none_of(first, first + 2 * kBeside + 2, [](int d) { return d < 0; });
      if (diamonds[at(x, y)] == diamonds[at(x + 1, y)] || !all_ground) continue;
      ++sum.crossings;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto step = [&](int from) {
          return std::abs(rgba[4 * at(from + 1, y) + c] - rgba[4 * at(from, y) + c]);
        };
        // The drawn ground lies a little off the ellipsoid: the seam may be a pixel beside its place.
        sum.across += std::max({step(x - 1), step(x), step(x + 1)});
        for (int k = 3; k + 2 <= kBeside; k += 3) {
          sum.beside += std::max({step(x - k - 1), step(x - k), step(x - k + 1)});
          sum.beside += std::max({step(x + k - 1), step(x + k), step(x + k + 1)});
          sum.pairs_beside += 2;
        }
      }
    }
  }
  return sum;
}

struct WorstSeam {
  double excess = -1e9;
  std::size_t crossings = 0;
};

/// The picture whose seams show most.
WorstSeam steps_over_seams(const std::shared_ptr<const views::Surface>& surface) {
  globe::render::RenderSettings settings = views::geometry_settings(16);
  settings.clipmap = Settings::for_detail(16, 2);
  settings.max_level = kFinest;
  GlobeRenderer renderer(surface, settings);
  const Framebuffer picture(kSeamWidth, kSeamHeight);
  WorstSeam worst;
  for (const Place& place : seams()) {
    for (const double height : {2e5, 1e6, 4e6}) {
      const Camera camera = globe::render::make_camera(
          globe::geo::kWgs84, {place.lat_deg, place.lon_deg, height}, 20.0, -80.0, 60.0, 16.0 / 9.0);
      renderer.draw(camera, glm::normalize(camera.position), true, picture);
      const Steps steps = steps_of(picture.read_rgba8(), diamonds_of(camera));
      worst.crossings += steps.crossings;
      if (steps.crossings > 20) worst.excess = std::max(worst.excess, steps.excess());
    }
  }
  return worst;
}

TEST_F(GlTest, H8ColorsStepNoMoreAcrossASeamThanBesideIt) {
  const tests::TemporaryFolder folder;
  const auto surface = smooth_planet(folder.path());
  const WorstSeam seen = steps_over_seams(surface);
  hard::report(
      "H8",
      "mean colour step across seams beyond those beside them, " + std::to_string(seen.crossings) + " pairs",
      "1/255", hard::figure(std::max(seen.excess, 0.0)) + "/255");
  EXPECT_GT(seen.crossings, 2000u);
  EXPECT_LE(seen.excess, 1.0);
  const views::ShaderVariant brighter(
      "clipmap.frag", "vec4 lit = at_pixel(lit_ground_of);",
      "vec4 lit = at_pixel(lit_ground_of) * (1.0 + 0.02 * mod(layers.x, 2.0));");
  const WorstSeam control = steps_over_seams(surface);
  hard::report("H8", "negative control: every other layer brighter by a fiftieth", "> 1/255",
               hard::figure(control.excess) + "/255");
  EXPECT_GT(control.excess, 1.0);
}

}  // namespace
