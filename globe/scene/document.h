#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace globe::scene {

struct Value;

/// A date or time, as ISO 8601.
struct Date {
  std::string iso8601;
};

using Array = std::vector<Value>;

struct Entry;

/// Keys with their values, in the order of the file.
struct Table {
  std::vector<Entry> entries;

  /// Null when there is no such key.
  const Value* find(const std::string& key) const;
};

/// A value of a TOML file, and the line that it stands on.
struct Value {
  int line = 0;  ///< from 1
  std::variant<bool, std::int64_t, double, std::string, Date, Array, Table> is;
};

struct Entry {
  std::string key;
  Value value;
};

/// The longest TOML file that is read.
inline constexpr std::size_t kLongestDocument = std::size_t{4} << 20;

/// Reads a TOML file (https://toml.io, version 1.0). Throws Error, naming file and line, when it cannot be
/// read or is none.
Value read_document(const std::filesystem::path& file);

/// The same of a text; `name` is for messages.
Value parse_document(const std::string& text, const std::string& name);

}  // namespace globe::scene
