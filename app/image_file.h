#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace app {

/// A picture of 8-bit RGBA, top row first, referred to.
struct Picture {
  int width = 0;
  int height = 0;
  std::span<const std::uint8_t> rgba;
};

/// Writes the colours of a picture, without alpha, as PNG. The same picture gives the same bytes on every day
/// and machine; the file is whole or absent.
///
/// Throws Error when it cannot be written, or exists and `overwrite` is false; UsageError for an extension
/// other than .png.
void write_image(const std::filesystem::path& path, const Picture& picture, bool overwrite);

/// The same for floats, as EXR: channels of the given names ("R", "G", "B"; "Z" for depth), interleaved, top
/// row first, 32 bits each.
void write_image(const std::filesystem::path& path, int width, int height,
                 const std::vector<std::string>& channels, std::span<const float> pixels, bool overwrite);

/// Writes a PNG straight to a path, for callers that publish it themselves.
void write_png(const std::filesystem::path& path, const Picture& picture);

}  // namespace app
