#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "globe/planet/tiff_level.h"

namespace globe::planet {

/// Turns samples of tiles into the bytes that a TIFF holds of them: differences of neighbours (TIFF's
/// predictor 2 of bytes, 3 of floats), deflated with a checksum (compression 8).
///
/// The same samples give the same bytes on every x86-64 processor with SSE 4.2 (2008), whatever was packed
/// before; elsewhere other bytes that unpack to the same samples.
class TilePacker {
 public:
  TilePacker();
  ~TilePacker();
  TilePacker(TilePacker&&) noexcept;
  TilePacker& operator=(TilePacker&&) noexcept;

  /// `tile`: level.tile_bytes() of samples, row by row, channels interleaved. The bytes are good until the
  /// next call.
  const std::vector<std::byte>& pack(const TiffLevel& level, const std::vector<std::byte>& tile);

 private:
  struct Deflater;

  std::unique_ptr<Deflater> deflater_;
  std::vector<std::byte> differences_;
  std::vector<std::byte> packed_;
};

}  // namespace globe::planet
