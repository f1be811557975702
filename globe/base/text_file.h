#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace globe {

/// All of a file. Throws Error when it cannot be read, is a folder, or is longer than `longest` bytes.
std::string read_text_file(const std::filesystem::path& file, std::size_t longest);

/// Writes a file, whole or not at all. Throws Error when that fails, or the file exists and `overwrite` is
/// false.
void write_text_file(const std::filesystem::path& file, const std::string& text, bool overwrite);

}  // namespace globe
