#include "globe/planet/tile_packer.h"

#include <libdeflate.h>

#include <cassert>
#include <cstdint>
#include <cstring>
#include <new>

namespace globe::planet {
namespace {

/// The fastest of libdeflate. (ISA-L takes half the time, but packs one tile in some ten thousand otherwise
/// by where its buffers lie in memory. Zstandard's tiles have no checksum: a flipped bit would be drawn.)
constexpr int kDeflateLevel = 1;

std::byte minus(std::byte a, std::byte b) {
  return static_cast<std::byte>(std::to_integer<unsigned>(a) - std::to_integer<unsigned>(b));
}

/// Each byte less the one `stride` before it.
void subtract_neighbours(const std::byte* row, std::size_t count, std::size_t stride, std::byte* out) {
  std::memcpy(out, row, stride);
  for (std::size_t k = stride; k < count; ++k) out[k] = minus(row[k], row[k - stride]);
}

/// The bytes of floats sorted by what they weigh, the first of all, then the second and so on.
void sort_bytes(const std::byte* row, std::size_t count, std::byte* out) {
  for (std::size_t k = 0; k < count; ++k) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, row + k * sizeof bits, sizeof bits);
    for (std::size_t b = 0; b < sizeof bits; ++b)
      out[b * count + k] = static_cast<std::byte>(bits >> (24 - 8 * b) & 0xff);
  }
}

}  // namespace

struct TilePacker::Deflater {
  struct Free {
    void operator()(libdeflate_compressor* one) const { libdeflate_free_compressor(one); }
  };
  std::unique_ptr<libdeflate_compressor, Free> compressor{libdeflate_alloc_compressor(kDeflateLevel)};
};

TilePacker::TilePacker() : deflater_(std::make_unique<Deflater>()) {
  if (deflater_->compressor == nullptr) throw std::bad_alloc();
}
TilePacker::~TilePacker() = default;
TilePacker::TilePacker(TilePacker&&) noexcept = default;
TilePacker& TilePacker::operator=(TilePacker&&) noexcept = default;

const std::vector<std::byte>& TilePacker::pack(const TiffLevel& level, const std::vector<std::byte>& tile) {
  assert(tile.size() == level.tile_bytes());
  const auto rows = static_cast<std::size_t>(level.tile_size);
  const std::size_t row_bytes = tile.size() / rows;
  const auto channels = static_cast<std::size_t>(level.channels);
  differences_.resize(tile.size());
  std::vector<std::byte> sorted(level.storage == "uint8" ? 0 : row_bytes);
  for (std::size_t row = 0; row < rows; ++row) {
    const std::byte* from = tile.data() + row * row_bytes;
    if (!sorted.empty()) {
      sort_bytes(from, row_bytes / sizeof(float), sorted.data());
      from = sorted.data();
    }
    subtract_neighbours(from, row_bytes, channels, differences_.data() + row * row_bytes);
  }

  libdeflate_compressor* const compressor = deflater_->compressor.get();
  packed_.resize(libdeflate_zlib_compress_bound(compressor, differences_.size()));
  const std::size_t size = libdeflate_zlib_compress(compressor, differences_.data(), differences_.size(),
                                                    packed_.data(), packed_.size());
  assert(size > 0);
  packed_.resize(size);
  return packed_;
}

}  // namespace globe::planet
