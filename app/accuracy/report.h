#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/accuracy/measure.h"

namespace app::accuracy {

/// What a reader has to know to repeat a report.
struct Provenance {
  std::string command;
  std::string suite;
  std::vector<std::pair<std::string, std::string>> facts;  ///< machine, libraries, renderer: name and value
};

/// Facts of this machine and program.
Provenance provenance(const std::string& command, const std::string& suite);

struct Report {
  Provenance provenance;
  MeasuredStudy pace;  ///< pace_of_machine, measured beside the studies
  std::vector<MeasuredStudy> studies;
};

/// A line for each setting, for a terminal.
std::string text_of(const Report& report);

/// One row a setting, those of the pace first, a header line, figures at full precision.
std::string csv_of(const Report& report);

/// One object: the provenance, the pace and the studies.
std::string json_of(const Report& report);

/// A page that needs no other file: plots as SVG, by gnuplot, and tables. Throws Error when there is no
/// gnuplot.
std::string html_of(const Report& report);

/// A study's error against its cost as an SVG drawing, both logarithmic, the front joined, the default
/// filled.
std::string plot_of(const MeasuredStudy& study);

/// A figure for people: three digits.
std::string figure(double value);

}  // namespace app::accuracy
