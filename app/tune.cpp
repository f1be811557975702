#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/accuracy/report.h"
#include "app/commands.h"
#include "app/parse_options.h"
#include "app/planet_argument.h"
#include "app/progress.h"
#include "app/tuning.h"
#include "app/view_options.h"
#include "globe/base/error.h"
#include "globe/base/pending_file.h"
#include "globe/gl/context.h"

namespace app {
namespace {

using accuracy::DrawingQuality;
using accuracy::figure;
using nlohmann::ordered_json;

struct TuneOptions {
  std::string planet;
  TuningGoal goal;
  std::string size = "1280x720";
  double fov_deg = 60.0;
  std::string details = "16,24,32,48,64,96,128,192";
  std::string output;
  std::string device = "auto";
  bool json = false;
  bool full = false;
  bool overwrite = false;
  bool quiet = false;
};

std::vector<int> parse_details(const std::string& text) {
  std::vector<int> details;
  for (const double detail : parse_numbers(text, ',')) {
    if (detail < 16.0 || detail > 1024.0 || detail != std::floor(detail)) {
      details.clear();
      break;
    }
    details.push_back(static_cast<int>(detail));
  }
  if (details.empty())
    throw globe::UsageError("--details " + text, "whole numbers from 16 to 1024 are wanted",
                            "give them with commas between, such as 32,64,128");
  return details;
}

std::string goal_text(const TuningGoal& goal) {
  return goal.fps ? figure(*goal.fps) + " frames a second (" + figure(1000.0 / *goal.fps) + " ms)"
                  : "at most " + figure(*goal.error_px) + " pixels of error";
}

std::string reason(const DrawingQuality& best, const TuneOptions& options) {
  const std::string error = figure(best.error_px.max) + " px at most (" + best.error_px.where + ")";
  const std::string time = figure(best.frame.ms.median) + " ms (95 %: " + figure(best.frame.ms.low) + " to " +
                           figure(best.frame.ms.high) + ", " + best.frame.where + ")";
  return options.goal.fps
             ? "the smallest error of those that keep " + goal_text(options.goal) + ": " + error + ", in " +
                   time
             : "the fastest of those with " + goal_text(options.goal) + ": " + time + ", with " + error;
}

std::string fragment(const DrawingQuality& best, const TuneOptions& options) {
  return "# globe tune " + options.planet +
         (options.goal.fps ? " --fps " + figure(*options.goal.fps)
                           : " --error " + figure(*options.goal.error_px)) +
         ": " + reason(best, options) + "\n[picture]\nsize = \"" + options.size +
         "\"\nfov = " + figure(options.fov_deg) + "\ndetail = " + std::to_string(best.detail) + "\n";
}

std::string text_of(const std::vector<DrawingQuality>& qualities, const Tuning& tuning) {
  std::string text = "  detail   error, px: max    RMS   frame, ms (95 %)           triangles  textures\n";
  for (std::size_t k = 0; k < qualities.size(); ++k) {
    const DrawingQuality& quality = qualities[k];
    char line[160];
    std::snprintf(line, sizeof line, "%c %6d %16s %6s   %-24s %11zu %6.0f MB %s\n",
                  tuning.chosen == k ? '>' : ' ', quality.detail, figure(quality.error_px.max).c_str(),
                  figure(quality.error_px.rms).c_str(),
                  (figure(quality.frame.ms.median) + " (" + figure(quality.frame.ms.low) + " to " +
                   figure(quality.frame.ms.high) + ")")
                      .c_str(),
                  quality.frame.triangles, static_cast<double>(quality.frame.texture_bytes) / 1e6,
                  tuning.on_front[k] ? "*" : "");
    text += line;
  }
  return text + "* nothing betters it in both error and time\n";
}

ordered_json json_of(const std::vector<DrawingQuality>& qualities, const Tuning& tuning,
                     const TuneOptions& options) {
  ordered_json rows = ordered_json::array();
  for (std::size_t k = 0; k < qualities.size(); ++k) {
    const DrawingQuality& quality = qualities[k];
    rows.push_back({{"detail", quality.detail},
                    {"error_max_px", quality.error_px.max},
                    {"error_rms_px", quality.error_px.rms},
                    {"error_where", quality.error_px.where},
                    {"frame_ms", quality.frame.ms.median},
                    {"frame_low_ms", quality.frame.ms.low},
                    {"frame_high_ms", quality.frame.ms.high},
                    {"slowest_view", quality.frame.where},
                    {"triangles", quality.frame.triangles},
                    {"texture_bytes", quality.frame.texture_bytes},
                    {"pareto", static_cast<bool>(tuning.on_front[k])}});
  }
  ordered_json object{{"planet", options.planet}, {"goal", goal_text(options.goal)}};
  object["detail"] = tuning.chosen ? ordered_json(qualities[*tuning.chosen].detail) : ordered_json();
  if (tuning.chosen) object["reason"] = reason(qualities[*tuning.chosen], options);
  object["measured"] = std::move(rows);
  return object;
}

void run(const TuneOptions& options) {
  if (options.goal.fps.has_value() == options.goal.error_px.has_value())
    throw globe::UsageError("tune", "one goal is needed", "give --fps N or --error PIXELS");
  const Size size = parse_size(options.size);
  const std::vector<int> details = parse_details(options.details);
  if (!options.output.empty()) globe::refuse_existing(options.output, options.overwrite);
  const auto surface = open_planet(options.planet);
  const auto context = std::make_shared<globe::gl::Context>(options.device);
  const accuracy::PictureSize picture{size.width, size.height, options.fov_deg};
  Progress progress(progress_style(options.quiet, false));
  progress.show("measuring", 0.0);
  const std::vector<DrawingQuality> qualities =
      accuracy::drawing_quality(context, details, surface, picture, {options.full});
  progress.clear();
  const Tuning tuning = tune(qualities, options.goal);
  const std::string answer =
      options.json ? json_of(qualities, tuning, options).dump() + "\n" : text_of(qualities, tuning);
  std::fputs(answer.c_str(), stdout);
  if (!tuning.chosen) {
    const DrawingQuality& nearest = qualities[tuning.nearest];
    throw globe::Error(goal_text(options.goal), "no detail reaches it here",
                       "the nearest is --detail " + std::to_string(nearest.detail) + ": " +
                           figure(nearest.error_px.max) + " px in " + figure(nearest.frame.ms.median) +
                           " ms; try a smaller --size or another goal");
  }
  const DrawingQuality& best = qualities[*tuning.chosen];
  if (!options.json) std::printf("--detail %d: %s\n", best.detail, reason(best, options).c_str());
  if (options.output.empty()) {
    if (!options.json) std::printf("\n%s", fragment(best, options).c_str());
    return;
  }
  globe::PendingFile file(options.output, options.overwrite);
  std::ofstream(file.temporary(), std::ios::binary) << fragment(best, options);
  file.publish();
}

}  // namespace

void add_tune(CLI::App& program) {
  auto options = std::make_shared<TuneOptions>();
  CLI::App* command = program.add_subcommand(
      "tune", "the settings that reach a frame rate or an error here, measured on a planet");
  command->add_option("PLANET", options->planet, "folder made by globe convert, or procedural[:SEED]")
      ->required();
  CLI::Option* fps = command->add_option("--fps", options->goal.fps, "frames a second to reach")
                         ->check(in_range(0.01, 10000.0));
  command->add_option("--error", options->goal.error_px, "largest error of the drawn ground, pixels")
      ->check(in_range(1e-3, 1000.0))
      ->excludes(fps);
  command->add_option("--size", options->size, "WxH in pixels")->capture_default_str();
  command->add_option("--fov", options->fov_deg, "vertical field of view, degrees")
      ->capture_default_str()
      ->check(in_range(0.01, 170.0));
  command->add_option("--details", options->details, "hexagons' sides to choose from, 16 to 1024")
      ->capture_default_str();
  command->add_option("-o,--output", options->output, "TOML file for the settings, a fragment of a scene");
  command->add_option("--device", options->device, "auto, software or a number")->capture_default_str();
  command->add_flag("--full", options->full, "measure as long as accuracy --suite full does");
  command->add_flag("--json", options->json, "one object: the choice and all that was measured");
  command->add_flag("--overwrite", options->overwrite, "replace an existing file");
  command->add_flag("--quiet", options->quiet, "warnings and errors only");
  command->footer(
      "Draws orbit, limb, 100 km, 2 km and eye height over the planet's mountains at each detail,\n"
      "complete frames, and takes the slowest view's median; the error is that of the drawn ground against "
      "the\n"
      "ground at its finest, in pixels, by rays in double precision.\n"
      "Example: globe tune earth --fps 30 -o picture.toml");
  command->callback([options] { run(*options); });
}

}  // namespace app
