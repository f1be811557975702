#include "app/accuracy/compare.h"

#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/accuracy/report.h"

namespace app::accuracy {
namespace {

using nlohmann::json;

/// A setting as a report has it, and the unit of its cost.
struct Row {
  json setting;
  std::string cost_unit;
};
using Rows = std::map<std::pair<std::string, std::string>, Row>;  ///< by the names of study and setting

Rows rows_of(const json& report) {
  Rows rows;
  for (const json& study : report.at("studies")) {
    for (const json& setting : study.at("settings"))
      rows[{study.at("name"), setting.at("name")}] = {setting, study.at("cost_unit")};
  }
  return rows;
}

double number(const json& setting, const char* key) { return setting.at(key).get<double>(); }

bool overlap(const json& a, const json& b) {
  return number(a, "cost_low") <= number(b, "cost_high") && number(b, "cost_low") <= number(a, "cost_high");
}

bool varies(const json& setting) { return number(setting, "cost_low") < number(setting, "cost_high"); }

std::string interval_text(const json& setting) {
  return figure(number(setting, "cost_low")) + " to " + figure(number(setting, "cost_high"));
}

bool equal_errors(const json& a, const json& b) {
  for (const char* key : {"error_max", "error_rms", "error_where"})
    if (a.at(key) != b.at(key)) return false;
  return true;
}

void add(const std::string& name, const Row& a, const Row& b, Comparison& result) {
  ++result.settings;
  if (equal_errors(a.setting, b.setting)) {
    ++result.equal_errors;
  } else {
    result.differences.push_back(name + ": errors up to " + figure(number(a.setting, "error_max")) + " and " +
                                 figure(number(b.setting, "error_max")));
  }
  const bool meet = overlap(a.setting, b.setting);
  if (varies(a.setting) || varies(b.setting)) {
    ++result.varying;
    result.overlapping += meet ? 1 : 0;
  }
  if (!meet)
    result.differences.push_back(name + ", " + a.cost_unit + ": " + interval_text(a.setting) + " and " +
                                 interval_text(b.setting));
}

std::vector<std::string> paces_of(const json& a, const json& b) {
  std::vector<std::string> lines;
  if (!a.contains("pace") || !b.contains("pace")) return lines;  // of a program that did not measure it
  for (const json& one : a.at("pace")) {
    for (const json& other : b.at("pace")) {
      if (one.at("name") != other.at("name")) continue;
      const double ratio = number(other, "cost_median") / number(one, "cost_median");
      lines.push_back(one.at("name").get<std::string>() + ", ms: " + interval_text(one) + " and " +
                      interval_text(other) +
                      (overlap(one, other)
                           ? ""
                           : ": the machine itself took " + figure(ratio) + " times as long in the second"));
    }
  }
  return lines;
}

}  // namespace

Comparison compare(const json& a, const json& b) {
  Comparison result;
  const Rows ours = rows_of(a), others = rows_of(b);
  const auto name_of = [](const Rows::value_type& row) { return row.first.first + ", " + row.first.second; };
  for (const auto& row : ours) {
    const auto other = others.find(row.first);
    if (other == others.end()) {
      result.differences.push_back(name_of(row) + ": in the first report only");
    } else {
      add(name_of(row), row.second, other->second, result);
    }
  }
  for (const auto& row : others)
    if (!ours.contains(row.first)) result.differences.push_back(name_of(row) + ": in the second report only");
  result.paces = paces_of(a, b);
  return result;
}

std::string text_of(const Comparison& comparison) {
  const auto share = [](std::size_t part, std::size_t whole) {
    return std::to_string(part) + " of " + std::to_string(whole) + " settings";
  };
  std::string text = "errors: equal in " + share(comparison.equal_errors, comparison.settings) +
                     "\ncosts: 95 % intervals overlap in " +
                     share(comparison.overlapping, comparison.varying) + " whose cost is measured\n";
  for (const std::string& line : comparison.paces) text += "pace: " + line + "\n";
  for (const std::string& line : comparison.differences) text += "  " + line + "\n";
  return text;
}

}  // namespace app::accuracy
