#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

struct tiff;

namespace globe::planet {

/// How one level of a layer lies in a TIFF: tiles of tile_size x tile_size samples, deflated
/// (planet/tile_packer.h); those at the right and lower rims hold whole tiles too.
struct TiffLevel {
  int width = 0;   ///< samples
  int height = 0;  ///< likewise
  int channels = 1;
  std::string storage = "float32";  ///< as in LayerInfo
  int tile_size = 128;

  std::size_t sample_bytes() const;  ///< of all channels
  std::size_t tile_bytes() const;
  int tiles_across() const { return (width + tile_size - 1) / tile_size; }
  int tiles_down() const { return (height + tile_size - 1) / tile_size; }
};

/// A rectangle of samples in memory, channels interleaved.
struct SampleRect {
  const void* first = nullptr;
  int width = 0, height = 0;  ///< samples
  int stride = 0;             ///< samples from row to row
};

/// The tile of a rectangle that begins at its sample (x, y); what lies beyond the rectangle repeats its last
/// row and column.
void cut_tile(const SampleRect& rect, int x, int y, const TiffLevel& level, std::vector<std::byte>& tile);

class TilePacker;

/// A TIFF being written, level after level. The same samples give the same bytes: no date, host or thread
/// count gets in. Every function throws Error when the file cannot be written.
class TiffWriter {
 public:
  /// `big`: BigTIFF, which files beyond 4 GiB must be.
  TiffWriter(const std::filesystem::path& path, bool big);
  ~TiffWriter();
  TiffWriter(const TiffWriter&) = delete;
  TiffWriter& operator=(const TiffWriter&) = delete;

  void begin_level(const TiffLevel& level);
  /// The tile in column ti and row tj: tile_bytes() of samples, row by row, channels interleaved.
  void write_tile(int ti, int tj, const std::vector<std::byte>& tile);
  /// The same from its compressed bytes, as TiffTiles::raw_tile gives them.
  void write_raw_tile(int ti, int tj, const std::vector<std::byte>& bytes);
  void end_level();
  /// Ends the file; sync_to_disk (planet/planet_file.h) brings it to the disk.
  void finish();

 private:
  std::uint32_t tile_index(int ti, int tj) const;
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  struct Closer {
    void operator()(tiff* file) const;
  };
  std::string message_;  ///< the library's last; it must outlive the file
  std::unique_ptr<tiff, Closer> file_;
  TiffLevel level_;
  std::unique_ptr<TilePacker> packer_;
};

/// Compressed tiles of the first level of a TIFF that TiffWriter wrote. Throws Error when it cannot be read.
class TiffTiles {
 public:
  explicit TiffTiles(const std::filesystem::path& path);
  ~TiffTiles();
  TiffTiles(const TiffTiles&) = delete;
  TiffTiles& operator=(const TiffTiles&) = delete;

  int count() const;
  /// Tiles count row by row.
  void raw_tile(int index, std::vector<std::byte>& bytes) const;

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  std::string message_;
  struct Closer {
    void operator()(tiff* file) const;
  };
  std::unique_ptr<tiff, Closer> file_;
};

}  // namespace globe::planet
