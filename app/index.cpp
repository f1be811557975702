#include <cctype>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/parse_options.h"
#include "app/progress.h"
#include "globe/base/error.h"
#include "globe/search/csv_features.h"
#include "globe/search/geojson_features.h"
#include "globe/search/index_writer.h"

namespace app {
namespace {

namespace fs = std::filesystem;
using globe::search::BadLine;
using globe::search::Columns;
using globe::search::IndexWriter;
using globe::search::NewFeature;

struct IndexOptions {
  std::vector<std::string> files;
  std::string output;
  std::string columns;
  std::string ellipsoid = "wgs84";
  bool overwrite = false;
  bool strict = false;
  bool quiet = false;
  std::string progress;
};

Columns parse_columns(const std::string& text) {
  if (text.empty()) return {};
  std::vector<std::string> names{""};
  for (const char c : text) {
    if (c == ',') {
      names.emplace_back();
    } else {
      names.back() += c;
    }
  }
  if (names.size() < 2 || names.size() > 3 || names[0].empty() || names[1].empty()) {
    throw globe::UsageError("--columns", "'" + text + "' is not LAT,LON,NAME",
                            "give two or three columns of the header, or their numbers");
  }
  return {names[0], names[1], names.size() == 3 ? names[2] : ""};
}

bool has_extension(const fs::path& path, const char* extension) {
  std::string own = path.extension().string();
  for (char& c : own) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return own == extension;
}

/// Reads files into a database, and says what is left out.
class Indexer {
 public:
  Indexer(const IndexOptions& options, IndexWriter& writer)
      : options_(options),
        columns_(parse_columns(options.columns)),
        writer_(writer),
        progress_(progress_style(options.quiet, options.progress == "json")) {}

  void read(const std::string& file) {
    file_ = file;
    if (has_extension(file, ".csv")) {
      read_csv();
    } else if (has_extension(file, ".geojson") || has_extension(file, ".json")) {
      read_geojson();
    } else {
      throw globe::UsageError(file, "its name does not say what it is", "give files .csv, .geojson or .json");
    }
  }

  void finish() {
    progress_.show("sorting", 0.0);
    writer_.finish();
    progress_.clear();
  }

  std::size_t left_out() const { return left_out_; }

 private:
  void read_csv() {
    std::ifstream stream(file_, std::ios::binary);
    if (!stream || fs::is_directory(file_)) {
      throw globe::Error(file_, stream ? "it is a folder" : std::strerror(errno), "give a readable CSV file");
    }
    const auto bytes = static_cast<double>(fs::file_size(file_));
    const auto visit = [&](NewFeature&& feature, std::size_t line) {
      constexpr std::size_t kBetweenLooks = 16384;
      add(std::move(feature), file_ + ":" + std::to_string(line));
      if (line % kBetweenLooks == 0)
        progress_.show("reading " + file_, static_cast<double>(stream.tellg()) / bytes);
    };
    globe::search::visit_csv(stream, file_, columns_, visit, [&](const BadLine& bad) {
      leave_out(file_ + ":" + std::to_string(bad.line) + ": " + bad.why);
    });
    if (stream.bad()) throw globe::Error(file_, "it cannot be read to its end", "check the disk");
  }

  void read_geojson() {
    progress_.show("reading " + file_, 0.0);
    const auto visit = [&](NewFeature&& feature, std::size_t number) {
      add(std::move(feature), file_ + ", feature " + std::to_string(number));
    };
    const auto refuse = [&](const globe::Error& error) { leave_out(error.what()); };
    const std::string name = columns_.name.empty() ? "name" : columns_.name;
    globe::search::visit_geojson_features(file_, name, visit, refuse);
  }

  void add(NewFeature&& feature, const std::string& where) {
    if (feature.geometry.empty()) return leave_out(where + ": it has no place");
    try {
      writer_.add(std::move(feature));
    } catch (const globe::UsageError& error) {  // a geometry that is none
      leave_out(where + ": " + error.what());
    }
  }

  void leave_out(const std::string& why) {
    if (options_.strict)
      throw globe::Error(why, "the feature cannot be indexed", "mend it, or leave out --strict");
    progress_.clear();
    std::fprintf(stderr, "globe: %s\n", why.c_str());
    ++left_out_;
  }

  const IndexOptions& options_;
  Columns columns_;
  IndexWriter& writer_;
  Progress progress_;
  std::string file_;
  std::size_t left_out_ = 0;
};

int run(const IndexOptions& options) {
  const auto ellipsoid = parse_ellipsoid(options.ellipsoid);
  IndexWriter writer(options.output, ellipsoid, options.overwrite);
  Indexer indexer(options, writer);
  for (const std::string& file : options.files) indexer.read(file);
  indexer.finish();
  if (!options.quiet) {
    std::fprintf(stderr, "%s: %llu features on the ellipsoid %s", options.output.c_str(),
                 static_cast<unsigned long long>(writer.size()), options.ellipsoid.c_str());
    if (indexer.left_out() > 0) std::fprintf(stderr, ", %zu left out", indexer.left_out());
    std::fprintf(stderr, "\n");
  }
  return indexer.left_out() > 0 ? 1 : 0;
}

}  // namespace

void add_index(CLI::App& program, int& exit_status) {
  auto options = std::make_shared<IndexOptions>();
  CLI::App* command = program.add_subcommand("index", "put features into a database for globe find");
  command->add_option("FEATURES", options->files, "files .csv, .geojson or .json")->required();
  command->add_option("-o,--output", options->output, "the database, an SQLite file")->required();
  command->add_option(
      "--columns", options->columns,
      "LAT,LON,NAME: columns of a CSV file, by its header; by numbers from 1 in a file without "
      "one. NAME is also the property that names features of GeoJSON");
  command
      ->add_option("--ellipsoid", options->ellipsoid,
                   "wgs84, moon, mars or A,F: distances are measured on it")
      ->capture_default_str();
  command->add_flag("--overwrite", options->overwrite, "replace an existing database");
  command->add_flag("--strict", options->strict, "stop at the first bad line, and leave no database");
  command->add_flag("--quiet", options->quiet, "warnings and errors only");
  command->add_option("--progress", options->progress, "json: a line for each percent, on standard error")
      ->check(CLI::IsMember({"json"}));
  command->footer(
      "CSV: columns lat, latitude or y; lon, lng, longitude or x; name; all others become properties. A bad\n"
      "line is named on standard error and left out; the exit status is then 1.\n"
      "Example: globe index places.csv roads.geojson -o places.db");
  command->callback([options, &exit_status] { exit_status = run(*options); });
}

}  // namespace app
