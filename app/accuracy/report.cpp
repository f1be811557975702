#include "app/accuracy/report.h"

#include <gdal_version.h>
#include <sys/utsname.h>
#include <GeographicLib/Constants.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/commands.h"
#include "app/records.h"

namespace app::accuracy {
namespace {

using nlohmann::ordered_json;

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

std::string padded(std::string text, std::size_t width) {
  // Counted in characters, not bytes: continuation bytes of UTF-8 take no room.
  const auto shown = static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
  text.append(shown < width ? width - shown : 1, ' ');
  return text;
}

/// As RFC 4180 has it.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string number(double value) { return number_text(value, std::nullopt); }

std::string csv_rows(const MeasuredStudy& measured) {
  const Study& study = measured.study;
  std::string text;
  for (std::size_t k = 0; k < study.settings.size(); ++k) {
    const Setting& setting = study.settings[k];
    const CostFigure& cost = measured.costs[k];
    for (const std::string& field :
         {study.name, study.knob, setting.name, std::string(setting.is_default ? "true" : "false"),
          study.error_unit, number(setting.error.max), number(setting.error.rms), setting.error.where,
          study.cost_unit, number(cost.median), number(cost.q1), number(cost.q3), number(cost.low),
          number(cost.high), std::to_string(cost.runs), std::string(measured.on_front[k] ? "true" : "false")})
      text += csv_field(field) + ',';
    text += csv_field(setting.note) + '\n';
  }
  return text;
}

void add_cost(const CostFigure& cost, ordered_json& object) {
  object["cost_median"] = cost.median;
  object["cost_q1"] = cost.q1;
  object["cost_q3"] = cost.q3;
  object["cost_low"] = cost.low;
  object["cost_high"] = cost.high;
  object["cost_passes"] = cost.passes;
  object["runs"] = cost.runs;
}

}  // namespace

std::string figure(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

Provenance provenance(const std::string& command, const std::string& suite) {
  utsname system{};
  ::uname(&system);
  return {
      command,
      suite,
      {{"program", version()},
       {"processor", processor() + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads"},
       {"system", std::string(system.sysname) + " " + system.release + ", " + system.machine},
       {"compiler", __VERSION__},
       {"GeographicLib", GEOGRAPHICLIB_VERSION_STRING},
       {"GDAL", GDAL_RELEASE_NAME}}};
}

std::string text_of(const Report& report) {
  std::string text = report.pace.study.title + "\n";
  for (std::size_t k = 0; k < report.pace.costs.size(); ++k) {
    const CostFigure& cost = report.pace.costs[k];
    text += "  " + padded(report.pace.study.settings[k].name, 56) + figure(cost.median) + " " +
            report.pace.study.cost_unit + " (95 %: " + figure(cost.low) + " to " + figure(cost.high) + ")\n";
  }
  text += "\n";
  for (const MeasuredStudy& measured : report.studies) {
    const Study& study = measured.study;
    const std::size_t error_width = std::max<std::size_t>(14, study.error_unit.size() + 7);
    text += study.title + (study.knob.empty() ? "" : " (" + study.knob + ")") + "\n";
    text += "  " + padded("", 30) + padded("max, " + study.error_unit, error_width) + padded("RMS", 12) +
            padded(study.cost_unit, 26) + "\n";
    for (std::size_t k = 0; k < study.settings.size(); ++k) {
      const Setting& setting = study.settings[k];
      const CostFigure& cost = measured.costs[k];
      text += "  " + padded(setting.name, 30) + padded(figure(setting.error.max), error_width) +
              padded(figure(setting.error.rms), 12) +
              padded(figure(cost.median) + " (" + figure(cost.q1) + " to " + figure(cost.q3) + ")", 26) +
              (setting.is_default ? "default " : "") + (measured.on_front[k] ? "*" : "") + "\n";
    }
    text += "\n";
  }
  return text;
}

std::string csv_of(const Report& report) {
  std::string text =
      "study,knob,setting,default,error_unit,error_max,error_rms,error_where,cost_unit,cost_median,cost_q1,"
      "cost_q3,"
      "cost_low,cost_high,runs,pareto,note\n" +
      csv_rows(report.pace);
  for (const MeasuredStudy& measured : report.studies) text += csv_rows(measured);
  return text;
}

std::string json_of(const Report& report) {
  ordered_json json{{"command", report.provenance.command}, {"suite", report.provenance.suite}};
  for (const auto& [name, value] : report.provenance.facts) json["facts"][name] = value;
  json["pace"] = ordered_json::array();
  for (std::size_t k = 0; k < report.pace.costs.size(); ++k) {
    ordered_json pace{{"name", report.pace.study.settings[k].name}};
    add_cost(report.pace.costs[k], pace);
    json["pace"].push_back(std::move(pace));
  }
  json["studies"] = ordered_json::array();
  for (const MeasuredStudy& measured : report.studies) {
    const Study& study = measured.study;
    ordered_json settings = ordered_json::array();
    for (std::size_t k = 0; k < study.settings.size(); ++k) {
      const Setting& setting = study.settings[k];
      ordered_json row{{"name", setting.name},
                       {"default", setting.is_default},
                       {"error_max", setting.error.max},
                       {"error_rms", setting.error.rms},
                       {"error_where", setting.error.where}};
      add_cost(measured.costs[k], row);
      row["pareto"] = static_cast<bool>(measured.on_front[k]);
      row["note"] = setting.note;
      settings.push_back(std::move(row));
    }
    json["studies"].push_back({{"name", study.name},
                               {"title", study.title},
                               {"knob", study.knob},
                               {"reference", study.reference},
                               {"sample", study.sample},
                               {"error_unit", study.error_unit},
                               {"cost_unit", study.cost_unit},
                               {"settings", settings}});
  }
  return json.dump(1) + "\n";
}

}  // namespace app::accuracy
