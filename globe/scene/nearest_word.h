#pragma once

#include <optional>
#include <string>
#include <vector>

namespace globe::scene {

/// The known word that a misspelt one is likely to mean: the one with the fewest letters to change, insert,
/// leave out or swap with their neighbour, if those are at most a third of its letters.
std::optional<std::string> nearest_word(const std::string& word, const std::vector<std::string>& known);

/// "a, b and c".
std::string listed(const std::vector<std::string>& words, const std::string& last = "and");

}  // namespace globe::scene
