#include "globe/scene/document.h"

#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

#include "globe/base/error.h"
#include "globe/base/one_line.h"
#include "globe/base/text_file.h"

namespace globe::scene {
namespace {

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

Value value_of(const toml::node& node);

Table table_of(const toml::table& table) {
  Table result;
  for (const auto& [key, node] : table) result.entries.push_back({std::string(key.str()), value_of(node)});
  std::stable_sort(result.entries.begin(), result.entries.end(),
                   [](const Entry& a, const Entry& b) { return a.value.line < b.value.line; });
  return result;
}

template <class T>
Date date_of(const T& value) {
  std::ostringstream text;
  text << value;
  return {text.str()};
}

// toml++ refuses files that are nested deeper than 256.
// NOLINTNEXTLINE(misc-no-recursion)
Value value_of(const toml::node& node) {
  Value value{line_of(node), false};
  if (const auto* table = node.as_table()) {
    value.is = table_of(*table);
  } else if (const auto* array = node.as_array()) {
    Array values;
    for (const toml::node& element : *array) values.push_back(value_of(element));
    value.is = std::move(values);
  } else if (const auto* text = node.as_string()) {
    value.is = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.is = integer->get();
  } else if (const auto* number = node.as_floating_point()) {
    value.is = number->get();
  } else if (const auto* flag = node.as_boolean()) {
    value.is = flag->get();
  } else if (const auto* date = node.as_date()) {
    value.is = date_of(date->get());
  } else if (const auto* time = node.as_time()) {
    value.is = date_of(time->get());
  } else if (const auto* moment = node.as_date_time()) {
    value.is = date_of(moment->get());
  }
  return value;
}

}  // namespace

const Value* Table::find(const std::string& key) const {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) { return entry.key == key; });
  return found == entries.end() ? nullptr : &found->value;
}

Value parse_document(const std::string& text, const std::string& name) {
  try {
    Value value{1, table_of(toml::parse(text, name))};
    return value;
  } catch (const toml::parse_error& error) {
    throw Error(name + ":" + std::to_string(error.source().begin.line), one_line(error.description()),
                "write TOML, as https://toml.io tells it");
  }
}

Value read_document(const std::filesystem::path& file) {
  return parse_document(read_text_file(file, kLongestDocument), file.string());
}

}  // namespace globe::scene
