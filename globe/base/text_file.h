#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace globe {

/// All of a file. Throws Error when it cannot be read, is a folder, or is longer than `longest` bytes.
std::string read_text_file(const std::filesystem::path& file, std::size_t longest);

}  // namespace globe
