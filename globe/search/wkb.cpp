#include "globe/search/wkb.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace globe::search {
namespace {

static_assert(std::endian::native == std::endian::little);

enum Type : std::uint32_t { kPoint = 1, kLineString = 2, kPolygon = 3, kGeometryCollection = 7 };

template <typename Value>
void append(std::string& bytes, Value value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append_header(std::string& bytes, Type type) {
  constexpr char kLittleEndian = 1;
  bytes += kLittleEndian;
  append<std::uint32_t>(bytes, type);
}

void append_count(std::string& bytes, std::size_t count) { append(bytes, static_cast<std::uint32_t>(count)); }

void append_place(std::string& bytes, const geo::Geodetic& at) {
  append(bytes, at.lon_deg);
  append(bytes, at.lat_deg);
}

void append_places(std::string& bytes, const geo::Geometry::Line& line, bool closed) {
  append_count(bytes, line.size() + (closed ? 1 : 0));
  for (const geo::Geodetic& at : line) append_place(bytes, at);
  if (closed) append_place(bytes, line.front());
}

/// Takes values off the front. Once something is wrong, it stays so, and what is taken means nothing.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  bool good() const { return good_; }
  bool at_end() const { return bytes_.empty(); }

  template <typename Value>
  Value take() {
    Value value{};
    good_ = good_ && bytes_.size() >= sizeof value;
    if (!good_) return value;
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
    return value;
  }

  Type header() {
    good_ = take<std::uint8_t>() == 1 && good_;
    return static_cast<Type>(take<std::uint32_t>());
  }

  /// A number of things that take so many bytes each at least.
  std::uint32_t count(std::size_t size) {
    const auto number = take<std::uint32_t>();
    good_ = good_ && bytes_.size() / size >= number;
    return good_ ? number : 0;
  }

  geo::Geodetic place() {
    geo::Geodetic at;
    at.lon_deg = take<double>();
    at.lat_deg = take<double>();
    good_ = good_ && std::abs(at.lat_deg) <= 90.0 && std::isfinite(at.lon_deg);
    return at;
  }

  geo::Geometry::Line places(bool closed) {
    constexpr std::size_t kPlace = 2 * sizeof(double);
    geo::Geometry::Line line(count(kPlace));
    for (geo::Geodetic& at : line) at = place();
    good_ = good_ && line.size() >= (closed ? 4 : 2);
    if (good_ && closed) line.pop_back();
    return line;
  }

 private:
  std::string_view bytes_;
  bool good_ = true;
};

}  // namespace

std::string to_wkb(const geo::Geometry& geometry) {
  std::string bytes;
  append_header(bytes, kGeometryCollection);
  append_count(bytes, geometry.points.size() + geometry.lines.size() + geometry.polygons.size());
  for (const geo::Geodetic& point : geometry.points) {
    append_header(bytes, kPoint);
    append_place(bytes, point);
  }
  for (const geo::Geometry::Line& line : geometry.lines) {
    append_header(bytes, kLineString);
    append_places(bytes, line, false);
  }
  for (const geo::Geometry::Rings& rings : geometry.polygons) {
    append_header(bytes, kPolygon);
    append_count(bytes, rings.size());
    for (const geo::Geometry::Line& ring : rings) append_places(bytes, ring, true);
  }
  return bytes;
}

std::optional<geo::Geometry> from_wkb(std::string_view bytes) {
  constexpr std::size_t kSmallest = 5;
  Reader reader(bytes);
  if (reader.header() != kGeometryCollection) return std::nullopt;
  geo::Geometry geometry;
  for (std::uint32_t left = reader.count(kSmallest); left > 0 && reader.good(); --left) {
    const Type type = reader.header();
    if (type == kPoint) {
      geometry.points.push_back(reader.place());
    } else if (type == kLineString) {
      geometry.lines.push_back(reader.places(false));
    } else if (type == kPolygon) {
      geometry.polygons.emplace_back(reader.count(sizeof(std::uint32_t)));
      for (geo::Geometry::Line& ring : geometry.polygons.back()) ring = reader.places(true);
    } else {
      return std::nullopt;
    }
  }
  if (!reader.good() || !reader.at_end()) return std::nullopt;
  return geometry;
}

}  // namespace globe::search
