#include "globe/base/text_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "globe/base/error.h"
#include "globe/base/pending_file.h"

namespace globe {

std::string read_text_file(const std::filesystem::path& file, std::size_t longest) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw Error(file.string(), "it is a folder", "give the name of a file");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw Error(file.string(), errno != 0 ? std::strerror(errno) : "it cannot be opened",
                "check the name and its permissions");
  std::string text;
  std::string block(std::size_t{1} << 16, '\0');
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())), stream.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > longest)
      throw Error(file.string(), "it is longer than " + std::to_string(longest >> 20) + " MiB",
                  "give a file of that kind");
  }
  if (stream.bad()) throw Error(file.string(), "reading fails", "check the disk");
  return text;
}

void write_text_file(const std::filesystem::path& file, const std::string& text, bool overwrite) {
  PendingFile pending(file, overwrite);
  {
    std::ofstream stream(pending.temporary(), std::ios::binary);
    stream << text;
    if (!stream.flush())
      throw Error(file.string(), "cannot be written", "check the folder and the free space");
  }
  pending.publish();
}

}  // namespace globe
