#include "converters/body.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace converters {
namespace {

using globe::geo::Ellipsoid;

struct KnownBody {
  const char* name;
  const Ellipsoid& ellipsoid;
  std::vector<const char*> words;  ///< that give it away in a file's name or description
};

const std::vector<KnownBody>& known_bodies() {
  static const std::vector<KnownBody> bodies{
      {"earth", globe::geo::kWgs84, {"earth", "etopo", "gebco", "srtm", "bluemarble", "blue marble"}},
      {"moon", globe::geo::kMoon, {"moon", "lunar", "luna", "gld100", "lola"}},
      {"mars", globe::geo::kMars, {"mars", "martian", "mola", "megt", "megr"}}};
  return bodies;
}

}  // namespace

std::string body_of(const Ellipsoid& ellipsoid) {
  for (const KnownBody& body : known_bodies()) {
    if (body.ellipsoid == ellipsoid) return body.name;
  }
  return "other";
}

std::string hinted_body(const RasterInfo& info) {
  std::string text = info.name + " " + info.description;
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const KnownBody& body : known_bodies()) {
    const auto says = [&](const char* word) { return text.find(word) != std::string::npos; };
    if (std::any_of(body.words.begin(), body.words.end(), says)) return body.name;
  }
  return "";
}

}  // namespace converters
