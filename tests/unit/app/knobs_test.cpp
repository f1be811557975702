#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "app/accuracy/study.h"
#include "app/commands.h"
#include "globe/gl/context.h"
#include "globe/planet/surface.h"

// What trades accuracy against time is in the report of `globe accuracy`: each option of the program, and
// each approximation in the code that no option turns, which its header tags with "@approximation STUDY".

namespace {

namespace fs = std::filesystem;
using Words = std::set<std::string>;

/// Options that say what is asked for, where it goes or how it is written; more of them costs no accuracy.
const Words kNoKnobs{
    "--help", "--version",
    // what is asked
    "--at", "--pixel", "--look", "--from", "--to", "--agl", "--time", "--fov", "--size", "--frames", "--fps",
    "--extent", "--range", "--layer", "--show", "--wireframe", "--background", "--exaggeration", "--drawn",
    "--projection", "--axis", "--moment", "--sun", "--with", "--without", "--features", "--play", "--fresh",
    "--overlay", "tune --error", "--details", "--full", "--cone", "--polygon", "--box", "--edges",
    "--complement", "--inner", "--near", "--radius", "find --count", "--name", "--where", "--columns",
    "--refraction", "--suite", "--only", "--hard", "--compare", "--rounds", "--verify", "lookup --level",
    "height --level", "profile --level", "export --level", "flat --center", "flat --side", "flat --shadows",
    "flat --materials", "flat --cloud-shadows", "flat endless --height", "flat endless --speed",
    "flat endless --sight", "--shapes", "--graticule", "--labels",
    // of fractal ground: which ground that is, and how much of it is there
    "--iterations", "--roughness", "--relief", "--area", "--base", "--contrast", "--method",
    "flat endless --block", "flat endless --blocks",
    // what the input means
    "--color", "--latitude", "--voids", "--geoid", "--datum", "--credit", "--registration", "--crs",
    "--nodata", "--scale", "--offset", "--units", "--rim",
    // where it goes, and how it is written
    "--output", "--folder", "--overwrite", "--quiet", "--progress", "--json", "--csv", "--geojson",
    "--strict", "--precision", "--title", "--stats", "--trace", "--contact-sheet",
    // what it may use: the same bytes with more or less
    "--memory", "--threads", "--jobs", "--job", "--device", "--wait", "--budget", "flat --culling",
    "flat --pvs", "flat endless --slack", "flat endless --cached-areas"};

Words knobs_of_the_report() {
  Words knobs;
  for (const app::accuracy::Family& family : app::accuracy::families())
    knobs.insert(family.knobs.begin(), family.knobs.end());
  return knobs;
}

/// Calls `use` with the names of every command ("flat shot") and each of its options.
template <typename Use>
void for_each_option_of(const CLI::App& parent, const std::string& names, const Use& use) {
  for (const CLI::App* command : parent.get_subcommands([](const CLI::App*) { return true; })) {
    const std::string own = names + (names.empty() ? "" : " ") + command->get_name();
    for (const CLI::Option* option : command->get_options())
      for (const std::string& name : option->get_lnames()) use(own, "--" + name);
    for_each_option_of(*command, own, use);
  }
}
template <typename Use>
void for_each_option(const Use& use) {
  CLI::App program;
  int exit_status = 0;
  app::add_commands(program, exit_status);
  for_each_option_of(program, "", use);
}

/// What a list may call an option of a command: alone, or after the command or after what that belongs to.
Words names_of(const std::string& command, const std::string& option) {
  return {option, command + " " + option, command.substr(0, command.find(' ')) + " " + option};
}

TEST(AccuracyKnobs, EveryOptionIsInTheReportOrCostsNoAccuracy) {
  const Words knobs = knobs_of_the_report();
  for_each_option([&](const std::string& command, const std::string& option) {
    if (command == "bench" && option == "--filter") return;
    const Words names = names_of(command, option);
    EXPECT_TRUE(
        std::any_of(names.begin(), names.end(),
                    [&](const std::string& name) { return knobs.count(name) + kNoKnobs.count(name) > 0; }))
        << command << ' ' << option
        << ": neither a study of `globe accuracy` has it as its knob, nor is it listed as costing "
        << "no accuracy";
  });
}

TEST(AccuracyKnobs, TheReportNamesNoOptionThatDoesNotExist) {
  Words options;
  for_each_option([&](const std::string& command, const std::string& option) {
    options.merge(names_of(command, option));
  });
  for (const std::string& knob : knobs_of_the_report()) EXPECT_EQ(options.count(knob), 1u) << knob;
}

/// Studies that the headers' tags name.
Words tagged_studies() {
  Words tags;
  static const std::regex tag("@approximation ([a-z0-9_., ]+)"), name("[a-z0-9_.]*[a-z0-9_]");
  for (const char* room : {"globe", "converters", "flat", "shaders", "app"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(GLOBE_SOURCE_DIR) / room)) {
      if (!entry.is_regular_file()) continue;
      std::ifstream file(entry.path());
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      for (std::sregex_iterator it(text.begin(), text.end(), tag), end; it != end; ++it) {
        const std::string list = (*it)[1];
        for (std::sregex_iterator one(list.begin(), list.end(), name); one != end; ++one)
          tags.insert(one->str());
      }
    }
  }
  return tags;
}

TEST(AccuracyKnobs, EveryApproximationThatNoOptionTurnsIsTaggedWhereItIsMadeAndInTheReport) {
  Words without_option;
  for (const app::accuracy::Family& family : app::accuracy::families())
    without_option.insert(family.approximations.begin(), family.approximations.end());
  EXPECT_EQ(tagged_studies(), without_option);
}

TEST(AccuracyKnobs, FamiliesDeclareWhatTheirStudiesAreAbout) {
  for (const app::accuracy::Family& family : app::accuracy::families()) {
    const bool quick = family.name == "geometry" || family.name == "geodesics" || family.name == "covers" ||
                       family.name == "storage" || family.name == "marks";
    if (!quick && std::getenv("GLOBE_TEST_FULL") == nullptr) continue;
    const Words tags(family.approximations.begin(), family.approximations.end());
    Words knobs, found;
    app::accuracy::Scope scope;
    if (family.draws)
      scope = {false, std::make_shared<globe::gl::Context>(), globe::planet::Surface::builtin(1)};
    for (const app::accuracy::Study& study : family.studies(scope)) {
      std::istringstream list(study.knob);
      for (std::string knob; std::getline(list >> std::ws, knob, ',');) knobs.insert(knob);
      if (!study.knob.empty()) continue;
      const auto tag =
          std::find_if(tags.begin(), tags.end(), [&](const auto& t) { return study.name.starts_with(t); });
      if (tag == tags.end()) {
        ADD_FAILURE() << study.name << " has no option and is not declared";
      } else {
        found.insert(*tag);
      }
    }
    EXPECT_EQ(knobs, Words(family.knobs.begin(), family.knobs.end())) << family.name;
    EXPECT_EQ(found, tags) << family.name;
  }
}

}  // namespace
