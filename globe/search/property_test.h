#pragma once

#include <string>
#include <string_view>

namespace globe::search {

/// One property of a feature, and what it must be.
///
/// A text must be `value`, byte for byte; a number must be equal to the number that `value` writes; true,
/// false and null go by these words. Arrays and objects never pass.
class PropertyTest {
 public:
  PropertyTest(std::string key, std::string value);

  /// @param properties  a JSON object as text, as nlohmann::json::dump() writes it; empty: no properties
  bool passes(std::string_view properties) const;

 private:
  std::string key_, value_;
  std::string key_in_json_;    ///< "key":
  std::string value_in_json_;  ///< "value"
};

}  // namespace globe::search
