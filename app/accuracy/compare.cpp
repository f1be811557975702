#include "app/accuracy/compare.h"

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "app/accuracy/report.h"
#include "app/bench.h"

namespace app::accuracy {
namespace {

using nlohmann::json;

/// A setting as a report has it, and the unit of its cost.
struct Row {
  json setting;
  std::string cost_unit;
  std::optional<Interval> by_pace;
};
using Rows = std::map<std::pair<std::string, std::string>, Row>;  ///< by the names of study and setting

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

std::vector<double> passes_of(const json& cost) {
  return cost.contains("cost_passes") ? cost.at("cost_passes").get<std::vector<double>>()
                                      : std::vector<double>{};
}

/// What fixed work took in each pass: the geometric mean of what both reports had as such. Empty where a
/// report does not tell it.
std::vector<double> pace_of(const json& report, const json& other) {
  std::vector<double> product;
  double count = 0;
  for (const json& pace : report.value("pace", json::array())) {
    for (const json& same : other.value("pace", json::array())) {
      if (pace.at("name") != same.at("name")) continue;
      const std::vector<double> passes = passes_of(pace);
      if (product.empty()) product.assign(passes.size(), 1.0);
      if (passes.size() != product.size()) return {};
      for (std::size_t k = 0; k < passes.size(); ++k) product[k] *= passes[k];
      ++count;
    }
  }
  for (double& value : product) value = std::pow(value, 1.0 / count);
  return product;
}

/// The interval of a cost in units of the pace; nothing where passes are not told.
std::optional<Interval> by_pace(const json& setting, const std::vector<double>& pace) {
  std::vector<double> passes = passes_of(setting);
  if (passes.empty() || passes.size() != pace.size()) return std::nullopt;
  for (std::size_t k = 0; k < passes.size(); ++k) passes[k] /= pace[k];
  return median_interval(std::move(passes));
}

Rows rows_of(const json& report, const std::vector<double>& pace) {
  Rows rows;
  for (const json& study : report.at("studies")) {
    for (const json& setting : study.at("settings"))
      rows[{study.at("name"), setting.at("name")}] = {setting, study.at("cost_unit"), by_pace(setting, pace)};
  }
  return rows;
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
  const bool told = a.by_pace && b.by_pace;
  const bool meet_by_pace = told && a.by_pace->low <= b.by_pace->high && b.by_pace->low <= a.by_pace->high;
  if (varies(a.setting) || varies(b.setting)) {
    ++result.varying;
    result.overlapping += meet ? 1 : 0;
    result.paced += told ? 1 : 0;
    result.overlapping_by_pace += meet_by_pace ? 1 : 0;
  }
  if (!meet)
    result.differences.push_back(name + ", " + a.cost_unit + ": " + interval_text(a.setting) + " and " +
                                 interval_text(b.setting) +
                                 (meet_by_pace ? ", alike by the machine's pace" : ""));
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
  const Rows ours = rows_of(a, pace_of(a, b)), others = rows_of(b, pace_of(b, a));
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
  if (comparison.paced > 0)
    text += "costs by the machine's pace, pass by pass: they overlap in " +
            share(comparison.overlapping_by_pace, comparison.paced) + "\n";
  for (const std::string& line : comparison.paces) text += "pace: " + line + "\n";
  for (const std::string& line : comparison.differences) text += "  " + line + "\n";
  return text;
}

}  // namespace app::accuracy
