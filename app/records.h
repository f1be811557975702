#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace app {

/// The options of every command that answers record by record (COMMANDS.md, Conventions).
struct RecordOptions {
  bool json = false;
  bool csv = false;
  bool strict = false;
  std::optional<int> precision;  ///< decimals of every number with a fraction; none: all that round trips
};

/// Adds --json, --csv, --strict and --precision.
void add_record_options(CLI::App& command, RecordOptions& options);

/// Who answers: this thread, or all of TBB's, many records at a time. Results are the same.
enum class Threads { kOne, kAll };

/// Answers each operand, or without operands each line of standard input: one line a record, in order,
/// flushed whenever the input runs dry.
///
/// A record whose answer throws globe::Error gets `ERROR: reason`, from standard input `ERROR: line N:
/// reason` (JSON: {"line", "error"}; CSV: one quoted field), and the rest go on, unless --strict. Blank and #
/// lines pass through as text and vanish in tables.
/// @param csv_header  first line of --csv
/// @param answer  a record to its line, without the newline; with Threads::kAll called from many threads at
/// once
/// @returns the exit status: 1 when a record failed, else 0. Throws globe::Error when standard input or
/// output fails.
int answer_records(const std::vector<std::string>& operands, const RecordOptions& options,
                   const std::string& csv_header,
                   const std::function<std::string(const std::string&)>& answer,
                   Threads threads = Threads::kOne);

/// A number as text: the shortest that reads back equal, or with fixed decimals. Never "-0".
std::string number_text(double value, std::optional<int> precision);

/// The same at the end of a text.
void append_number(std::string& text, double value, std::optional<int> precision);
void append_integer(std::string& text, std::uint64_t value);

/// The number that `number_text` shows, for JSON.
double shown(double value, std::optional<int> precision);

/// A longitude in [-180, 180) as it is shown: what would round up to 180 is -180.
double shown_longitude(double lon_deg, std::optional<int> precision);

/// Takes the PLANET from the front of the operands: a word that starts with "procedural" or names a folder
/// (whether it is a planet is found out when it is opened).
std::optional<std::string> take_planet(std::vector<std::string>& operands);

}  // namespace app
