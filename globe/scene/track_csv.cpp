#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <sstream>
#include <string_view>

#include "globe/base/csv_reader.h"
#include "globe/base/error.h"
#include "globe/base/one_line.h"
#include "globe/geo/utc.h"
#include "globe/scene/quantity.h"
#include "globe/scene/track_file.h"

namespace globe::scene {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

struct Columns {
  std::size_t lat = kNone, lon = kNone, alt = kNone, time = kNone, heading = kNone, pitch = kNone;
};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

std::size_t column(const CsvRecord& header, std::initializer_list<std::string_view> names) {
  for (std::size_t k = 0; k < header.fields.size(); ++k) {
    const std::string field = lower(header.fields[k]);
    if (std::find(names.begin(), names.end(), field) != names.end()) return k;
  }
  return kNone;
}

[[noreturn]] void refuse(const std::string& file, std::size_t line, const std::string& why,
                         const std::string& what_to_do) {
  throw Error(file + ":" + std::to_string(line), why, what_to_do);
}

Columns columns_of(const CsvRecord& header, const std::string& file) {
  Columns columns{
      column(header, {"lat", "latitude", "lat_deg"}),
      column(header, {"lon", "lng", "long", "longitude", "lon_deg"}),
      column(header, {"alt", "altitude", "height", "ele", "elevation", "alt_m", "height_m", "h_m"}),
      column(header, {"time", "t", "timestamp", "time_s"}),
      column(header, {"heading", "heading_deg", "azimuth"}),
      column(header, {"pitch", "pitch_deg"})};
  if (columns.lat == kNone || columns.lon == kNone || columns.alt == kNone)
    refuse(file, header.line, "the first line does not name the columns lat, lon and alt",
           "begin with a line such as lat,lon,alt,time");
  if ((columns.heading == kNone) != (columns.pitch == kNone))
    refuse(file, header.line, "heading and pitch belong together", "give both columns or none");
  return columns;
}

double number_at(const CsvRecord& record, std::size_t column, const std::string& what,
                 const std::string& file) {
  const std::string text = column < record.fields.size() ? record.fields[column] : "";
  const auto value = parse_plain(text);
  if (!value || !std::isfinite(*value))
    refuse(file, record.line, what + " is \"" + one_line(text, 40) + "\", not a number", "write a number");
  return *value;
}

}  // namespace

std::vector<PathKey> read_track_csv(const std::string& text, const std::string& file,
                                    std::optional<bool> agl) {
  std::istringstream stream(text);
  CsvReader reader(stream);
  std::optional<Columns> columns;
  std::optional<geo::UtcDate> first;
  std::vector<PathKey> keys;
  while (const std::optional<CsvRecord> record = reader.next()) {
    if (!record->fault.empty()) refuse(file, record->line, record->fault, "mend the line");
    if (!columns) {
      columns = columns_of(*record, file);
      continue;
    }
    PathKey key;
    key.line = static_cast<int>(record->line);
    key.place = {number_at(*record, columns->lat, "lat", file), number_at(*record, columns->lon, "lon", file),
                 number_at(*record, columns->alt, "alt", file)};
    key.above_ground = agl.value_or(false);
    if (columns->heading != kNone) {
      key.look = Look{number_at(*record, columns->heading, "heading", file),
                      number_at(*record, columns->pitch, "pitch", file)};
      if (std::abs(key.look->pitch_deg) > 90.0)
        refuse(file, record->line, "the pitch is beyond 90 degrees",
               "write -90 for straight down, 0 for level");
    }
    if (columns->time != kNone) {
      const std::string word = columns->time < record->fields.size() ? record->fields[columns->time] : "";
      if (const auto seconds = parse_plain(word)) {
        key.time_s = *seconds;
      } else {
        try {
          const geo::UtcDate date = geo::parse_utc(word);
          if (!first) first = date;
          key.time_s = geo::seconds_between(*first, date);
        } catch (const UsageError&) {
          refuse(file, record->line,
                 "time is \"" + one_line(word, 40) + "\", neither seconds nor a date and time",
                 "write seconds, or 2026-03-21T10:00:00Z");
        }
      }
    }
    keys.push_back(key);
  }
  require_path(keys, file);
  return keys;
}

}  // namespace globe::scene
