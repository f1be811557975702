#include "globe/search/csv_features.h"

#include <unistr.h>

#include <charconv>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "globe/base/csv_reader.h"
#include "globe/base/error.h"
#include "globe/search/same_letters.h"

namespace globe::search {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);
constexpr const char* kHowToName = "name them with --columns LAT,LON,NAME";

std::optional<std::size_t> column_number(const std::string& text) {
  std::size_t number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || stop != text.data() + text.size() || number == 0) return std::nullopt;
  return number - 1;
}

/// Why a line is left out; caught below.
struct Fault {
  std::string why;
};

/// Where things are in a record.
struct Layout {
  std::size_t lat = kNone, lon = kNone, name = kNone;
  std::vector<std::string> keys;  ///< of the properties; none: the columns' numbers
};

/// The layout that numbers give, or nothing when they are no numbers.
std::optional<Layout> layout_by_number(const Columns& columns) {
  const auto lat = column_number(columns.lat), lon = column_number(columns.lon);
  const auto name = columns.name.empty() ? std::optional(kNone) : column_number(columns.name);
  if (!lat || !lon || !name) return std::nullopt;
  return Layout{*lat, *lon, *name, {}};
}

void check_text(const std::string& text) {
  if (u8_check(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()) != nullptr)
    throw Fault{"it is not in UTF-8"};
  if (text.find('\0') != std::string::npos) throw Fault{"it holds a NUL byte"};
}

std::size_t find_column(const std::vector<std::string>& header,
                        std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    for (std::size_t k = 0; k < header.size(); ++k)
      if (same_letters(header[k], name)) return k;
  }
  return kNone;
}

Layout layout_by_header(const CsvRecord& header, const std::string& file, const Columns& columns) {
  if (!header.fault.empty()) throw Fault{header.fault};
  for (const std::string& name : header.fields) check_text(name);
  const std::string where = file + ":" + std::to_string(header.line);
  const auto find = [&](const std::string& wanted, std::initializer_list<std::string_view> usual,
                        const char* usual_text) {
    const std::size_t at =
        wanted.empty() ? find_column(header.fields, usual) : find_column(header.fields, {wanted});
    if (at == kNone && usual_text != nullptr)
      throw Error(where, "no column is called " + (wanted.empty() ? usual_text : wanted), kHowToName);
    return at;
  };
  Layout layout;
  layout.lat = find(columns.lat, {"lat", "latitude", "y"}, "lat, latitude or y");
  layout.lon = find(columns.lon, {"lon", "lng", "long", "longitude", "x"}, "lon, lng, longitude or x");
  layout.name = find(columns.name, {"name"}, columns.name.empty() ? nullptr : "name");
  std::set<std::string> taken;
  for (std::size_t k = 0; k < header.fields.size(); ++k) {
    std::string key = header.fields[k];
    if (key.empty() || !taken.insert(key).second) key += "#" + std::to_string(k + 1);
    layout.keys.push_back(std::move(key));
  }
  return layout;
}

std::string in_quotes(std::string text) {
  constexpr std::size_t kShown = 40;
  if (text.size() > kShown) text = text.substr(0, kShown) + "...";
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return "'" + text + "'";
}

double degrees(const std::vector<std::string>& fields, std::size_t column, const char* what) {
  if (column >= fields.size() || fields[column].empty()) throw Fault{std::string("it has no ") + what};
  const std::string& text = fields[column];
  double value = 0;
  const char* const first = text.data() + (text[0] == '+' ? 1 : 0);
  const char* const last = text.data() + text.size();
  const auto [stop, error] = std::from_chars(first, last, value);
  if (error != std::errc{} || stop != last || !std::isfinite(value))
    throw Fault{std::string("the ") + what + " " + in_quotes(text) + " is no number of degrees"};
  return value;
}

NewFeature feature_of(const CsvRecord& record, const Layout& layout) {
  if (!record.fault.empty()) throw Fault{record.fault};
  const std::vector<std::string>& fields = record.fields;
  if (!layout.keys.empty() && fields.size() > layout.keys.size())
    throw Fault{"it has " + std::to_string(fields.size()) + " fields, the header " +
                std::to_string(layout.keys.size())};
  for (const std::string& field : fields) check_text(field);
  geo::Geodetic at;
  at.lat_deg = degrees(fields, layout.lat, "latitude");
  at.lon_deg = degrees(fields, layout.lon, "longitude");
  if (std::abs(at.lat_deg) > 90.0)
    throw Fault{"the latitude " + in_quotes(fields[layout.lat]) + " is beyond 90 degrees"};
  NewFeature feature;
  feature.geometry.points.push_back(at);
  if (layout.name < fields.size()) feature.name = fields[layout.name];
  nlohmann::ordered_json properties;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    if (k == layout.lat || k == layout.lon || k == layout.name || fields[k].empty()) continue;
    properties[layout.keys.empty() ? std::to_string(k + 1) : layout.keys[k]] = fields[k];
  }
  if (!properties.empty()) feature.properties = properties.dump();
  return feature;
}

}  // namespace

void visit_csv(std::istream& stream, const std::string& file, const Columns& columns,
               const std::function<void(NewFeature&&, std::size_t line)>& visit,
               const std::function<void(const BadLine&)>& refuse) {
  CsvReader reader(stream);
  std::optional<Layout> layout = layout_by_number(columns);
  while (const std::optional<CsvRecord> record = reader.next()) {
    try {
      if (!layout) {
        layout = layout_by_header(*record, file, columns);
        continue;
      }
      visit(feature_of(*record, *layout), record->line);
    } catch (const Fault& fault) {
      if (!layout) throw Error(file + ":" + std::to_string(record->line), fault.why, "give a header line");
      refuse({record->line, fault.why});
    }
  }
  if (!layout) throw Error(file, "it is empty", "give a file with a header line");
}

}  // namespace globe::search
