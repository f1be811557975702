#include <minizip/unzip.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <type_traits>

#include "globe/base/error.h"
#include "globe/scene/track_file.h"
#include "globe/scene/xml_file.h"

// KMZ (OGC 12-007r2, annex C): a zip archive whose first .kml file, doc.kml as a rule, is what is shown.

namespace globe::scene {
namespace {

constexpr int kMostFiles = 100'000;  ///< of an archive that are looked at
constexpr unsigned long kEncrypted = 1;

struct CloseArchive {
  void operator()(void* archive) const { unzClose(archive); }
};
using Archive = std::unique_ptr<std::remove_pointer_t<unzFile>, CloseArchive>;

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
  throw Error(file, why, "make the .kmz file anew, or give the .kml inside");
}

bool ends_in_kml(std::string name) {
  if (name.size() < 4) return false;
  name.erase(0, name.size() - 4);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return name == ".kml";
}

/// Goes to the first .kml file at the archive's top, or where there is none anywhere below; its name.
std::string go_to_kml(unzFile archive, const std::string& file) {
  std::string below;
  unz_file_pos below_at{};
  int status = unzGoToFirstFile(archive);
  for (int k = 0; status == UNZ_OK && k < kMostFiles; ++k) {
    std::array<char, 1024> name{};
    unz_file_info about{};
    if (unzGetCurrentFileInfo(archive, &about, name.data(), name.size() - 1, nullptr, 0, nullptr, 0) !=
        UNZ_OK)
      refuse(file, "its table of contents is damaged");
    if (ends_in_kml(name.data())) {
      const std::string found = name.data();
      if (found.find('/') == std::string::npos) return found;
      if (below.empty() && unzGetFilePos(archive, &below_at) == UNZ_OK) below = found;
    }
    status = unzGoToNextFile(archive);
  }
  if (below.empty() || unzGoToFilePos(archive, &below_at) != UNZ_OK)
    refuse(file, "there is no .kml file in it");
  return below;
}

}  // namespace

KmlText read_kmz(const std::filesystem::path& path) {
  const std::string file = path.string();
  const Archive archive(unzOpen64(file.c_str()));
  if (!archive) refuse(file, "it cannot be opened as a zip archive");
  KmlText kml;
  kml.name = file + "/" + go_to_kml(archive.get(), file);
  unz_file_info about{};
  unzGetCurrentFileInfo(archive.get(), &about, nullptr, 0, nullptr, 0, nullptr, 0);
  if ((about.flag & kEncrypted) != 0) refuse(kml.name, "it is encrypted");
  if (unzOpenCurrentFile(archive.get()) != UNZ_OK) refuse(kml.name, "its compression is not known here");
  // The size that an archive tells may be anything.
  std::string block(std::size_t{1} << 16, '\0');
  int got = 0;
  while ((got = unzReadCurrentFile(archive.get(), block.data(), static_cast<unsigned>(block.size()))) > 0) {
    kml.text.append(block.data(), static_cast<std::size_t>(got));
    if (kml.text.size() > XmlFile::kLongest)
      refuse(kml.name, "it is longer than " + std::to_string(XmlFile::kLongest >> 20) + " MiB");
  }
  if (got < 0 || unzCloseCurrentFile(archive.get()) != UNZ_OK) refuse(kml.name, "its bytes are damaged");
  return kml;
}

}  // namespace globe::scene
