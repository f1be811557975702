#include "globe/search/property_test.h"

#include <charconv>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace globe::search {
namespace {

using nlohmann::json;

std::string in_json(const std::string& text) {
  return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}

template <typename Number>
std::optional<Number> number(const std::string& text) {
  Number value{};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size()) return std::nullopt;
  return value;
}

bool is(const json& property, const std::string& value) {
  if (property.is_string()) return property.get_ref<const std::string&>() == value;
  if (property.is_boolean()) return value == (property.get<bool>() ? "true" : "false");
  if (property.is_null()) return value == "null";
  if (!property.is_number()) return false;
  // Integers beyond 2^53 are told apart as integers.
  if (property.is_number_unsigned()) {
    if (const auto wanted = number<std::uint64_t>(value)) return property.get<std::uint64_t>() == *wanted;
  } else if (property.is_number_integer()) {
    if (const auto wanted = number<std::int64_t>(value)) return property.get<std::int64_t>() == *wanted;
  }
  const auto wanted = number<double>(value);
  return wanted && property.get<double>() == *wanted;
}

}  // namespace

PropertyTest::PropertyTest(std::string key, std::string value)
    : key_(std::move(key)),
      value_(std::move(value)),
      key_in_json_(in_json(key_) + ":"),
      value_in_json_(in_json(value_)) {}

bool PropertyTest::passes(std::string_view properties) const {
  // Most features fail by a look at the text: the key is nowhere, or only in front of other texts.
  bool possible = false;
  for (std::size_t at = properties.find(key_in_json_); at != std::string_view::npos && !possible;
       at = properties.find(key_in_json_, at + 1)) {
    const std::string_view rest = properties.substr(at + key_in_json_.size());
    possible = !rest.starts_with('"') || rest.starts_with(value_in_json_);
  }
  if (!possible) return false;
  const json object = json::parse(properties, nullptr, false);
  if (!object.is_object()) return false;
  const auto property = object.find(key_);
  return property != object.end() && is(*property, value_);
}

}  // namespace globe::search
