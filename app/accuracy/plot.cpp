#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "app/accuracy/report.h"
#include "app/gnuplot.h"
#include "app/records.h"
#include "globe/base/error.h"
#include "globe/base/temporary_folder.h"

namespace app::accuracy {
namespace {

/// Limits of a logarithmic axis around values, with room for labels.
std::pair<double, double> axis(const std::vector<double>& values, double room_below, double room_above) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double decades = std::max(std::log10(*most / *least), 0.3);
  return {*least / std::pow(10.0, room_below * decades), *most * std::pow(10.0, room_above * decades)};
}

std::string script(const MeasuredStudy& measured, const std::filesystem::path& output) {
  const Study& study = measured.study;
  // An error of nothing has no place on a logarithmic axis: it stands a decade below the least other one.
  double least = std::numeric_limits<double>::max();
  for (const Setting& setting : study.settings)
    if (setting.error.max > 0.0) least = std::min(least, setting.error.max);
  if (least == std::numeric_limits<double>::max()) least = 1.0;
  std::vector<double> errors, costs;
  for (std::size_t k = 0; k < study.settings.size(); ++k) {
    errors.push_back(study.settings[k].error.max > 0.0 ? study.settings[k].error.max : 0.1 * least);
    costs.push_back(std::max(measured.costs[k].median, 1e-9));
  }
  const auto [x0, x1] = axis(costs, 0.08, 0.35);
  const auto [y0, y1] = axis(errors, 0.12, 0.12);
  std::string text =
      "set terminal svg size 900,420 noenhanced font 'DejaVu Sans,13' background rgb 'white'\n"
      "set encoding utf8\nset output " +
      gnuplot_literal(output.string()) +
      "\n"
      "set logscale xy\nset format xy '%g'\nset grid lt 1 lc rgb '#e4e4e4'\nunset key\n"
      "set border 3 lc rgb '#444444'\nset tics nomirror out\n"
      "set xlabel " +
      gnuplot_literal(study.cost_unit) + "\nset ylabel " +
      gnuplot_literal("largest error, " + study.error_unit) + "\nset xrange [" + number_text(x0, 12) + ":" +
      number_text(x1, 12) + "]\nset yrange [" + number_text(y0, 15) + ":" + number_text(y1, 15) + "]\n";
  const auto block = [&](const char* name, const auto& wanted) {
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < errors.size(); ++k)
      if (wanted(k)) order.push_back(k);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return costs[a] < costs[b]; });
    text += std::string(name) + " << END\n";
    for (const std::size_t k : order) {
      std::string label = study.settings[k].name;
      std::replace(label.begin(), label.end(), '"', '\'');
      text += number_text(costs[k], 12) + ' ' + number_text(errors[k], 15) + " \"" + label + "\"\n";
    }
    text += "END\n";
    return !order.empty();
  };
  block("$all", [](std::size_t) { return true; });
  const bool front = block("$front", [&](std::size_t k) { return measured.on_front[k]; });
  const bool chosen = block("$chosen", [&](std::size_t k) { return study.settings[k].is_default; });
  text += "plot $all using 1:2 with points pt 6 ps 1 lc rgb '#2b6ca3' lw 1.5";
  if (front) text += ", $front using 1:2 with lines lc rgb '#2b6ca3' lw 1 dt (6,4)";
  if (chosen) text += ", $chosen using 1:2 with points pt 7 ps 1 lc rgb '#7a1f1f'";
  return text +
         ", $all using 1:2:3 with labels left offset 0.8,0.4 font ',11' tc rgb '#333333'\nset output\n";
}

}  // namespace

std::string plot_of(const MeasuredStudy& study) {
  const globe::TemporaryFolder folder("globe-accuracy");
  const std::filesystem::path drawing = folder / "plot.svg";
  run_gnuplot(script(study, drawing), "install gnuplot-nox");
  std::ostringstream text;
  text << std::ifstream(drawing).rdbuf();
  const std::size_t begin = text.str().find("<svg");  // what precedes it has no place inside a page
  if (begin == std::string::npos) throw globe::Error("gnuplot", "drew nothing", "see whether gnuplot works");
  return text.str().substr(begin);
}

}  // namespace app::accuracy
