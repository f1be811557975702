#include "globe/scene/track_file.h"

#include <algorithm>
#include <utility>

#include "globe/base/error.h"
#include "globe/base/text_file.h"
#include "globe/scene/xml_file.h"

namespace globe::scene {

std::vector<PathKey> read_track_file(const std::filesystem::path& file, std::optional<bool> agl) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (ending != ".kml" && ending != ".kmz" && ending != ".gpx" && ending != ".csv")
    throw Error(file.string(), "a path is read from .kml, .kmz, .gpx or .csv files",
                "convert it to one of them");
  if (ending == ".kmz") {
    KmlText kml = read_kmz(file);
    return read_kml(std::move(kml.text), kml.name, agl);
  }
  std::string text = read_text_file(file, XmlFile::kLongest);
  if (ending == ".kml") return read_kml(std::move(text), file.string(), agl);
  if (ending == ".gpx") return read_gpx(std::move(text), file.string(), agl);
  return read_track_csv(text, file.string(), agl);
}

}  // namespace globe::scene
