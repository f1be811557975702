#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace app::accuracy {

/// In what two reports agree, setting by setting of those that both have.
struct Comparison {
  std::size_t settings = 0;
  std::size_t equal_errors = 0;         ///< the largest, where it was and the RMS, to the last digit
  std::size_t varying = 0;              ///< settings whose cost is measured, not counted
  std::size_t overlapping = 0;          ///< of these: whose 95 % intervals have a cost in common
  std::size_t paced = 0;                ///< of `varying`: that can be told by the pace of each pass
  std::size_t overlapping_by_pace = 0;  ///< of these: whose intervals overlap when each pass' cost is divided
                                        ///< by what the fixed work took in that pass
  std::vector<std::string> differences;  ///< a line each; settings that one report alone has among them
  std::vector<std::string> paces;        ///< a line each (pace.h)
};

/// Of two reports as json_of (report.h) writes them. Throws nlohmann::json::exception when one is none.
Comparison compare(const nlohmann::json& a, const nlohmann::json& b);

/// For a terminal.
std::string text_of(const Comparison& comparison);

}  // namespace app::accuracy
