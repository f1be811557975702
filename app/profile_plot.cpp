#include "app/profile_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "app/gnuplot.h"
#include "app/records.h"
#include "globe/base/error.h"
#include "globe/base/pending_file.h"

namespace app {
namespace {

using globe::planet::ProfileSample;
using Samples = std::span<const ProfileSample>;

/// Edges of the axes, shares of the picture.
constexpr double kLeft = 0.085, kRight = 0.97, kBottom = 0.12, kTop = 0.84;

struct Range {
  double low, high;
  double span() const { return high - low; }
};

/// Heights that the axis spans: height 0 is always on it, with room below the lowest place for the ground to
/// be seen and above the highest for what is written there.
Range axis_of(double lowest_m, double highest_m) {
  constexpr double kLeastSpan = 10.0;
  const double low = std::min(lowest_m, 0.0), high = std::max(highest_m, 0.0);
  const double span = std::max(high - low, kLeastSpan);
  return {low - 0.1 * span, low + 1.15 * span};
}

double exaggeration(double length_m, const Range& axis) {
  const double metres_right = length_m / (kPlotWidth * (kRight - kLeft));
  const double metres_up = axis.span() / (kPlotHeight * (kTop - kBottom));
  return metres_right / metres_up;
}

std::string exaggeration_text(double times) {
  const int decimals = times >= 20.0 ? 0 : times >= 2.0 ? 1 : 2;
  return "vertical exaggeration " + number_text(times, decimals) + "×";
}

/// A dot at a sample, and its height: above it, or below `text_m`.
std::string mark(const ProfileSample& sample, std::string_view name, double length_m, bool above,
                 double text_m) {
  const std::string km = number_text(sample.distance_m / 1000.0, 6) + ",";
  const double share = sample.distance_m / length_m;
  const char* side = share < 0.1 ? "left" : share > 0.9 ? "right" : "center";
  const std::string metres = number_text(std::abs(sample.height_m), 0);
  const bool below = sample.height_m < 0.0 && metres != "0";
  const std::string text = std::string(name) + (below ? " −" : " ") + metres + " m";
  return "set label at " + km + number_text(sample.height_m, 3) +
         " front point pt 7 ps dot lc rgb '#7a1f1f'\nset label " + gnuplot_literal(text) + " at " + km +
         number_text(text_m, 3) + " " + side + " offset 0," + (above ? "0.9" : "-0.9") +
         " front font ',13' tc rgb '#7a1f1f'\n";
}

std::string script(Samples samples, const ProfilePlot& plot, const std::filesystem::path& output) {
  const double length_m = samples.back().distance_m;
  const auto [lowest, highest] = std::minmax_element(
      samples.begin(), samples.end(),
      [](const ProfileSample& a, const ProfileSample& b) { return a.height_m < b.height_m; });
  const Range axis = axis_of(lowest->height_m, highest->height_m);
  std::string text;
  const auto line = [&](const std::string& command) { text += command + '\n'; };
  const std::string size = std::to_string(kPlotWidth) + "," + std::to_string(kPlotHeight);
  const bool svg = output.extension() == ".svg";
  if (svg) {  // its points are pixels, a PNG's are larger
    line("set terminal svg size " + size +
         " noenhanced font 'DejaVu Sans,13' fontscale 1.35 background rgb 'white'");
  } else {
    line("set terminal pngcairo size " + size + " noenhanced font 'DejaVu Sans,13' background rgb 'white'");
  }
  line(svg ? "dot = 0.5" : "dot = 0.9");
  line("set encoding utf8; set minussign");
  line("set output " + gnuplot_literal(output.string()));
  line("set lmargin at screen " + number_text(kLeft, 3) + "; set rmargin at screen " +
       number_text(kRight, 3));
  line("set bmargin at screen " + number_text(kBottom, 3) + "; set tmargin at screen " +
       number_text(kTop, 3));
  line("set label " + gnuplot_literal(plot.title) + " at screen " + number_text(kLeft, 3) +
       ",0.94 left font 'DejaVu Sans Bold,21'");
  line("set label " +
       gnuplot_literal(plot.subtitle + " · " + exaggeration_text(exaggeration(length_m, axis))) +
       " at screen " + number_text(kLeft, 3) + ",0.885 left font ',13' tc rgb '#555555'");
  line("set xrange [0:" + number_text(length_m / 1000.0, 6) + "]");
  line("set yrange [" + number_text(axis.low, 3) + ":" + number_text(axis.high, 3) + "]");
  line("set xlabel 'distance, km' offset 0,0.2; set ylabel 'height, m' offset -1,0");
  line("set border 3 lc rgb '#444444'; set tics nomirror out tc rgb '#333333'; set mxtics; set mytics");
  line("set grid y lt 1 dt solid lc rgb '#e4e4e4' lw 1 back; unset key");
  line("$ground << END");
  for (const ProfileSample& sample : samples)
    line(number_text(sample.distance_m / 1000.0, 6) + ' ' + number_text(sample.height_m, 3));
  line("END");
  text += mark(*highest, "highest", length_m, true, highest->height_m);
  // The line of height 0 must not run through what is written below the lowest place.
  const bool near_zero = lowest->height_m > 0.0 && lowest->height_m < 0.1 * axis.span();
  if (lowest->height_m < highest->height_m)
    text += mark(*lowest, "lowest", length_m, false, near_zero ? 0.0 : lowest->height_m);
  line("set label " + gnuplot_literal(plot.sea ? "sea level" : "height 0") +
       " at graph 1,first 0 right offset -0.5,0.55 front font ',11' tc rgb '#2b6ca3'");
  line("plot $ground using 1:2 with filledcurves y1=" + number_text(axis.low, 3) + " fc rgb '#d9c7a3', \\");
  if (plot.sea) line("  $ground using 1:($2 < 0 ? $2 : 0) with filledcurves y1=0 fc rgb '#b9d7ee', \\");
  line("  0 with lines lc rgb '#2b6ca3' lw 1.2 dt (8,5), \\");
  line("  $ground using 1:2 with lines lc rgb '#5b4527' lw 2");
  line("set output");
  return text;
}

}  // namespace

void require_plot_name(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (path.extension() != ".svg" && path.extension() != ".png")
    throw globe::UsageError(name, "a profile is drawn as .svg or .png", "give a name that ends so");
  if (std::any_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }))
    throw globe::UsageError("-o", "the name has a control character", "give a plain name");
}

void draw_profile(const std::filesystem::path& path, Samples samples, const ProfilePlot& plot,
                  bool overwrite) {
  globe::PendingFile file(path, overwrite);
  // An absolute path: gnuplot would take | and ~ at the beginning of another for something else.
  run_gnuplot(script(samples, plot, std::filesystem::absolute(file.temporary())),
              "install gnuplot-nox, or leave out -o and take the samples");
  file.publish();
}

}  // namespace app
