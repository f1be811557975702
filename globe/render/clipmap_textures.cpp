#include "globe/render/clipmap_textures.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>
#include <limits>

namespace globe::render {
namespace {

using clipmap::LevelData;
using clipmap::NodeRect;
using clipmap::Torus;
using planet::kDiamonds;

/// A camera away from diamond edges needs one a level, four for the base level, and some for what is loading.
constexpr int kFirstLayers = 28;

NodeRect all_texels(const Torus& torus) { return {0, torus.width - 1, 0, torus.height - 1}; }

constexpr std::size_t kLitBytes = sizeof(glm::u8vec4) + sizeof(std::uint8_t);
constexpr std::size_t kKnotBytes = 2 * sizeof(glm::vec4);

std::size_t vertex_bytes(const clipmap::Settings& settings) {
  return clipmap::is_interpolated(settings.positions) ? sizeof(float) : 2 * sizeof(glm::vec4);
}

std::vector<LayerPool::Plane> vertex_planes(const clipmap::Settings& settings) {
  const Torus torus = settings.vertex_torus();
  if (!clipmap::is_interpolated(settings.positions)) return {{GL_RGBA32F, torus}, {GL_RGBA32F, torus}};
  return {{GL_R32F, torus}, {GL_RGBA32F, Torus::square(settings.window() / settings.knot_step()), 2}};
}

std::vector<LayerPool::Plane> shading_planes(const clipmap::Settings& settings) {
  const Torus torus = Torus::square(settings.shading_window());
  return {{GL_RGBA8, torus}, {GL_R8, torus}};
}

}  // namespace

ClipmapTextures::ClipmapTextures(const clipmap::Settings& settings, UploadQueue::Clock clock)
    : settings_(settings),
      vertices_(vertex_planes(settings), GL_NEAREST, kFirstLayers),
      shading_(shading_planes(settings), GL_LINEAR, kFirstLayers),
      queue_(std::move(clock)) {}

void ClipmapTextures::begin(clipmap::StateUpdate update) { begin(std::move(update), true); }

void ClipmapTextures::begin(clipmap::StateUpdate update, bool beside_drawn) {
  assert(!loading_);
  loading_ = Loading{std::move(update), {}, beside_drawn};
  if (!beside_drawn) release_unused();
  assign_layers();
  queue_copies();
  queue_blocks();
}

std::size_t ClipmapTextures::upload(double ms) {
  std::size_t bytes = 0;
  queue_.run(ms, [&](const UploadJob& job) {
    perform(job);
    if (job.vertices != nullptr || job.shading != nullptr) bytes += job.bytes();
  });
  return bytes;
}

std::shared_ptr<const clipmap::ClipmapState> ClipmapTextures::swap() {
  assert(is_loaded());
  for (const auto& [share, old] : layers_) {
    const auto found = loading_->layers.find(share);
    const Layers now = found == loading_->layers.end() ? Layers{} : found->second;
    if (old.vertices != now.vertices) vertices_.release(old.vertices);
    if (old.shading != now.shading) shading_.release(old.shading);
  }
  vertices_.finish_growth();
  shading_.finish_growth();
  layers_ = std::move(loading_->layers);
  drawn_ = std::move(loading_->update.state);
  loading_.reset();
  return drawn_;
}

void ClipmapTextures::abandon() {
  if (!loading_) return;
  queue_.clear();
  for (const auto& [share, taken] : loading_->layers) {
    const auto found = layers_.find(share);
    const Layers drawn = found == layers_.end() ? Layers{} : found->second;
    if (taken.vertices != drawn.vertices) vertices_.release(taken.vertices);
    if (taken.shading != drawn.shading) shading_.release(taken.shading);
  }
  vertices_.abandon_growth();
  shading_.abandon_growth();
  loading_.reset();
}

std::size_t ClipmapTextures::apply(clipmap::StateUpdate update) {
  begin(std::move(update), false);
  const std::size_t bytes = upload(std::numeric_limits<double>::infinity());
  swap();
  return bytes;
}

const LevelData* ClipmapTextures::drawn_level(int level) const {
  if (!drawn_ || level > drawn_->finest_level()) return nullptr;
  return drawn_->levels[static_cast<std::size_t>(level - drawn_->base_level())].get();
}

ClipmapTextures::Layers ClipmapTextures::kept_layers(const LevelData& next, int d) const {
  const auto found = layers_.find({next.region.level, d});
  if (found == layers_.end()) return {};
  const LevelData& drawn = *drawn_level(next.region.level);
  if (&drawn == &next || !loading_->beside_drawn) return found->second;
  const auto k = static_cast<std::size_t>(d);
  Layers kept;
  if (drawn.anchor == next.anchor && vertices_.torus(0).holds_both(drawn.footprint[k], next.footprint[k]))
    kept.vertices = found->second.vertices;
  if (drawn.lighting == next.lighting && shading_.torus(0).holds_both({drawn.shading[k]}, {next.shading[k]}))
    kept.shading = found->second.shading;
  return kept;
}

void ClipmapTextures::release_unused() {
  const auto& levels = loading_->update.state->levels;
  std::erase_if(layers_, [&](const auto& entry) {
    const auto [level, d] = entry.first;
    if (level <= levels.back()->region.level &&
        !levels[static_cast<std::size_t>(level - levels.front()->region.level)]
             ->vertices[static_cast<std::size_t>(d)]
             .empty())
      return false;
    vertices_.release(entry.second.vertices);
    shading_.release(entry.second.shading);
    return true;
  });
}

void ClipmapTextures::assign_layers() {
  int fresh_vertices = 0, fresh_shading = 0;
  for (const auto& level : loading_->update.state->levels) {
    for (int d = 0; d < kDiamonds; ++d) {
      if (level->vertices[static_cast<std::size_t>(d)].empty()) continue;
      const Layers kept = kept_layers(*level, d);
      fresh_vertices += kept.vertices < 0 ? 1 : 0;
      fresh_shading += kept.shading < 0 ? 1 : 0;
      loading_->layers[{level->region.level, d}] = kept;
    }
  }
  const auto make_larger = [&](UploadJob::Kind kind, const LayerPool& pool) {
    for (int plane = 0; plane < static_cast<int>(pool.planes()); ++plane) {
      const auto k = static_cast<std::size_t>(plane);
      queue_.add({kind, plane, all_texels(pool.torus(k)), pool.grown_texel_bytes(k), nullptr, nullptr, 0});
    }
  };
  if (vertices_.reserve(fresh_vertices)) {
    make_larger(UploadJob::Kind::kGrowVertices, vertices_);
    for (const auto& [share, kept] : loading_->layers) {
      if (kept.vertices >= 0) copy_vertices(kept.vertices, kept.vertices, all_texels(vertices_.torus(0)));
    }
  }
  if (shading_.reserve(fresh_shading)) {
    make_larger(UploadJob::Kind::kGrowShading, shading_);
    for (const auto& [share, kept] : loading_->layers) {
      if (kept.shading >= 0) copy_shading(kept.shading, kept.shading, all_texels(shading_.torus(0)));
    }
  }
}

void ClipmapTextures::copy_vertices(int layer, int from_layer, const NodeRect& nodes) {
  queue_.add(
      {UploadJob::Kind::kCopyVertices, layer, nodes, vertex_bytes(settings_), nullptr, nullptr, from_layer});
  if (!clipmap::is_interpolated(settings_.positions)) return;
  const int step = settings_.knot_step();
  queue_.add({UploadJob::Kind::kCopyKnots,
              layer,
              {nodes.i0 / step, nodes.i1 / step, nodes.j0 / step, nodes.j1 / step},
              kKnotBytes,
              nullptr,
              nullptr,
              from_layer});
}

void ClipmapTextures::copy_shading(int layer, int from_layer, const NodeRect& nodes) {
  queue_.add({UploadJob::Kind::kCopyShading, layer, nodes, kLitBytes, nullptr, nullptr, from_layer});
}

void ClipmapTextures::queue_copies() {
  for (auto& [share, layers] : loading_->layers) {
    const auto [level, d] = share;
    const auto k = static_cast<std::size_t>(d);
    const auto old = layers_.find(share);
    const auto& levels = loading_->update.state->levels;
    const LevelData& next = *levels[static_cast<std::size_t>(level - levels.front()->region.level)];
    const LevelData* drawn = old == layers_.end() ? nullptr : drawn_level(level);
    // What stays of a level that goes on in another layer; an update brings the rest.
    if (layers.vertices < 0) {
      layers.vertices = vertices_.acquire();
      if (drawn != nullptr && drawn->anchor == next.anchor) {
        for (const NodeRect& stays : intersect(drawn->footprint[k], next.footprint[k]))
          copy_vertices(layers.vertices, old->second.vertices, stays);
      }
    }
    if (layers.shading < 0) {
      layers.shading = shading_.acquire();
      const NodeRect stays = drawn != nullptr && drawn->lighting == next.lighting
                                 ? intersect(drawn->shading[k], next.shading[k])
                                 : NodeRect{};
      if (!stays.empty()) copy_shading(layers.shading, old->second.shading, stays);
    }
  }
}

void ClipmapTextures::queue_blocks() {
  for (const clipmap::LevelUpdate& level : loading_->update.levels) {
    const int l = level.data->region.level;
    for (const clipmap::VertexBlock& block : level.vertex_blocks) {
      const int layer = loading_->layers.at({l, block.d}).vertices;
      queue_.add(
          {UploadJob::Kind::kVertices, layer, block.nodes, vertex_bytes(settings_), &block, nullptr, 0});
      if (clipmap::is_interpolated(settings_.positions))
        queue_.add({UploadJob::Kind::kKnots, layer, block.knots.knots, kKnotBytes, &block, nullptr, 0});
    }
    for (const clipmap::ShadingBlock& block : level.shading_blocks) {
      const int layer = loading_->layers.at({l, block.d}).shading;
      queue_.add({UploadJob::Kind::kShading, layer, block.nodes, kLitBytes, nullptr, &block, 0});
    }
  }
}

void ClipmapTextures::perform(const UploadJob& job) {
  const auto upload = [&](LayerPool& pool, std::size_t plane, int which, const auto& texels,
                          const NodeRect& held) {
    const auto first =
        static_cast<std::size_t>(job.nodes.j0 - held.j0) * static_cast<std::size_t>(held.width()) +
        static_cast<std::size_t>(job.nodes.i0 - held.i0);
    pool.upload(plane, job.layer, which, job.nodes, &texels[first], held.width());
  };
  switch (job.kind) {
    case UploadJob::Kind::kGrowVertices:
      vertices_.grow();
      break;
    case UploadJob::Kind::kGrowShading:
      shading_.grow();
      break;
    case UploadJob::Kind::kVertices:
      if (clipmap::is_interpolated(settings_.positions)) {
        upload(vertices_, 0, 0, job.vertices->height, job.vertices->nodes);
      } else {
        upload(vertices_, 0, 0, job.vertices->position, job.vertices->nodes);
        upload(vertices_, 1, 0, job.vertices->coarse, job.vertices->nodes);
      }
      break;
    case UploadJob::Kind::kKnots:
      upload(vertices_, 1, 0, job.vertices->knots.surface, job.vertices->knots.knots);
      upload(vertices_, 1, 1, job.vertices->knots.normal, job.vertices->knots.knots);
      break;
    case UploadJob::Kind::kShading:
      upload(shading_, 0, 0, job.shading->lit, job.shading->nodes);
      upload(shading_, 1, 0, job.shading->water, job.shading->nodes);
      break;
    case UploadJob::Kind::kCopyVertices:
      vertices_.copy_from_current(0, job.layer, job.from_layer, job.nodes);
      if (!clipmap::is_interpolated(settings_.positions))
        vertices_.copy_from_current(1, job.layer, job.from_layer, job.nodes);
      break;
    case UploadJob::Kind::kCopyKnots:
      vertices_.copy_from_current(1, job.layer, job.from_layer, job.nodes);
      break;
    case UploadJob::Kind::kCopyShading:
      shading_.copy_from_current(0, job.layer, job.from_layer, job.nodes);
      shading_.copy_from_current(1, job.layer, job.from_layer, job.nodes);
      break;
  }
}

int ClipmapTextures::vertex_layer(int level, int d) const {
  const auto found = layers_.find({level, d});
  return found == layers_.end() ? -1 : found->second.vertices;
}

int ClipmapTextures::shading_layer(int level, int d) const {
  const auto found = layers_.find({level, d});
  return found == layers_.end() ? -1 : found->second.shading;
}

void ClipmapTextures::bind() const {
  for (GLuint k = 0; k < 2; ++k) {
    vertices_.texture(k).bind(k);
    shading_.texture(k).bind(2 + k);
  }
}

std::vector<std::string> ClipmapTextures::defines() const {
  if (settings_.windows == clipmap::Windows::kHexagon) {
    const Torus torus = settings_.vertex_torus();
    return {"BRICK ivec3(" + std::to_string(torus.width) + ", " + std::to_string(torus.height) + ", " +
            std::to_string(torus.shift) + ")"};
  }
  if (!clipmap::is_interpolated(settings_.positions)) return {};
  return {"KNOTS_A_PATCH " + std::to_string(settings_.m / settings_.knot_step()),
          "KNOT_STEP " + std::to_string(settings_.knot_step())};
}

}  // namespace globe::render
