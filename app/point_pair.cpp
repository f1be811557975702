#include "app/point_pair.h"

#include <algorithm>
#include <string>
#include <vector>

#include "globe/base/error.h"

namespace app {
namespace {

constexpr std::string_view kSeparators = " \t\r\n,";

[[noreturn]] void refuse(std::string_view text) {
  throw globe::UsageError("'" + std::string(text) + "'", "is not two places",
                          "write LAT LON LAT LON, or any two points as A ; B");
}

/// Where the words end, each one past its last character.
std::vector<std::size_t> word_ends(std::string_view text) {
  std::vector<std::size_t> ends;
  for (std::size_t at = text.find_first_not_of(kSeparators); at != std::string_view::npos;
       at = text.find_first_not_of(kSeparators, ends.back()))
    ends.push_back(std::min(text.find_first_of(kSeparators, at), text.size()));
  return ends;
}

}  // namespace

PointPair parse_point_pair(std::string_view text) {
  if (const std::size_t semicolon = text.find(';'); semicolon != std::string_view::npos)
    return {parse_point(text.substr(0, semicolon)), parse_point(text.substr(semicolon + 1))};
  const std::vector<std::size_t> ends = word_ends(text);
  if (ends.empty() || ends.size() % 2 != 0) refuse(text);
  const std::size_t middle = ends[ends.size() / 2 - 1];
  const std::size_t second = text.find_first_not_of(kSeparators, middle);
  const std::string_view between = text.substr(middle, second - middle);
  if (std::count(between.begin(), between.end(), ',') > 1) refuse(text);
  return {parse_point(text.substr(0, middle)), parse_point(text.substr(second))};
}

std::vector<std::string> pair_records(const std::vector<std::string>& operands) {
  if (operands.empty()) return {};
  if (operands.size() != 2) {
    throw globe::UsageError("points", "there are " + std::to_string(operands.size()) + " where a pair is two",
                            "quote each, as in \"52.5 13.4\" \"48.9 2.3\", or give pairs on standard input");
  }
  return {operands[0] + " ; " + operands[1]};
}

}  // namespace app
