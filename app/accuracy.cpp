#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "app/accuracy/compare.h"
#include "app/accuracy/freed_memory.h"
#include "app/accuracy/pace.h"
#include "app/accuracy/report.h"
#include "app/commands.h"
#include "app/progress.h"
#include "globe/base/error.h"
#include "globe/base/pending_file.h"
#include "globe/gl/context.h"
#include "globe/planet/surface.h"

namespace app {
namespace {

/// Bytes that the planet keeps of what is drawn: an eighth of what it keeps elsewhere, for frames take their
/// share.
constexpr std::size_t kPlanetCache = globe::planet::Surface::kDefaultCache / 8;

struct AccuracyOptions {
  std::string folder;
  std::string suite = "quick";
  std::string only;
  std::vector<std::string> compared;  ///< two reports, or none
  bool hard = false;
  bool overwrite = false;
  bool quiet = false;
};

std::string names_of_families() {
  std::string names;
  for (const accuracy::Family& family : accuracy::families())
    names += (names.empty() ? "" : ", ") + family.name;
  return names;
}

/// The table that the last run of the tests left.
void show_hard_cases() {
  const std::filesystem::path table = GLOBE_HARD_CASES;
  std::ifstream rows(table);
  if (!rows || rows.peek() == std::ifstream::traits_type::eof())
    throw globe::Error(table.string(), "the hard cases have not been run here", "run ./dev test");
  std::printf("case | quantity | threshold | seen\n");
  constexpr std::string_view kMark = "HARD | ";
  std::vector<std::string> seen;  // a case that ran twice, in two kinds of test, is shown once
  for (std::string line; std::getline(rows, line);) {
    line.erase(0, line.starts_with(kMark) ? kMark.size() : 0);
    if (std::find(seen.begin(), seen.end(), line) != seen.end()) continue;
    std::printf("%s\n", line.c_str());
    seen.push_back(line);
  }
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw globe::Error(folder.string(), "cannot be made: " + error.message(),
                       "choose a folder that may be written");
}

void write(const std::filesystem::path& path, const std::string& text, bool overwrite) {
  globe::PendingFile file(path, overwrite);
  std::ofstream(file.temporary(), std::ios::binary) << text;
  file.publish();
}

nlohmann::json read_report(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw globe::Error(path, "cannot be read", "give the accuracy.json of a report");
  return nlohmann::json::parse(file);
}

void show_comparison(const std::string& a, const std::string& b) {
  try {
    std::fputs(accuracy::text_of(accuracy::compare(read_report(a), read_report(b))).c_str(), stdout);
  } catch (const nlohmann::json::exception&) {
    throw globe::Error(a + " and " + b, "not both are reports",
                       "give two files accuracy.json of globe accuracy");
  }
}

void run(const AccuracyOptions& options) {
  if (options.hard) {
    show_hard_cases();
    return;
  }
  if (!options.compared.empty()) {
    show_comparison(options.compared.front(), options.compared.back());
    return;
  }
  if (options.folder.empty())
    throw globe::UsageError("accuracy", "no folder to write to", "give -o DIR, or --compare or --hard alone");
  std::vector<accuracy::Family> chosen;
  for (const accuracy::Family& family : accuracy::families())
    if (options.only.empty() || family.name == options.only) chosen.push_back(family);
  if (chosen.empty())
    throw globe::UsageError("--only " + options.only, "no such family", "give one of " + names_of_families());
  const std::filesystem::path folder = options.folder;
  const std::filesystem::path page = folder / "accuracy.html", rows = folder / "accuracy.csv",
                              json = folder / "accuracy.json";
  for (const auto& path : {page, rows, json}) globe::refuse_existing(path, options.overwrite);
  make_folder(folder);
  Progress progress(progress_style(options.quiet, false));
  accuracy::Scope scope{options.suite == "full"};
  if (std::any_of(chosen.begin(), chosen.end(), [](const auto& family) { return family.draws; }))
    scope = {scope.full, std::make_shared<globe::gl::Context>(),
             globe::planet::Surface::builtin(1, kPlanetCache)};
  std::vector<accuracy::Study> studies;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    progress.show("errors of " + chosen[k].name, static_cast<double>(k) / static_cast<double>(chosen.size()));
    for (accuracy::Study& study : chosen[k].studies(scope)) studies.push_back(std::move(study));
    accuracy::return_freed_memory();
  }
  accuracy::MeasuredBeside measured = accuracy::measure_beside(
      accuracy::pace_of_machine(scope.context), std::move(studies), accuracy::rounds_of(scope),
      [&](double done) { progress.show("measuring", done); });
  progress.show("drawing", 1.0);
  const std::string command = "globe accuracy -o " + options.folder + " --suite " + options.suite +
                              (options.only.empty() ? "" : " --only " + options.only);
  const accuracy::Report report{accuracy::provenance(command, options.suite), std::move(measured.pace),
                                std::move(measured.studies)};
  write(page, accuracy::html_of(report), options.overwrite);
  write(rows, accuracy::csv_of(report), options.overwrite);
  write(json, accuracy::json_of(report), options.overwrite);
  const std::string text = accuracy::text_of(report);
  std::fputs(text.c_str(), stdout);
}

}  // namespace

void add_accuracy(CLI::App& program) {
  auto options = std::make_shared<AccuracyOptions>();
  CLI::App* command = program.add_subcommand(
      "accuracy", "What each step of accuracy costs here: errors beside times, as a report");
  command->add_option("-o,--output", options->folder, "folder for accuracy.html, .csv and .json");
  command->add_option("--suite", options->suite, "quick (six minutes) or full (half an hour, 3 GB)")
      ->capture_default_str()
      ->check(CLI::IsMember({"quick", "full"}));
  command->add_option("--only", options->only, "one family: " + names_of_families());
  command
      ->add_option("--compare", options->compared,
                   "two files accuracy.json: in what the reports agree, in place of a report")
      ->type_name("A.json B.json")
      ->expected(2);
  command->add_flag("--hard", options->hard,
                    "show the hard cases that the tests last saw, in place of a report");
  command->add_flag("--overwrite", options->overwrite, "replace an existing report");
  command->add_flag("--quiet", options->quiet, "warnings and errors only");
  command->footer(
      "Text: a block for each knob, a line for each setting: largest error, RMS, median cost (quartiles); * "
      "marks\n"
      "settings that no other betters in both error and cost.  Errors are the same on every run; costs are "
      "medians of\n"
      "runs in passes over all of it, with fixed work among them: the machine's own pace.\n"
      "Example: globe accuracy -o report --only geodesics");
  command->callback([options] { run(*options); });
}

}  // namespace app
