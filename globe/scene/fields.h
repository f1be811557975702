#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "globe/geo/point.h"
#include "globe/scene/document.h"

namespace globe::scene {

/// What a number may be, both ends included.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
};
inline constexpr Range at_least(double least) { return {least}; }
inline constexpr Range kAnyNumber{};

/// The keys of one table of a scene file, read by name and type. What is wrong with one is refused by an
/// Error of one line, "FILE:LINE: TABLE.KEY: WHY; WHAT TO DO".
///
/// Each reader gives nothing when the key is not there; `.value_or(...)` says what holds then. Numbers are
/// finite. Quantities are numbers in the unit named by the reader, or texts with a unit ("120 km"). Who is
/// done calls finish(), which refuses the keys that nobody asked for.
///
///     const double density = fields.number("density", {0.0, 1.0}).value_or(0.5);
///     const double top_m = fields.length_m("top", at_least(0.0)).value_or(300.0);
///     fields.finish();
class Fields {
 public:
  /// @param document  a file's own table, which must live longer than this; @param file  where relative paths
  /// start from, and for messages
  Fields(const Value& document, std::filesystem::path file);

  std::optional<double> number(const std::string& key, const Range& range = kAnyNumber);
  std::optional<int> integer(const std::string& key, int least, int most);
  std::optional<double> length_m(const std::string& key, const Range& range = kAnyNumber);
  std::optional<double> angle_deg(const std::string& key, const Range& range = kAnyNumber);
  std::optional<double> duration_s(const std::string& key, const Range& range = kAnyNumber);
  std::optional<bool> flag(const std::string& key);
  std::optional<std::string> text(const std::string& key);
  /// One of some words.
  std::optional<std::string> choice(const std::string& key, const std::vector<std::string>& words);
  /// "RRGGBB" as sRGB in [0, 1].
  std::optional<glm::vec3> color(const std::string& key);
  /// The same as linear light, channel by channel in [0, 1].
  std::optional<glm::vec3> light(const std::string& key);
  /// "LAT,LON[,ALT]" in any form that geo::parse_point reads.
  std::optional<geo::Point> place(const std::string& key);
  /// "HEADING,PITCH" in degrees, the pitch in [-90, 90].
  struct Look {
    double heading_deg = 0;
    double pitch_deg = 0;
  };
  std::optional<Look> look(const std::string& key);
  /// A date, with or without a time of day: TOML's own or a text; checked.
  std::optional<std::string> date(const std::string& key);
  /// A file that is there; a relative name counts from the scene's folder.
  std::optional<std::filesystem::path> file(const std::string& key);
  /// A table of its own.
  std::optional<Fields> table(const std::string& key);
  /// [[key]]: any number of tables; none when the key is not there.
  std::vector<Fields> tables(const std::string& key);

  bool has(const std::string& key) const { return table_->find(key) != nullptr; }
  /// The value of a key that has to be there.
  template <class T>
  T required(const std::string& key, std::optional<T> value, const std::string& what_to_do) const {
    if (!value) refuse("", key + " is missing", what_to_do);
    return *std::move(value);
  }

  /// Refuses every key that was not asked for, with the known one it is most like.
  void finish() const;

  /// Throws the Error of one line: about a key, or about the table when `key` is empty.
  [[noreturn]] void refuse(const std::string& key, const std::string& why,
                           const std::string& what_to_do) const;

  /// Names of the keys, in the file's order.
  std::vector<std::string> keys() const;
  int line() const { return line_; }
  const std::filesystem::path& file_name() const { return file_; }

 private:
  Fields(const Table& table, std::filesystem::path file, std::string name, int line);

  /// The value of a key, which is known from now on; null when it is not there.
  const Value* asked(const std::string& key);
  std::optional<double> quantity(const std::string& key, const Range& range, const std::string& kind,
                                 const std::string& unit, const std::string& example,
                                 std::optional<double> (*parse)(const std::string&));
  [[noreturn]] void refuse_type(const std::string& key, const Value& value, const std::string& expected,
                                const std::string& what_to_do) const;
  std::string name_of(const std::string& key) const;

  const Table* table_;
  std::filesystem::path file_;
  std::string name_;  ///< "path.keys[2]"; empty for the file's own table
  int line_ = 1;
  std::vector<std::string> known_;
};

}  // namespace globe::scene
