#include "globe/scene/fields.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <utility>

#include "globe/base/error.h"
#include "globe/base/one_line.h"
#include "globe/base/srgb.h"
#include "globe/geo/utc.h"
#include "globe/scene/nearest_word.h"
#include "globe/scene/quantity.h"

namespace globe::scene {
namespace {

std::string number_text(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

/// A value as a message shows it.
std::string shown(const Value& value) {
  struct Text {
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(std::int64_t number) const { return std::to_string(number); }
    std::string operator()(double number) const { return number_text(number); }
    std::string operator()(const std::string& text) const { return '"' + one_line(text, 60) + '"'; }
    std::string operator()(const Date& date) const { return date.iso8601; }
    std::string operator()(const Array&) const { return "an array"; }
    std::string operator()(const Table&) const { return "a table"; }
  };
  return std::visit(Text{}, value.is);
}

std::string range_text(const Range& range, const std::string& unit) {
  const bool low = std::isfinite(range.least), high = std::isfinite(range.most);
  const std::string end = unit.empty() ? "" : " " + unit;
  if (low && high) return " from " + number_text(range.least) + " to " + number_text(range.most) + end;
  if (low) return " of at least " + number_text(range.least) + end;
  if (high) return " of at most " + number_text(range.most) + end;
  return "";
}

/// An Error's text taken apart again: what is wrong, and what to do.
std::pair<std::string, std::string> parts_of(const Error& error) {
  const std::string text = error.what();
  const std::size_t cut = text.rfind("; ");
  return {text.substr(0, cut), cut == std::string::npos ? "see README" : text.substr(cut + 2)};
}

}  // namespace

Fields::Fields(const Value& document, std::filesystem::path file)
    : Fields(std::get<Table>(document.is), std::move(file), "", document.line) {}

Fields::Fields(const Table& table, std::filesystem::path file, std::string name, int line)
    : table_(&table), file_(std::move(file)), name_(std::move(name)), line_(line) {}

std::string Fields::name_of(const std::string& key) const {
  return name_.empty() || key.empty() ? name_ + key : name_ + "." + key;
}

void Fields::refuse(const std::string& key, const std::string& why, const std::string& what_to_do) const {
  const Value* value = key.empty() ? nullptr : table_->find(key);
  const std::string name = name_of(key);
  throw Error(file_.string() + ":" + std::to_string(value != nullptr ? value->line : line_) +
                  (name.empty() ? "" : ": " + one_line(name)),
              one_line(why), what_to_do);
}

void Fields::refuse_type(const std::string& key, const Value& value, const std::string& expected,
                         const std::string& what_to_do) const {
  refuse(key, shown(value) + " is not " + expected, what_to_do);
}

const Value* Fields::asked(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  return table_->find(key);
}

std::optional<double> Fields::quantity(const std::string& key, const Range& range, const std::string& kind,
                                       const std::string& unit, const std::string& example,
                                       std::optional<double> (*parse)(const std::string&)) {
  const Value* value = asked(key);
  if (value == nullptr) return std::nullopt;
  std::optional<double> number;
  if (const auto* integer = std::get_if<std::int64_t>(&value->is)) number = static_cast<double>(*integer);
  if (const auto* real = std::get_if<double>(&value->is)) number = *real;
  if (const auto* text = std::get_if<std::string>(&value->is); text != nullptr && parse != nullptr)
    number = parse(*text);
  if (!number || !std::isfinite(*number) || *number < range.least || *number > range.most) {
    refuse_type(key, *value, kind + range_text(range, unit), "write " + example);
  }
  return number;
}

std::optional<double> Fields::number(const std::string& key, const Range& range) {
  return quantity(key, range, "a number", "", "a number, without quotes", nullptr);
}

std::optional<double> Fields::length_m(const std::string& key, const Range& range) {
  return quantity(key, range, "a length", "m", "metres as a number, or a text such as \"120 km\"",
                  parse_metres);
}

std::optional<double> Fields::angle_deg(const std::string& key, const Range& range) {
  return quantity(key, range, "an angle", "deg", "degrees as a number, or a text such as \"15 deg\"",
                  parse_degrees);
}

std::optional<double> Fields::duration_s(const std::string& key, const Range& range) {
  return quantity(key, range, "a time", "s", "seconds as a number, or a text such as \"2 min\"",
                  parse_seconds);
}

std::optional<int> Fields::integer(const std::string& key, int least, int most) {
  const Value* value = asked(key);
  if (value == nullptr) return std::nullopt;
  const auto* integer = std::get_if<std::int64_t>(&value->is);
  if (integer == nullptr || *integer < least || *integer > most) {
    refuse_type(key, *value, "a whole number from " + std::to_string(least) + " to " + std::to_string(most),
                "write a number in that range, without quotes");
  }
  return static_cast<int>(*integer);
}

std::optional<bool> Fields::flag(const std::string& key) {
  const Value* value = asked(key);
  if (value == nullptr) return std::nullopt;
  const auto* flag = std::get_if<bool>(&value->is);
  if (flag == nullptr) refuse_type(key, *value, "true or false", "write true or false, without quotes");
  return *flag;
}

std::optional<std::string> Fields::text(const std::string& key) {
  const Value* value = asked(key);
  if (value == nullptr) return std::nullopt;
  const auto* text = std::get_if<std::string>(&value->is);
  if (text == nullptr || text->empty()) refuse_type(key, *value, "a text", "write it in quotes");
  return *text;
}

std::optional<std::string> Fields::choice(const std::string& key, const std::vector<std::string>& words) {
  std::optional<std::string> word = text(key);
  if (!word || std::find(words.begin(), words.end(), *word) != words.end()) return word;
  const auto nearest = nearest_word(*word, words);
  refuse(key, '"' + *word + "\" is not " + listed(words, "or"),
         nearest ? "did you mean \"" + *nearest + "\"?" : "write one of them in quotes");
}

std::optional<glm::vec3> Fields::light(const std::string& key) {
  const std::optional<glm::vec3> srgb = color(key);
  if (!srgb) return srgb;
  return glm::vec3(linear_from_srgb(srgb->r), linear_from_srgb(srgb->g), linear_from_srgb(srgb->b));
}

std::optional<glm::vec3> Fields::color(const std::string& key) {
  const std::optional<std::string> word = text(key);
  if (!word) return std::nullopt;
  unsigned value = 0;
  const auto [end, error] = std::from_chars(word->data(), word->data() + word->size(), value, 16);
  if (word->size() != 6 || error != std::errc() || end != word->data() + word->size())
    refuse(key, '"' + *word + "\" is not a colour",
           "write six hexadecimal digits \"RRGGBB\", such as \"ff00ff\"");
  return glm::vec3(static_cast<float>(value >> 16 & 255u), static_cast<float>(value >> 8 & 255u),
                   static_cast<float>(value & 255u)) /
         255.0f;
}

std::optional<geo::Point> Fields::place(const std::string& key) {
  const std::optional<std::string> word = text(key);
  if (!word) return std::nullopt;
  try {
    const geo::Point point = geo::parse_point(*word);
    if (!std::isfinite(point.position.h_m))
      refuse(key, "the altitude is not a finite number", "write metres, or km, ft, mi, nmi");
    return point;
  } catch (const UsageError& error) {
    const auto [why, what_to_do] = parts_of(error);
    refuse(key, why, what_to_do);
  }
}

std::optional<Fields::Look> Fields::look(const std::string& key) {
  const std::optional<std::string> word = text(key);
  if (!word) return std::nullopt;
  const std::size_t comma = word->find(',');
  const auto heading = parse_plain(word->substr(0, comma));
  const auto pitch = comma == std::string::npos ? std::nullopt : parse_plain(word->substr(comma + 1));
  if (!heading || !pitch || !std::isfinite(*heading) || !(std::abs(*pitch) <= 90.0)) {
    refuse(key, '"' + *word + "\" is not a heading and a pitch in [-90, 90]",
           "write \"HEADING,PITCH\" in degrees, such as \"45,-10\"");
  }
  return Look{*heading, *pitch};
}

std::optional<std::string> Fields::date(const std::string& key) {
  const Value* value = asked(key);
  if (value == nullptr) return std::nullopt;
  std::string text;
  if (const auto* date = std::get_if<Date>(&value->is)) text = date->iso8601;
  if (const auto* word = std::get_if<std::string>(&value->is)) text = *word;
  try {
    geo::parse_utc(text);
  } catch (const UsageError& error) {
    refuse_type(key, *value, "a date and time", parts_of(error).second);
  }
  return text;
}

std::optional<std::filesystem::path> Fields::file(const std::string& key) {
  const std::optional<std::string> name = text(key);
  if (!name) return std::nullopt;
  std::filesystem::path path = file_.parent_path() / *name;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
    refuse(key, "there is no file " + path.string(), "check the name; it counts from the scene's folder");
  return path;
}

std::optional<Fields> Fields::table(const std::string& key) {
  const Value* value = asked(key);
  if (value == nullptr) return std::nullopt;
  const auto* table = std::get_if<Table>(&value->is);
  if (table == nullptr)
    refuse_type(key, *value, "a table", "write [" + name_of(key) + "] and its keys below");
  return Fields(*table, file_, name_of(key), value->line);
}

std::vector<Fields> Fields::tables(const std::string& key) {
  std::vector<Fields> tables;
  const Value* value = asked(key);
  if (value == nullptr) return tables;
  const auto* array = std::get_if<Array>(&value->is);
  if (array == nullptr)
    refuse_type(key, *value, "an array of tables", "write [[" + name_of(key) + "]] before each");
  for (const Value& element : *array) {
    const auto* table = std::get_if<Table>(&element.is);
    const std::string name = name_of(key) + "[" + std::to_string(tables.size()) + "]";
    if (table == nullptr)
      throw Error(file_.string() + ":" + std::to_string(element.line) + ": " + name,
                  shown(element) + " is not a table", "write [[" + name_of(key) + "]] before each");
    tables.push_back(Fields(*table, file_, name, element.line));
  }
  return tables;
}

std::vector<std::string> Fields::keys() const {
  std::vector<std::string> names;
  for (const Entry& entry : table_->entries) names.push_back(entry.key);
  return names;
}

void Fields::finish() const {
  for (const std::string& key : keys()) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    const auto nearest = nearest_word(key, known_);
    refuse(key, "there is no such key",
           nearest          ? "did you mean " + *nearest + "?"
           : known_.empty() ? "leave it out; nothing can be said here"
                            : "known here: " + listed(known_));
  }
}

}  // namespace globe::scene
