#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <numbers>
#include <optional>

#include "globe/effects/cloud_map.h"
#include "globe/effects/entry.h"
#include "globe/effects/uniform_block.h"
#include "globe/gl/buffer.h"
#include "globe/gl/program.h"
#include "globe/gl/texture.h"
#include "globe/gl/vertex_array.h"
#include "globe/render/air.h"
#include "globe/render/effect_program.h"
#include "globe/render/view_block.h"

namespace globe::effects {
namespace {

constexpr int kRings = 48, kSectors = 96;  ///< of the layer's mesh
constexpr int kMadeUpSide = 1024;          ///< texels of a face of the cover: 12 km and less on the Earth
constexpr int kDetailSide = 512;
constexpr double kCoarseTile_m = 88e3, kFineTile_m = 8e3;  ///< of the detail near by
constexpr double kDepth = 16;                              ///< optical, of the thickest cloud
constexpr int kMistLevel = 1;                              ///< of the cover, that tells how thick the mist is
constexpr double kSunAway = -0.12;       ///< cosine of its zenith angle from which no shadow is cast
constexpr double kSmallest = 1.0 / 256;  ///< share of light taken, and part of a picture's height, that show
constexpr double kTurn = 2.0 * std::numbers::pi;

struct CloudsParameters {
  std::optional<std::filesystem::path> image;
  double altitude_m;   ///< of the layer's middle above the ellipsoid
  double thickness_m;  ///< in which an eye sees nothing but mist
  double coverage;
  double speed_m_s;  ///< along the equator, eastward
  double opacity;
  glm::vec3 color;  ///< albedo, linear
  bool shadows;
  int seed;
};

CloudsParameters read_clouds(scene::Fields& fields) {
  return {fields.file("image"),
          fields.length_m("altitude", {100.0, 1e5}).value_or(4000.0),
          fields.length_m("thickness", {10.0, 1e4}).value_or(400.0),
          fields.number("coverage", {0.0, 1.0}).value_or(0.5),
          fields.number("speed", {-1e4, 1e4}).value_or(15.0),
          fields.number("opacity", {0.0, 1.0}).value_or(0.97),
          fields.light("color").value_or(glm::vec3(1.0f)),
          fields.flag("shadows").value_or(true),
          fields.integer("seed", 0, std::numeric_limits<int>::max()).value_or(1)};
}

/// Mirrors `Detail` in shaders/effects/clouds.glsl.
struct DetailBlock {
  std::array<glm::vec4, 3> chart;
  glm::vec4 sun;
};

/// Mirrors `Clouds` in shaders/effects/clouds.glsl (std140).
struct CloudsBlock {
  glm::vec4 color;
  glm::vec4 layer;
  glm::vec4 cover;
  glm::vec4 turned;
  glm::vec4 sun;
  glm::vec4 round_sun;
  glm::vec4 mist;
  std::array<DetailBlock, 2> detail;
};

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

/// Radius of the cone about a camera's axis that holds all of its picture.
double view_angle(const render::Camera& camera) {
  return std::atan(std::hypot(camera.tan_x(), camera.tan_y()));
}

/// An eye over the sphere of the clouds and that of the ground, in round space, where the ellipsoid is one.
struct Stand {
  glm::dvec3 up;     ///< unit
  glm::dvec3 ahead;  ///< the camera's axis, unit
  double eye_m;      ///< from the centre, as the next two
  double layer_m;
  double ground_m;

  double over_layer_m() const { return eye_m - layer_m; }
};

/// Factors that make an ellipsoid a sphere of its mean radius.
glm::dvec3 rounding_of(const geo::Ellipsoid& ellipsoid) {
  const double radius = ellipsoid.mean_radius();
  return {radius / ellipsoid.a, radius / ellipsoid.a, radius / ellipsoid.b()};
}

/// A plane that touches the planet where an axis leaves it, with the detail laid on it.
struct Chart {
  glm::dmat3 axes;  ///< normal, columns, rows
  double share;     ///< of the detail: none where another plane takes over
};

/// The chart for an eye above a direction of the cover's frame.
Chart chart_at(const glm::dvec3& up) {
  constexpr double kBorder =
      0.02;  // of the components' ratio, in which one fades out before the next comes in
  const glm::dvec3 size = glm::abs(up);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const double next = std::max(size[(axis + 1) % 3], size[(axis + 2) % 3]) / size[axis];
  Chart chart{glm::dmat3(0.0), std::clamp((1.0 - next) / kBorder, 0.0, 1.0)};
  chart.axes[0][axis] = up[axis] < 0.0 ? -1.0 : 1.0;
  chart.axes[1][(axis + 1) % 3] = chart.axes[2][(axis + 2) % 3] = 1.0;
  return chart;
}

Stand stand_of(const render::EffectView& view, double altitude_m) {
  const glm::dvec3 rounding = rounding_of(view.surface.ellipsoid());
  const double radius = view.surface.ellipsoid().mean_radius();
  const glm::dvec3 eye = view.camera.position * rounding;
  const double distance = glm::length(eye);
  return {eye / distance, glm::normalize(view.camera.forward * rounding), distance, radius + altitude_m,
          radius};
}

/// A layer of clouds, its shadows, and the mist inside it.
class Clouds final : public render::Effect {
 public:
  Clouds(const CloudsParameters& parameters, const planet::Surface& surface) : parameters_(parameters) {
    if (parameters.image) image_ = read_lat_long_image(*parameters.image);
    equator_m_ = surface.ellipsoid().a;
  }

  render::EffectShader shader() const override {
    render::EffectShader shader;
    shader.file = "effects/clouds.glsl";
    shader.dims_light = parameters_.shadows;
    shader.is_medium = true;
    shader.textures = 2;
    return shader;
  }

  bool moves() const override { return true; }
  render::Stage stage() const override { return render::Stage::kLayer; }

  render::Verdict judge(const render::EffectView& view) const override {
    if (parameters_.coverage == 0.0) return {false, "there are none"};
    if (parameters_.opacity < kSmallest) return {false, "too thin to see"};
    const Stand stand = stand_of(view, parameters_.altitude_m);
    const double across = 2.0 * stand.layer_m / stand.eye_m;
    if (across < kSmallest * view.camera.tan_y()) return {false, "the planet is too small to see them"};
    if (sees_layer(view, stand))
      return {true, stand.over_layer_m() > 0.0 ? "seen from above" : "seen from below"};
    if (casts_shadows(view)) return {true, "their shadows fall on the ground in view"};
    return {false, "out of view"};
  }

  void warm_up() override { program_.for_active(0, render::Serving::kAny); }

  void compile(const render::EffectHost& host) override {
    array_ = gl::VertexArray::create();
    gl::ProgramSources sources;
    sources.files = {"effects/clouds_layer.vert", "effects/clouds_layer.frag"};
    sources.defines = {"RINGS " + std::to_string(kRings), "SECTORS " + std::to_string(kSectors),
                       "HAZE_STEPS " + std::to_string(host.air.haze)};
    program_ = {std::move(sources), host.shaders};
    std::vector<std::uint16_t> indices;
    for (int ring = 0; ring < kRings; ++ring) {
      for (int sector = 0; sector < kSectors; ++sector) {
        const int corner = ring * (kSectors + 1) + sector, outer = corner + kSectors + 1;
        for (const int k : {corner, outer, corner + 1, corner + 1, outer, outer + 1})
          indices.push_back(static_cast<std::uint16_t>(k));
      }
    }
    indices_ = gl::Buffer::of(indices);
    array_.set_indices(indices_);
  }

  void prepare(const render::EffectView& view, const render::Bindings& bindings) override {
    if (texture_.id() == 0) make_textures();
    const Stand stand = stand_of(view, parameters_.altitude_m);
    const double pixel = 2.0 * view.camera.tan_y() / view.target.height();
    const bool given = image_.has_value();
    // A picture's clear sky is not all black; made-up weather begins where its share of the sphere does.
    const double begins = given ? 1.15 - 2.0 * parameters_.coverage : 1.0 - parameters_.coverage;
    const double gain = given ? 1.0 / 0.85 : 1.0 / 0.7;
    const double angle = std::remainder(parameters_.speed_m_s * view.instant.time_s / equator_m_, kTurn);
    const double c = std::cos(angle), s = std::sin(angle);
    const glm::dmat3 turn(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0);  // from the world's axes to the cover's
    CloudsBlock block{};
    block.color = glm::vec4(parameters_.color, static_cast<float>(parameters_.opacity));
    block.layer = glm::vec4(glm::dvec4(stand.layer_m * 1e-3, stand.ground_m * 1e-3, stand.over_layer_m(),
                                       0.5 * parameters_.thickness_m));
    block.cover = glm::vec4(glm::dvec4(begins, gain, kDepth, pixel));
    // One level for all of a view, by its nearest cloud: drivers in software look up many times as fast then.
    const double footprint_m = std::abs(stand.over_layer_m()) * pixel;
    const double texel_m = 2.0 * stand.ground_m / texture_.width();
    const double level =
        std::clamp(std::floor(std::log2(std::max(footprint_m / texel_m, 1.0))), 0.0, texture_.levels() - 1.0);
    block.turned = glm::vec4(glm::dvec4(c, s, texture_.width() / std::exp2(level), level));

    const glm::dvec3 up = turn * glm::normalize(view.camera.position);
    const Chart chart = chart_at(up);
    const glm::dmat3 axes = glm::transpose(chart.axes) * turn, rows = glm::transpose(axes);
    const glm::dvec3 sun = axes * view.sun;
    for (std::size_t k = 0; k < block.detail.size(); ++k) {
      const bool fine = k == 1;
      const double tiles = stand.ground_m / (fine ? kFineTile_m : kCoarseTile_m);
      const double share = chart.share * (fine ? (given ? 0.06 : 0.11) : (given ? 0.2 : 0.34));
      DetailBlock& detail = block.detail[k];
      for (int row = 0; row < 3; ++row)
        detail.chart[static_cast<std::size_t>(row)] =
            glm::vec4(glm::vec3(rows[row] * (row == 0 ? 1.0 : tiles)), 0.0f);
      detail.sun = glm::vec4(glm::dvec4(sun.x, sun.y * tiles, sun.z * tiles, share));
    }
    block.sun = glm::vec4(glm::dvec4(turn * view.sun, 0.0));
    block.round_sun =
        glm::vec4(glm::dvec4(glm::normalize(view.sun * rounding_of(view.surface.ellipsoid())), 0.0));
    block.mist = mist_at(view, stand, up, begins, gain);
    block_.bind(block, bindings.block);
    texture_.bind(bindings.unit);
    detail_.bind(bindings.unit + 1);
  }

  void draw(const render::EffectView& view) override {
    const Stand stand = stand_of(view, parameters_.altitude_m);
    if (!sees_layer(view, stand)) return;
    const bool above = stand.over_layer_m() > 0.0;
    // As far as the ground hides it: from above beyond its own horizon.
    const double to_horizon = std::acos(stand.ground_m / stand.layer_m);
    const double from_eye = std::acos(std::min(stand.ground_m / stand.eye_m, 1.0));
    const double last = 1.001 * (to_horizon + from_eye) + 1e-4;
    const double nearest_m = std::max(std::abs(stand.over_layer_m()), 20.0);
    const double growth = std::max(std::log1p(last * stand.layer_m / nearest_m), 0.01);
    // Sectors only where the picture is.
    const glm::dvec3 axis = above ? -stand.up : stand.up;
    const double apart = angle_between(stand.ahead, axis), wide = 1.02 * view_angle(view.camera) + 0.01;
    const double half_turn = std::sin(wide) < std::sin(apart) && wide < 0.5 * std::numbers::pi
                                 ? std::min(std::asin(std::sin(wide) / std::sin(apart)), std::numbers::pi)
                                 : std::numbers::pi;
    const glm::dvec3 level = stand.ahead - stand.up * glm::dot(stand.ahead, stand.up);
    const glm::dvec3 ahead =
        glm::length(level) > 1e-6
            ? glm::normalize(level)
            : glm::normalize(glm::cross(stand.up, glm::dvec3(stand.up.y, stand.up.z, stand.up.x)));

    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    array_.bind();
    const gl::Program& program = program_.for_active(view.active, view.serving);
    program.use();
    program.set(0, glm::vec3(ahead));
    program.set(1, glm::vec4(glm::dvec4(last, growth, half_turn, 0.0)));
    const auto draw_faces = [&](bool seen_from_above) {
      program.set(2, seen_from_above ? 1 : 0);
      glDrawElements(GL_TRIANGLES, kRings * kSectors * 6, GL_UNSIGNED_SHORT, nullptr);
    };
    if (above) {
      // Beyond its horizon the layer is seen from below, behind what is seen from above.
      glEnable(GL_CULL_FACE);
      glFrontFace(GL_CCW);
      glCullFace(GL_FRONT);
      draw_faces(false);
      glCullFace(GL_BACK);
      draw_faces(true);
      glDisable(GL_CULL_FACE);
    } else {
      draw_faces(false);
    }
  }

  std::size_t gpu_bytes() const override {
    return block_.bytes() + indices_.size() + texture_.bytes() + detail_.bytes();
  }

 private:
  bool sees_layer(const render::EffectView& view, const Stand& stand) const {
    const double wide = view_angle(view.camera);
    if (stand.over_layer_m() > 0.0)
      return angle_between(stand.ahead, -stand.up) - wide < std::asin(stand.layer_m / stand.eye_m);
    // From below the sky is full of it down to the ground's horizon.
    const double dip = std::acos(std::min(stand.ground_m / stand.eye_m, 1.0));
    return angle_between(stand.ahead, stand.up) - wide < 0.5 * std::numbers::pi + dip;
  }

  bool casts_shadows(const render::EffectView& view) const {
    if (!parameters_.shadows || view.patches.patches == 0) return false;
    return view.height_m > 1e5 || glm::dot(glm::normalize(view.camera.position), view.sun) > kSunAway;
  }

  /// Light and extinction of the mist about an eye in the layer, by the weather there.
  glm::vec4 mist_at(const render::EffectView& view, const Stand& stand, const glm::dvec3& up, double begins,
                    double gain) const {
    const double half_m = 0.5 * parameters_.thickness_m, deep = 1.0 - std::abs(stand.over_layer_m()) / half_m;
    if (deep <= 0.0) return glm::vec4(0.0f);
    const double dense = std::clamp(
        (1.5 * gain) * (cover_at(levels_.front(), texture_.width() >> kMistLevel, up) - begins), 0.0, 1.0);
    const double depth = kDepth * dense * dense;
    // What comes through from above.
    const double above = 0.5 - 0.5 * stand.over_layer_m() / half_m;
    const double passes = 1.0 / (1.0 + 0.2 * depth * above);
    const auto cos_sun = static_cast<float>(glm::dot(stand.up, view.sun));
    const float height_km = static_cast<float>(parameters_.altitude_m * 1e-3);
    const bool air = render::has_air(view.surface.info());
    const glm::vec3 sun =
        air ? render::sun_transmittance(height_km, cos_sun, static_cast<float>(stand.ground_m * 1e-3))
            : glm::vec3(cos_sun > 0.0f ? 1.0f : 0.0f);
    const float day = std::clamp((cos_sun + 0.16f) / 0.5f, 0.0f, 1.0f);
    const glm::vec3 sky =
        air ? glm::vec3(0.09f, 0.12f, 0.16f) * (day * day * (3.0f - 2.0f * day)) : glm::vec3(0.0f);
    const float lit = (0.12f + 0.6f * std::max(cos_sun, 0.0f)) * static_cast<float>(passes);
    const glm::vec3 light = parameters_.color * (sun * lit + sky * static_cast<float>(0.3 + 0.7 * passes)) *
                            (view.block.sun.w * view.block.rounding.w / std::numbers::pi_v<float>);
    return {light, static_cast<float>(parameters_.opacity * depth * deep / half_m)};
  }

  void make_textures() {
    const auto seed = static_cast<std::uint32_t>(parameters_.seed);
    int side = kMadeUpSide;
    if (image_) side = image_->width <= 1024 ? 512 : image_->width <= 4096 ? 1024 : 2048;
    const CloudCover cover = image_ ? cover_of(*image_, side) : made_up_cover(seed, side);
    if (image_) image_ = LatLongImage{image_->width, image_->height, image_->channels, {}};
    levels_ = cloud_texels(cover);
    texture_ = gl::Texture::array(GL_RGBA8, side, side, 6, static_cast<int>(levels_.size()));
    for (int level = 0; level < texture_.levels(); ++level) {
      const int texels = side >> level;
      for (int face = 0; face < 6; ++face) {
        const std::size_t first = 4 * static_cast<std::size_t>(face) * static_cast<std::size_t>(texels) *
                                  static_cast<std::size_t>(texels);
        texture_.upload({0, 0, texels, texels, face, level},
                        levels_[static_cast<std::size_t>(level)].data() + first);
      }
    }
    levels_.erase(levels_.begin(), levels_.begin() + kMistLevel);
    texture_.set_filter(GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR);
    texture_.set_wrap(GL_CLAMP_TO_EDGE);
    detail_ = gl::Texture::flat(GL_RGBA8, kDetailSide, kDetailSide, 10);
    detail_.upload({0, 0, kDetailSide, kDetailSide, 0, 0}, cloud_detail(seed, kDetailSide).data());
    detail_.generate_mipmaps();
    detail_.set_filter(GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR);
    detail_.set_wrap(GL_REPEAT);
  }

  CloudsParameters parameters_;
  double equator_m_;
  std::optional<LatLongImage> image_;  ///< without its pixels once the texture is made
  UniformBlock<CloudsBlock> block_;
  gl::VertexArray array_;
  gl::Buffer indices_;
  render::EffectProgram program_;
  std::vector<std::vector<std::uint8_t>> levels_;  ///< of the cover from kMistLevel on
  gl::Texture texture_, detail_;
};

}  // namespace

EffectEntry clouds() { return entry_of<CloudsParameters, Clouds, read_clouds>("clouds"); }

}  // namespace globe::effects
