#include "globe/scene/nearest_word.h"

#include <algorithm>

namespace globe::scene {
namespace {

constexpr std::size_t kLongest = 64;  ///< letters of a word that is compared

/// Distance of Damerau and Levenshtein with swaps of neighbours that nothing else is done to ("optimal string
/// alignment").
std::size_t letters_changed(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> least(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        least[i][j] = i + j;
        continue;
      }
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      least[i][j] = std::min({least[i - 1][j] + 1, least[i][j - 1] + 1, least[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        least[i][j] = std::min(least[i][j], least[i - 2][j - 2] + 1);
    }
  }
  return least[a.size()][b.size()];
}

}  // namespace

std::optional<std::string> nearest_word(const std::string& word, const std::vector<std::string>& known) {
  std::optional<std::string> nearest;
  std::size_t least = 0;
  if (word.size() > kLongest) return nearest;
  for (const std::string& candidate : known) {
    const std::size_t changed = letters_changed(word, candidate);
    if (changed * 3 > std::max<std::size_t>(candidate.size(), 3)) continue;
    if (!nearest || changed < least) {
      nearest = candidate;
      least = changed;
    }
  }
  return nearest;
}

std::string listed(const std::vector<std::string>& words, const std::string& last) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (k > 0) text += k + 1 == words.size() ? " " + last + " " : ", ";
    text += words[k];
  }
  return text;
}

}  // namespace globe::scene
