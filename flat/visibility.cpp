#include "flat/visibility.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <mutex>

#include "globe/base/error.h"
#include "globe/base/pending_file.h"

namespace globe::flat {
namespace {

constexpr std::array<char, 8> kMagic{'g', 'l', 'o', 'b', 'e', 'p', 'v', '1'};
constexpr double kHeights = 3.0;  ///< of the ground that the layers go up to

/// FNV-1a over what the mesh is made of.
std::uint64_t hash_of(const Terrain& terrain) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&](std::uint32_t word) { hash = (hash ^ word) * 0x100000001b3u; };
  for (const float z : terrain.z()) {
    std::uint32_t word = 0;
    std::memcpy(&word, &z, sizeof word);
    add(word);
  }
  add(static_cast<std::uint32_t>(terrain.posts().columns));
  add(static_cast<std::uint32_t>(std::lround(terrain.spacing_m() * 1024.0)));
  return hash;
}

/// The strip of posts that every line of sight between two patches crosses. `along` counts posts from one to
/// the other on the axis on which they are farther apart, `across` those of the other axis.
class Strip {
 public:
  Strip(const Terrain& terrain, int from_column, int from_row, int to_column, int to_row)
      : terrain_(terrain), swapped_(std::abs(to_row - from_row) > std::abs(to_column - from_column)) {
    if (swapped_) {
      std::swap(from_column, from_row);
      std::swap(to_column, to_row);
    }
    backward_ = to_column < from_column;
    count_ =
        (std::abs(to_column - from_column) - 1) * kPatchCells;  // posts 0 and count_ are the patches' sides
    first_along_ = (backward_ ? from_column : from_column + 1) * kPatchCells;
    from_across_ = from_row * kPatchCells;
    shift_ = (to_row - from_row) * kPatchCells;
    length_ = count_ + kPatchCells;
    most_across_ = swapped_ ? terrain.posts().columns - 1 : terrain.posts().rows - 1;
  }

  int count() const { return count_; }
  /// The posts across at one along, those just beyond the lines between corresponding corners included.
  int low(int along) const {
    const double slope = static_cast<double>(shift_) / length_;
    const double at =
        shift_ >= 0 ? from_across_ + slope * along : from_across_ + slope * (along + kPatchCells);
    return std::max(static_cast<int>(std::floor(at)), 0);
  }
  int high(int along) const {
    const double slope = static_cast<double>(shift_) / length_;
    const double at =
        from_across_ + kPatchCells + (shift_ >= 0 ? slope * (along + kPatchCells) : slope * along);
    return std::min(static_cast<int>(std::ceil(at)), most_across_);
  }
  float z(int along, int across) const {
    const int main = first_along_ + (backward_ ? -along : along);
    return swapped_ ? terrain_.z(across, main) : terrain_.z(main, across);
  }
  /// Whether an edge of the mesh joins post (along, across) to (along + 1, across + rise), rise 1 or -1.
  bool has_diagonal(int along, int across, int rise) const {
    const int main = first_along_ + (backward_ ? -along - 1 : along);
    const int cell_across = rise > 0 ? across : across - 1;
    const bool up = backward_ ? rise < 0 : rise > 0;  // as main and across grow together
    return splits_north_east(main, cell_across) == up;
  }

 private:
  const Terrain& terrain_;
  bool swapped_, backward_ = false;
  int count_ = 0, first_along_ = 0, from_across_ = 0, shift_ = 0, most_across_ = 0;
  double length_ = 1;
};

/// Whether posts not lower than any line of sight make a wall across the strip. Lines lead from no higher
/// than `eye_m` to no higher than `top_m`.
bool is_walled(const Strip& strip, double eye_m, double top_m, std::vector<std::uint8_t>& state) {
  const int count = strip.count();
  int lowest = strip.low(0), highest = strip.high(0);
  lowest = std::min(lowest, strip.low(count));
  highest = std::max(highest, strip.high(count));
  const int width = highest - lowest + 1;
  // 0: too low, 1: high enough, 2: reached from the low side.
  state.assign(static_cast<std::size_t>(count + 1) * static_cast<std::size_t>(width), 0);
  const auto index = [&](int along, int across) {
    return static_cast<std::size_t>(along) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(across - lowest);
  };
  const double before = top_m >= eye_m ? kPatchCells : 0.0;  // how far behind the near side the line begins
  const double slope = (top_m - eye_m) / (count + kPatchCells);
  std::vector<std::pair<int, int>> reached;
  for (int along = 0; along <= count; ++along) {
    const double line = eye_m + slope * (along + before);
    for (int across = strip.low(along); across <= strip.high(along); ++across)
      state[index(along, across)] = static_cast<double>(strip.z(along, across)) >= line ? 1 : 0;
    if (state[index(along, strip.low(along))] == 1) reached.emplace_back(along, strip.low(along));
  }
  for (const auto& [along, across] : reached) state[index(along, across)] = 2;
  while (!reached.empty()) {
    const auto [along, across] = reached.back();
    reached.pop_back();
    if (across >= strip.high(along)) return true;
    const auto go = [&](int to_along, int to_across) {
      if (to_along < 0 || to_along > count || to_across < strip.low(to_along) ||
          to_across > strip.high(to_along) || state[index(to_along, to_across)] != 1)
        return;
      state[index(to_along, to_across)] = 2;
      reached.emplace_back(to_along, to_across);
    };
    go(along + 1, across);
    go(along - 1, across);
    go(along, across + 1);
    go(along, across - 1);
    for (const int rise : {1, -1}) {
      if (strip.has_diagonal(along, across, rise)) go(along + 1, across + rise);
      if (along > 0 && strip.has_diagonal(along - 1, across - rise, rise)) go(along - 1, across - rise);
    }
  }
  return false;
}

}  // namespace

Visibility::Visibility(const Terrain& terrain)
    : ground_(hash_of(terrain)),
      east_(terrain.patches_east()),
      north_(terrain.patches_north()),
      west_m_(terrain.x_m(0)),
      south_m_(terrain.y_m(0)),
      patch_m_(kPatchCells * terrain.spacing_m()),
      first_seen_(terrain.patch_count() * terrain.patch_count(), 0) {
  double high = -1e30;
  low_m_ = 1e30;
  for (std::size_t k = 0; k < terrain.patch_count(); ++k) {
    low_m_ = std::min(low_m_, static_cast<double>(terrain.patch(k).lowest_m));
    high = std::max(high, static_cast<double>(terrain.patch(k).highest_m));
  }
  layer_m_ = std::max(kHeights * (high - low_m_), 1.0) / kLayers;
}

Visibility Visibility::compute(const Terrain& terrain, const std::function<void(double)>& progress) {
  Visibility sets(terrain);
  const std::size_t count = terrain.patch_count();
  std::mutex telling;
  std::size_t done = 0;
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t from) {
    std::vector<std::uint8_t> state;
    const int column = static_cast<int>(from) % sets.east_, row = static_cast<int>(from) / sets.east_;
    for (std::size_t to = 0; to < count; ++to) {
      const int to_column = static_cast<int>(to) % sets.east_, to_row = static_cast<int>(to) / sets.east_;
      if (std::max(std::abs(to_column - column), std::abs(to_row - row)) < 2) continue;
      const Strip strip(terrain, column, row, to_column, to_row);
      const auto top = static_cast<double>(terrain.patch(to).highest_m);
      // The lowest layer whose top no wall hides the patch from.
      int hidden = -1, seen = kLayers;
      while (hidden + 1 < seen) {
        const int layer = (hidden + seen) / 2;
        const bool walled = is_walled(strip, sets.low_m_ + (layer + 1) * sets.layer_m_, top, state);
        (walled ? hidden : seen) = layer;
      }
      sets.first_seen_[from * count + to] = static_cast<std::uint8_t>(seen);
    }
    if (!progress) return;
    const std::lock_guard lock(telling);
    progress(static_cast<double>(++done) / static_cast<double>(count));
  });
  return sets;
}

void Visibility::write(const std::filesystem::path& file, bool overwrite) const {
  PendingFile pending(file, overwrite);
  std::ofstream stream(pending.temporary(), std::ios::binary);
  stream.write(kMagic.data(), kMagic.size());
  stream.write(reinterpret_cast<const char*>(&ground_), sizeof ground_);
  stream.write(reinterpret_cast<const char*>(first_seen_.data()),
               static_cast<std::streamsize>(first_seen_.size()));
  stream.close();
  if (!stream) throw Error(file.string(), "cannot be written", "look for room on the disk");
  pending.publish();
}

Visibility Visibility::read(const std::filesystem::path& file, const Terrain& terrain) {
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 8> magic{};
  std::uint64_t ground = 0;
  stream.read(magic.data(), magic.size());
  stream.read(reinterpret_cast<char*>(&ground), sizeof ground);
  if (!stream || magic != kMagic)
    throw Error(file.string(), "holds no visible sets", "make them by globe flat pvs");
  Visibility sets(terrain);
  stream.read(reinterpret_cast<char*>(sets.first_seen_.data()),
              static_cast<std::streamsize>(sets.first_seen_.size()));
  if (ground != sets.ground_ || !stream || stream.peek() != std::ifstream::traits_type::eof())
    throw Error(file.string(), "was made for another region", "make it again by globe flat pvs");
  return sets;
}

std::size_t Visibility::patch_at(double x_m, double y_m) const {
  const auto column = static_cast<std::size_t>(std::clamp((x_m - west_m_) / patch_m_, 0.0, east_ - 1.0));
  const auto row = static_cast<std::size_t>(std::clamp((y_m - south_m_) / patch_m_, 0.0, north_ - 1.0));
  return row * static_cast<std::size_t>(east_) + column;
}

bool Visibility::may_see(const dvec3& eye, std::size_t patch) const {
  const double x = (eye.x - west_m_) / patch_m_, y = (eye.y - south_m_) / patch_m_;
  if (x < 0.0 || y < 0.0 || x > east_ || y > north_) return true;
  const double layer = std::floor((eye.z - low_m_) / layer_m_);
  if (layer >= kLayers) return true;
  const std::size_t count = static_cast<std::size_t>(east_) * static_cast<std::size_t>(north_);
  return layer >= first_seen_[patch_at(eye.x, eye.y) * count + patch];
}

double Visibility::hidden_share() const {
  double hidden = 0.0;
  for (const std::uint8_t layer : first_seen_) hidden += layer;
  return hidden / (static_cast<double>(first_seen_.size()) * kLayers);
}

}  // namespace globe::flat
