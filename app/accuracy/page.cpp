#include "app/accuracy/report.h"

namespace app::accuracy {
namespace {

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

constexpr const char* kStyle =
    "body{font:16px/1.5 system-ui,sans-serif;margin:2rem auto;max-width:70rem;padding:0 1rem;color:#222}"
    "h1{font-size:1.6rem}h2{font-size:1.2rem;margin-top:2.5rem;border-top:1px solid #ddd;padding-top:1rem}"
    "table{border-collapse:collapse;font-size:.9rem;width:100%}"
    "th,td{text-align:right;padding:.25rem .6rem;border-bottom:1px solid "
    "#eee;font-variant-numeric:tabular-nums}"
    "th:first-child,td:first-child,td.left,th.left{text-align:left}tr.default{font-weight:600}"
    "p.about{color:#555;font-size:.9rem}svg{max-width:100%;height:auto}code{background:#f4f4f4;padding:.1rem "
    ".3rem}";

std::string table_of(const MeasuredStudy& measured) {
  const Study& study = measured.study;
  std::string html =
      "<table><tr><th>setting</th><th>largest error, " + escaped(study.error_unit) +
      "</th><th>RMS</th><th class=\"left\">largest at</th><th>" + escaped(study.cost_unit) +
      "</th><th>quartiles</th><th>95 % of the median</th><th>runs</th><th class=\"left\"></th></tr>\n";
  for (std::size_t k = 0; k < study.settings.size(); ++k) {
    const Setting& setting = study.settings[k];
    const CostFigure& cost = measured.costs[k];
    std::string remark = setting.is_default ? "default" : "";
    const auto remark_too = [&](const std::string& text) {
      if (!text.empty()) remark += (remark.empty() ? "" : "; ") + text;
    };
    remark_too(measured.on_front[k] ? "nothing is both more exact and cheaper" : "");
    remark_too(setting.note);
    html += std::string(setting.is_default ? "<tr class=\"default\">" : "<tr>") + "<td>" +
            escaped(setting.name) + "</td><td>" + figure(setting.error.max) + "</td><td>" +
            figure(setting.error.rms) + "</td><td class=\"left\">" + escaped(setting.error.where) +
            "</td><td>" + figure(cost.median) + "</td><td>" + figure(cost.q1) + " to " + figure(cost.q3) +
            "</td><td>" + figure(cost.low) + " to " + figure(cost.high) + "</td><td>" +
            std::to_string(cost.runs) + "</td><td class=\"left\">" + escaped(remark) + "</td></tr>\n";
  }
  return html + "</table>\n";
}

std::string pace_of(const MeasuredStudy& pace) {
  std::string html =
      "<h2 id=\"pace\">" + escaped(pace.study.title) +
      "</h2>\n<p class=\"about\">All is measured in passes over the whole report, this fixed work "
      "among it. An interval is that of the passes' medians. Costs of two reports can be compared "
      "where this work took as long.</p>\n<table><tr><th>work</th><th>" +
      escaped(pace.study.cost_unit) + "</th><th>95 % of the median</th><th>runs</th></tr>\n";
  for (std::size_t k = 0; k < pace.costs.size(); ++k) {
    const CostFigure& cost = pace.costs[k];
    html += "<tr><td>" + escaped(pace.study.settings[k].name) + "</td><td>" + figure(cost.median) +
            "</td><td>" + figure(cost.low) + " to " + figure(cost.high) + "</td><td>" +
            std::to_string(cost.runs) + "</td></tr>\n";
  }
  return html + "</table>\n";
}

}  // namespace

std::string html_of(const Report& report) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>What accuracy costs</title>"
      "<meta name=\"viewport\" content=\"width=device-width\"><style>" +
      std::string(kStyle) +
      "</style></head><body>\n<h1>What accuracy costs</h1>\n<p>Every setting's largest "
      "and RMS error against a reference, beside the median cost of interleaved runs, measured on this "
      "machine by <code>" +
      escaped(report.provenance.command) +
      "</code>. Cheaper is to the left, more exact is "
      "below; the line joins settings that nothing betters in both; the filled point is the default.</p>\n"
      "<table>\n";
  for (const auto& [name, value] : report.provenance.facts)
    html += "<tr><td class=\"left\">" + escaped(name) + "</td><td class=\"left\">" + escaped(value) +
            "</td></tr>\n";
  html += "</table>\n" + pace_of(report.pace);
  for (const MeasuredStudy& measured : report.studies) {
    const Study& study = measured.study;
    html += "<h2 id=\"" + escaped(study.name) + "\">" + escaped(study.title) + "</h2>\n<p class=\"about\">" +
            (study.knob.empty() ? std::string("No option; the others are yardsticks. ")
                                : "Option <code>" + escaped(study.knob) + "</code>. ") +
            "Errors against " + escaped(study.reference) + ", over " + escaped(study.sample) + ".</p>\n" +
            plot_of(measured) + table_of(measured);
  }
  return html + "</body></html>\n";
}

}  // namespace app::accuracy
