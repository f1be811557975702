#include "flat/geomipmap_ground.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <string>
#include <utility>

#include "flat/box.h"
#include "globe/render/ground_state.h"

namespace globe::flat {
namespace {

constexpr std::size_t kKeptFrames = 60;  ///< that a patch out of view keeps its buffer
constexpr double kSunMoved = 1e-3;       ///< radians after which the lightmap is made anew
constexpr int kCloudTexels = 512;
constexpr double kCloudTile = 12'000.0;   ///< metres after which clouds repeat
constexpr double kCloudHeight = 3'000.0;  ///< above the frame's plane
constexpr double kCloudShade = 0.8;       ///< of the sunlight that the thickest keep off

gl::ProgramSources ground_sources(const GroundSettings& settings, bool material, bool masked,
                                  bool has_water) {
  gl::ProgramSources sources;
  sources.files = {"flat/geomipmap.vert", "flat/geomipmap.frag"};
  sources.defines = {"HAZE_STEPS " + std::to_string(settings.air_steps.haze)};
  if (settings.morph == Morph::kGpu) sources.defines.emplace_back("MORPH");
  if (material) sources.defines.emplace_back("MATERIAL");
  if (masked) sources.defines.emplace_back("MASKED");
  if (settings.cloud_cover > 0.0) sources.defines.emplace_back("CLOUD_SHADOWS");
  if (settings.has_rim) sources.defines.emplace_back("LIFT");
  if (has_water) sources.defines.emplace_back("GLINT");
  return sources;
}

/// The same for the collar, whose vertices come as they are.
gl::ProgramSources collar_sources(gl::ProgramSources sources) {
  std::erase(sources.defines, "MORPH");
  sources.defines.emplace_back("COLLAR");
  return sources;
}

/// Column and row, whole, of the post nearest to a place, whether there is one or not.
glm::dvec2 nearest_post(const Terrain& terrain, const dvec3& at) {
  return {std::round((at.x - terrain.x_m(0)) / terrain.spacing_m()),
          std::round((at.y - terrain.y_m(0)) / terrain.spacing_m())};
}

int mip_levels(int side) {
  int levels = 1;
  while (side >> levels > 0) ++levels;
  return levels;
}

gl::Texture grey_texture(const std::vector<std::uint8_t>& texels, int width, int height, GLenum wrap) {
  gl::Texture texture = gl::Texture::flat(GL_R8, width, height, mip_levels(std::max(width, height)));
  texture.upload({0, 0, width, height}, texels.data());
  texture.set_filter(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
  texture.set_wrap(wrap);
  texture.generate_mipmaps();
  return texture;
}

gl::Texture lightmap_for(const Terrain& terrain) {
  const PostRect& posts = terrain.posts();
  gl::Texture texture =
      gl::Texture::flat(GL_RGBA8, posts.columns, posts.rows, mip_levels(std::max(posts.columns, posts.rows)));
  texture.set_filter(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
  texture.set_wrap(GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace

GeomipmapGround::GeomipmapGround(std::shared_ptr<const Terrain> terrain, std::vector<glm::vec4> colors,
                                 const GroundSettings& settings, const render::EffectShaders& effects)
    : terrain_(std::move(terrain)),
      colors_(std::move(colors)),
      settings_(settings),
      instances_(terrain_->patch_count() * sizeof(Instance)),
      array_(gl::VertexArray::create()),
      lightmap_(lightmap_for(*terrain_)),
      active_(terrain_->patch_count()) {
  std::vector<std::uint16_t> indices;
  for (int shape = 0; shape < kShapes; ++shape) {
    const auto k = static_cast<std::size_t>(shape);
    const bool exists = shape / 16 + 1 < kLevels || shape % 16 == 0;
    const std::vector<std::uint16_t> of_shape = exists ? patch_indices(shape) : std::vector<std::uint16_t>{};
    first_index_[k] = indices.size();
    index_count_[k] = of_shape.size();
    indices.insert(indices.end(), of_shape.begin(), of_shape.end());
  }
  indices_ = gl::Buffer::of(indices);
  std::vector<std::uint8_t> posts;
  for (int level = 0; level < kLevels; ++level) {
    first_post_[static_cast<std::size_t>(level)] = posts.size() / 2;
    for (int row = 0; row <= kPatchCells; row += 1 << level) {
      for (int column = 0; column <= kPatchCells; column += 1 << level)
        posts.insert(posts.end(), {static_cast<std::uint8_t>(column), static_cast<std::uint8_t>(row)});
    }
  }
  posts_ = gl::Buffer::of(posts);
  using Kind = gl::Attribute::Kind;
  array_.set_attribute(0, {0, 2, GL_UNSIGNED_BYTE, 0, Kind::kInteger});
  const bool moves = settings_.morph == Morph::kGpu;
  array_.set_attribute(1, {1, 1, GL_FLOAT, moves ? static_cast<GLuint>(offsetof(PatchVertex, z)) : 0u});
  if (moves) {
    array_.set_attribute(1, {2, 1, GL_FLOAT, static_cast<GLuint>(offsetof(PatchVertex, self))});
    array_.set_attribute(1, {3, 4, GL_FLOAT, static_cast<GLuint>(offsetof(PatchVertex, side))});
    array_.set_attribute(1, {4, 4, GL_FLOAT, static_cast<GLuint>(offsetof(PatchVertex, both))});
  }
  array_.set_vertices(2, instances_, 0, sizeof(Instance), 1);
  array_.set_attribute(2, {5, 4, GL_INT, static_cast<GLuint>(offsetof(Instance, at)), Kind::kInteger});
  array_.set_attribute(2, {6, 4, GL_FLOAT, static_cast<GLuint>(offsetof(Instance, sides))});
  array_.set_attribute(2, {7, 1, GL_FLOAT, static_cast<GLuint>(offsetof(Instance, share))});
  array_.set_indices(indices_);
  if (settings_.has_rim) {
    const PostRect& all = terrain_->posts();
    lifts_ = gl::Texture::flat(GL_R32F, std::max(all.columns, all.rows), static_cast<int>(kSides));
    collar_array_ = gl::VertexArray::create();
    collar_array_.set_attribute(0, {0, 2, GL_FLOAT, static_cast<GLuint>(offsetof(CollarVertex, post))});
    collar_array_.set_attribute(0, {1, 1, GL_FLOAT, static_cast<GLuint>(offsetof(CollarVertex, z))});
    collar_array_.set_attribute(0, {2, 1, GL_FLOAT, static_cast<GLuint>(offsetof(CollarVertex, lifted))});
  }
  make_passes(effects);
}

void GeomipmapGround::make_passes(const render::EffectShaders& effects) {
  const PostRect& posts = terrain_->posts();
  const auto add_pass = [&](bool material, bool masked) -> Pass& {
    Pass& pass = passes_.emplace_back();
    const gl::ProgramSources sources = ground_sources(settings_, material, masked, water_.width() > 0);
    pass.program = {sources, effects};
    if (settings_.has_rim) pass.collar = {collar_sources(sources), effects};
    pass.has_material = material;
    return pass;
  };
  std::vector<std::uint8_t> water(colors_.size());
  std::transform(colors_.begin(), colors_.end(), water.begin(),
                 [](const glm::vec4& color) { return static_cast<std::uint8_t>(255.0f * color.a); });
  if (*std::max_element(water.begin(), water.end()) > 0)
    water_ = grey_texture(water, posts.columns, posts.rows, GL_CLAMP_TO_EDGE);
  if (settings_.cloud_cover > 0.0) {
    const Tile tile = cloud_tile(kCloudTexels, settings_.cloud_cover, 5);
    clouds_ = grey_texture(tile.texels, tile.side, tile.side, GL_REPEAT);
  }
  if (settings_.materials.empty()) {
    add_pass(false, false);
    return;
  }
  for (Material& material : settings_.materials) {
    Pass& pass = add_pass(true, !material.mask.empty());
    pass.tile = grey_texture(material.tile.texels, material.tile.side, material.tile.side, GL_REPEAT);
    if (!material.mask.empty())
      pass.mask = grey_texture(material.mask, posts.columns, posts.rows, GL_CLAMP_TO_EDGE);
    pass.u_row = material.u_row;
    pass.v_row = material.v_row;
    pass.in_patch = std::move(material.in_patch);
  }
  settings_.materials.clear();
}

std::size_t GeomipmapGround::inactive_patch_bytes() const {
  return sizeof(PatchSummary) + sizeof(levels_[0]) + sizeof(active_[0]) + (passes_.size() + 7) / 8;
}

void GeomipmapGround::begin_frame(const dvec3& sun, bool exact) {
  upload_bytes_ = 0;
  ++frame_;
  sun_ = sun;
  if (lit_by_ && (exact ? *lit_by_ == sun : glm::distance(*lit_by_, sun) < kSunMoved)) return;
  lit_by_ = sun;
  const std::vector<glm::u8vec4> texels =
      settings_.show == render::Show::kNormals
          ? shown_normals(*terrain_)
          : light_posts(*terrain_, colors_, sun * terrain_->frame().axes(), settings_.shadows);
  lightmap_.upload({0, 0, lightmap_.width(), lightmap_.height()}, texels.data());
  lightmap_.generate_mipmaps();
  upload_bytes_ += texels.size() * sizeof(texels[0]);
}

void GeomipmapGround::find_visible(const render::Camera& camera, const dvec3& eye, double lifted_m) {
  visible_.clear();
  const dmat3& axes = terrain_->frame().axes();
  const clipmap::Frustum frustum(camera.forward * axes, camera.right * axes, camera.up * axes, camera.tan_x(),
                                 camera.tan_y());
  const double collar_m = lifted_m > 0.0 ? kCollarPosts * terrain_->spacing_m() : 0.0;
  const dvec3 beyond(collar_m, collar_m, lifted_m);
  for (std::size_t k = 0; k < terrain_->patch_count(); ++k) {
    Box box = patch_box(*terrain_, k);
    box.low -= beyond;
    box.high += beyond;
    if (settings_.culling && !is_in_view(frustum, box, eye)) continue;
    if (settings_.visibility && !settings_.visibility->may_see(eye, k)) continue;
    visible_.push_back(k);
  }
}

void GeomipmapGround::make_ready(std::size_t patch, const PatchState& state) {
  if (!active_[patch]) {
    active_[patch] = std::make_unique<Active>();
    held_.push_back(patch);
  }
  Active& active = *active_[patch];
  active.last_frame = frame_;
  if (active.shape == state.shape()) return;
  active.shape = state.shape();
  std::vector<PatchVertex> vertices = patch_vertices(*terrain_, patch, state);
  if (settings_.has_rim && is_at_border(*terrain_, patch)) active.vertices = vertices;
  switch (settings_.morph) {
    case Morph::kGpu:
      active.buffer = gl::Buffer::of(vertices);
      break;
    case Morph::kCpu:
      active.vertices = std::move(vertices);
      return;
    case Morph::kOff: {
      std::vector<float> z(vertices.size());
      std::transform(vertices.begin(), vertices.end(), z.begin(), [](const PatchVertex& v) { return v.z; });
      active.buffer = gl::Buffer::of(z);
      break;
    }
  }
  upload_bytes_ += active.buffer.size();
}

/// Every vertex in view, morphed by this program, once a frame.
void GeomipmapGround::upload_heights() {
  height_offsets_.clear();
  std::vector<float> z;
  for (std::size_t k = 0; k < visible_.size(); ++k) {
    height_offsets_.push_back(z.size() * sizeof(float));
    for (const PatchVertex& vertex : active_[visible_[k]]->vertices)
      z.push_back(morphed_z(vertex, states_[k]));
  }
  if (z.empty()) return;
  const std::size_t bytes = z.size() * sizeof(float);
  if (heights_.size() < bytes) heights_ = gl::Buffer(bytes + bytes / 2);
  heights_.upload(0, z.data(), bytes);
  upload_bytes_ += bytes;
}

void GeomipmapGround::prepare(const GroundView& view) {
  const Terrain& terrain = *terrain_;
  const render::Camera& camera = view.camera;
  const dvec3 eye = terrain.frame().local_from_ecef(camera.position);
  const ErrorBound bound = error_bound(settings_.error_px, camera.fov_y_deg, camera.aspect,
                                       view.picture_height, camera.forward * terrain.frame().axes());
  levels_ = settings_.lod ? patch_levels(terrain, eye, bound, settings_.morph)
                          : std::vector<float>(terrain.patch_count(), 0.0f);
  find_visible(camera, eye, view.rim != nullptr ? view.rim->highest_m : 0.0);
  states_.clear();
  std::vector<Instance> instances;
  const glm::ivec2 eye_post(nearest_post(terrain, eye));
  for (const std::size_t patch : visible_) {
    const auto east = static_cast<std::size_t>(terrain.patches_east());
    const PatchState& state =
        states_.emplace_back(patch_state(levels_, terrain.patches_east(), terrain.patches_north(), patch));
    make_ready(patch, state);
    instances.push_back(
        {{static_cast<int>(patch % east) * kPatchCells - eye_post.x,
          static_cast<int>(patch / east) * kPatchCells - eye_post.y, state.level, static_cast<int>(patch)},
         {state.side_morph[0], state.side_morph[1], state.side_morph[2], state.side_morph[3]},
         state.morph});
  }
  if (settings_.morph == Morph::kCpu) upload_heights();
  if (!instances.empty()) instances_.upload(0, instances.data(), instances.size() * sizeof(Instance));
  upload_bytes_ += instances.size() * sizeof(Instance);
  if (view.rim != nullptr) upload_rim(*view.rim, eye_post);
  let_go();
}

void GeomipmapGround::upload_rim(const Rim& rim, const glm::ivec2& eye_post) {
  for (std::size_t side = 0; side < kSides; ++side) {
    const std::vector<float>& lifts = rim.lifts[side];
    lifts_.upload({0, static_cast<int>(side), static_cast<int>(lifts.size()), 1}, lifts.data());
    upload_bytes_ += lifts.size() * sizeof(float);
  }
  std::vector<CollarVertex> vertices;
  for (std::size_t k = 0; k < visible_.size(); ++k) {
    if (!is_at_border(*terrain_, visible_[k])) continue;
    add_collar(*terrain_, rim, {visible_[k], states_[k], active_[visible_[k]]->vertices},
               settings_.morph != Morph::kOff, eye_post, vertices);
  }
  collar_count_ = vertices.size();
  const std::size_t bytes = vertices.size() * sizeof(CollarVertex);
  if (bytes == 0) return;
  if (collar_vertices_.size() < bytes) {
    collar_vertices_ = gl::Buffer(bytes + bytes / 2);
    collar_array_.set_vertices(0, collar_vertices_, 0, sizeof(CollarVertex));
  }
  collar_vertices_.upload(0, vertices.data(), bytes);
  upload_bytes_ += bytes;
}

void GeomipmapGround::draw(const GroundView& view) {
  triangles_ = 0;
  for (Pass& pass : passes_) {
    set_uniforms(pass.program.for_active(view.active, view.serving), view);
    if (settings_.has_rim) set_uniforms(pass.collar.for_active(view.active, view.serving), view);
  }
  render::draw_wired(settings_.wireframe, [&](const glm::vec4& overlay) { draw_passes(view, overlay); });
  if (settings_.wireframe) triangles_ /= 2;  // drawn twice
}

void GeomipmapGround::draw_passes(const GroundView& view, const glm::vec4& overlay) {
  lightmap_.bind(2);
  if (water_.width() > 0) water_.bind(5);
  if (settings_.has_rim) {
    lifts_.bind(1);
  } else if (settings_.cloud_cover > 0.0) {
    clouds_.bind(1);
  }
  for (Pass& pass : passes_) {
    if (&pass != &passes_.front()) {
      glEnable(GL_BLEND);
      glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
      glDepthFunc(GL_EQUAL);
      glDepthMask(GL_FALSE);
    }
    if (pass.has_material) {
      pass.tile.bind(3);
      if (pass.mask.width() > 0) pass.mask.bind(0);
    }
    use(pass, pass.program.for_active(view.active, view.serving), overlay);
    draw_patches(pass);
    if (collar_count_ == 0) continue;
    use(pass, pass.collar.for_active(view.active, view.serving), overlay);
    collar_array_.bind();
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(collar_count_));
    triangles_ += collar_count_ / 3;
  }
  glDisable(GL_BLEND);
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_TRUE);
}

void GeomipmapGround::use(const Pass& pass, const gl::Program& program, const glm::vec4& overlay) const {
  program.use();
  program.set(4, overlay);
  program.set(5, static_cast<int>(settings_.show));
  if (!pass.has_material) return;
  program.set(6, pass.u_row);
  program.set(7, pass.v_row);
}

void GeomipmapGround::draw_patches(const Pass& pass) {
  array_.bind();
  for (std::size_t k = 0; k < visible_.size(); ++k) {
    if (!pass.in_patch.empty() && !pass.in_patch[visible_[k]]) continue;
    const auto shape = static_cast<std::size_t>(states_[k].shape());
    const auto level = static_cast<std::size_t>(states_[k].level);
    array_.set_vertices(0, posts_, first_post_[level] * 2, 2);
    if (settings_.morph == Morph::kCpu) {
      array_.set_vertices(1, heights_, height_offsets_[k], sizeof(float));
    } else {
      array_.set_vertices(1, active_[visible_[k]]->buffer, 0,
                          settings_.morph == Morph::kGpu ? sizeof(PatchVertex) : sizeof(float));
    }
    triangles_ += index_count_[shape] / 3;
    // OpenGL takes an offset into the bound buffer as a pointer.
    // NOLINTNEXTLINE(performance-no-int-to-ptr)
    const void* const first = reinterpret_cast<const void*>(first_index_[shape] * sizeof(std::uint16_t));
    glDrawElementsInstancedBaseInstance(GL_TRIANGLES, static_cast<GLsizei>(index_count_[shape]),
                                        GL_UNSIGNED_SHORT, first, 1, static_cast<GLuint>(k));
  }
}

/// What all passes know of the view. Posts are counted from the one nearest to the eye.
void GeomipmapGround::set_uniforms(const gl::Program& program, const GroundView& view) const {
  const Terrain& terrain = *terrain_;
  const dvec3 eye = terrain.frame().local_from_ecef(view.camera.position);
  const double spacing = terrain.spacing_m();
  const glm::dvec2 eye_post = nearest_post(terrain, eye);
  const glm::dvec2 eye_at(terrain.x_m(0) + eye_post.x * spacing, terrain.y_m(0) + eye_post.y * spacing);
  const auto eye_z = static_cast<float>(eye.z);
  program.set(0, glm::mat3(terrain.frame().axes()));
  program.set(1, glm::vec4(glm::dvec4(spacing, eye.x - eye_at.x, eye.y - eye_at.y,
                                      0.5 / terrain.frame().ellipsoid().mean_radius())));
  program.set(2, glm::vec4(eye_z, static_cast<float>(eye.z - static_cast<double>(eye_z)),
                           static_cast<float>(eye_at.x), static_cast<float>(eye_at.y)));
  const glm::dvec2 texels(terrain.posts().columns, terrain.posts().rows);
  program.set(3, glm::vec4(glm::dvec4((eye_post + 0.5) / texels, 1.0 / texels)));
  if (settings_.has_rim) {
    program.set(9, glm::ivec4(glm::ivec2(eye_post), terrain.posts().columns - 1, terrain.posts().rows - 1));
    program.set(11, static_cast<float>(view.rim->band));
  }
  if (settings_.cloud_cover <= 0.0) return;
  // A shadow lies where the sun's ray through its cloud comes down.
  const dvec3 sun = sun_ * terrain.frame().axes();
  const glm::dvec2 aside = sun.z > 0.05 ? glm::dvec2(sun) / sun.z * kCloudHeight : glm::dvec2(0.0);
  const glm::dvec2 at = (aside - settings_.wind * view.instant.time_s) / kCloudTile;
  program.set(8, glm::vec4(glm::dvec4(at - glm::floor(at), 1.0 / kCloudTile, kCloudShade)));
}

void GeomipmapGround::let_go() {
  const auto gone = std::remove_if(held_.begin(), held_.end(), [&](std::size_t patch) {
    if (active_[patch]->last_frame + kKeptFrames >= frame_) return false;
    active_[patch].reset();
    return true;
  });
  held_.erase(gone, held_.end());
}

std::size_t GeomipmapGround::gpu_bytes() const {
  std::size_t bytes = lightmap_.bytes() + water_.bytes() + heights_.size() + instances_.size() +
                      indices_.size() + collar_vertices_.size() + lifts_.bytes();
  for (const std::size_t patch : held_) bytes += active_[patch]->buffer.size();
  return bytes;
}

}  // namespace globe::flat
