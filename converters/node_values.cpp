#include "converters/node_values.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "converters/srgb.h"
#include "globe/planet/appearance.h"
#include "globe/planet/directions.h"
#include "globe/planet/inset_stack.h"

namespace converters {
namespace {

using globe::planet::Dataset;
using globe::planet::Surface;
using globe::planet::TileId;
using SurfacePointer = std::shared_ptr<const Surface>;

/// A float layer of the data, as it is stored.
class StoredHeights : public NodeValues {
 public:
  StoredHeights(SurfacePointer surface, int level, const char* layer)
      : NodeValues(level, 1), surface_(std::move(surface)), layer_(layer) {}

  void read(int d, int i0, int j0, int side, float* out) const override {
    surface_->dataset()->read(layer_, d, level(), i0, j0, side + 1, side + 1, out);
  }

 private:
  SurfacePointer surface_;
  const char* layer_;
};

class StoredColors : public NodeValues {
 public:
  StoredColors(SurfacePointer surface, int level) : NodeValues(level, 3), surface_(std::move(surface)) {
    for (std::size_t byte = 0; byte < linear_.size(); ++byte)
      linear_[byte] = static_cast<float>(linear_from_srgb(double(byte) / 255.0));
  }

  void read(int d, int i0, int j0, int side, float* out) const override {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>((side + 1) * (side + 1) * channels()));
    surface_->dataset()->read("color", d, level(), i0, j0, side + 1, side + 1, bytes.data());
    std::transform(bytes.begin(), bytes.end(), out, [this](std::uint8_t byte) { return linear_[byte]; });
  }

 private:
  SurfacePointer surface_;
  std::array<float, 256> linear_{};
};

/// Of the tiles that are made for drawing: for ground that is in no file, or put together from several.
class MadeValues : public NodeValues {
 public:
  MadeValues(SurfacePointer surface, int level, int channels)
      : NodeValues(level, channels), surface_(std::move(surface)) {}

 protected:
  const Surface& surface() const { return *surface_; }
  std::shared_ptr<const globe::planet::SurfaceTile> tile_at(int d, int i0, int j0) const {
    return surface_->tile(globe::planet::tile_of({d, level(), i0, j0}));
  }

 private:
  SurfacePointer surface_;
};

class MadeHeights : public MadeValues {
 public:
  MadeHeights(SurfacePointer surface, int level, bool filtered)
      : MadeValues(std::move(surface), level, 1), filtered_(filtered) {}

  void read(int d, int i0, int j0, int side, float* out) const override {
    const auto tile = tile_at(d, i0, j0);
    const auto& heights = filtered_ ? tile->shading_height() : tile->height;
    for (int j = j0; j <= j0 + side; ++j) {
      for (int i = i0; i <= i0 + side; ++i) *out++ = static_cast<float>(heights.at(i, j));
    }
  }

 private:
  bool filtered_;
};

/// Data and insets without anything made up.
class DataHeights : public NodeValues {
 public:
  DataHeights(SurfacePointer surface, int level) : NodeValues(level, 1), surface_(std::move(surface)) {}

  void read(int d, int i0, int j0, int side, float* out) const override {
    for (int j = j0; j <= j0 + side; ++j) {
      for (int i = i0; i <= i0 + side; ++i)
        *out++ = static_cast<float>(surface_->data_height({d, level(), i, j}));
    }
  }

 private:
  SurfacePointer surface_;
};

/// The map's color in the tiles.
class TileColors : public MadeValues {
 public:
  TileColors(SurfacePointer surface, int level) : MadeValues(std::move(surface), level, 3) {}

  void read(int d, int i0, int j0, int side, float* out) const override {
    using globe::planet::Channel;
    const auto tile = tile_at(d, i0, j0);
    for (int j = j0; j <= j0 + side; ++j) {
      for (int i = i0; i <= i0 + side; ++i) {
        for (const Channel c : {Channel::kRed, Channel::kGreen, Channel::kBlue})
          *out++ = std::clamp(tile->value(c, i, j), 0.0F, 1.0F);
      }
    }
  }
};

/// The color of ground that has no map.
class DrawnColors : public MadeValues {
 public:
  DrawnColors(SurfacePointer surface, int level) : MadeValues(std::move(surface), level, 3) {}

  void read(int d, int i0, int j0, int side, float* out) const override {
    const auto tile = tile_at(d, i0, j0);
    const auto directions = globe::planet::node_directions(tile->id);
    for (int j = j0; j <= j0 + side; ++j) {
      for (int i = i0; i <= i0 + side; ++i) {
        const glm::vec3 color =
            globe::planet::albedo(globe::planet::ground_at(surface(), *tile, directions, i, j));
        out = std::copy_n(&color.x, 3, out);
      }
    }
  }
};

}  // namespace

std::unique_ptr<NodeValues> node_heights(SurfacePointer surface, int level, HeightKind kind) {
  const Dataset* data = surface->dataset();
  const bool stored = data != nullptr && level <= surface->data_level() && surface->insets().empty();
  if (stored) {
    const bool filtered = kind == HeightKind::kFiltered && data->layer("relief") != nullptr;
    return std::make_unique<StoredHeights>(std::move(surface), level, filtered ? "relief" : "height");
  }
  if (data != nullptr && kind == HeightKind::kData)
    return std::make_unique<DataHeights>(std::move(surface), level);
  return std::make_unique<MadeHeights>(std::move(surface), level, kind == HeightKind::kFiltered);
}

std::unique_ptr<NodeValues> node_colors(SurfacePointer surface, int level) {
  if (!surface->has_data()) return std::make_unique<DrawnColors>(std::move(surface), level);
  if (surface->insets().empty() && level <= surface->dataset()->layer("color")->level)
    return std::make_unique<StoredColors>(std::move(surface), level);
  return std::make_unique<TileColors>(std::move(surface), level);
}

}  // namespace converters
