#include "app/records.h"

#include <oneapi/tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <utility>

#include "globe/base/error.h"

namespace app {
namespace {

constexpr std::size_t kLongestRecord = 65536;

/// Lines of standard input, as many as are at hand. Before it waits for more it flushes standard output.
class LineReader {
 public:
  /// The lines that have come in, at least one; none at the end. Of a line longer than kLongestRecord only
  /// the beginning is kept, one byte too many.
  std::vector<std::string> next() {
    std::vector<std::string> lines;
    for (;;) {
      while (take_line()) lines.push_back(std::exchange(line_, {}));
      if (!lines.empty()) return lines;
      if (!fill()) break;
    }
    if (std::exchange(in_line_, false)) lines.push_back(without_return(std::exchange(line_, {})));
    return lines;
  }

 private:
  /// Moves bytes to the line up to its end; false when the buffer ends first.
  bool take_line() {
    if (begin_ == end_) return false;
    const char* start = buffer_.data() + begin_;
    const auto* newline = static_cast<const char*>(std::memchr(start, '\n', end_ - begin_));
    const std::size_t length = newline == nullptr ? end_ - begin_ : static_cast<std::size_t>(newline - start);
    line_.append(start, std::min(length, kLongestRecord + 1 - line_.size()));
    begin_ += length;
    in_line_ = newline == nullptr;
    if (in_line_) return false;
    ++begin_;
    line_ = without_return(std::move(line_));
    return true;
  }

  static std::string without_return(std::string line) {
    if (line.ends_with('\r')) line.pop_back();
    return line;
  }

  bool fill() {
    std::fflush(stdout);
    ssize_t got = 0;
    do {
      got = ::read(STDIN_FILENO, buffer_.data(), buffer_.size());
    } while (got < 0 && errno == EINTR);
    if (got < 0) throw globe::Error("standard input", std::strerror(errno), "give the records as operands");
    begin_ = 0;
    end_ = static_cast<std::size_t>(got);
    return got > 0;
  }

  std::vector<char> buffer_ = std::vector<char>(std::size_t{1} << 18);
  std::size_t begin_ = 0, end_ = 0;
  std::string line_;  ///< what has come in of a line that goes on
  bool in_line_ = false;
};

/// Text as every terminal and reader takes it: no control characters, and U+FFFD for what is not UTF-8.
std::string printable(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  const nlohmann::json valid = nlohmann::json::parse(
      nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  return valid.get<std::string>();
}

/// @param line  its number, which operands have in JSON alone
std::string error_line(std::size_t line, bool from_input, const std::string& what,
                       const RecordOptions& options) {
  std::string reason = printable(what);
  if (options.json) return nlohmann::ordered_json{{"line", line}, {"error", reason}}.dump();
  if (from_input) reason = "line " + std::to_string(line) + ": " + reason;
  if (!options.csv) return "ERROR: " + reason;
  std::string doubled;
  for (const char c : reason) doubled += c == '"' ? std::string("\"\"") : std::string(1, c);
  return "\"ERROR: " + doubled + "\"";
}

bool is_comment(const std::string& line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first == std::string::npos || line[first] == '#';
}

/// The answers to some records that follow each other, newlines included.
struct Part {
  std::string text;
  bool failed = false;  ///< a record was bad; with --strict nothing comes after it
};

using AnswerRecord = std::function<std::string(const std::string&)>;

/// @param number  that of the first record, from 1
/// @param from_input  of standard input, which may hold comments and whose lines have numbers
Part answer_part(std::span<const std::string> records, std::size_t number, bool from_input,
                 const RecordOptions& options, const AnswerRecord& answer) {
  Part part;
  for (const std::string& record : records) {
    const std::size_t line = number++;
    if (from_input && is_comment(record)) {
      if (!options.json && !options.csv) part.text += record + '\n';
      continue;
    }
    try {
      if (record.size() > kLongestRecord)
        throw globe::Error("record", "is too long", "write one record a line");
      if (record.find('\0') != std::string::npos)
        throw globe::Error("record", "it holds a NUL byte", "give lines of text");
      part.text += answer(record);
    } catch (const globe::Error& error) {
      part.text += error_line(line, from_input, error.what(), options);
      part.failed = true;
    }
    part.text += '\n';
    if (part.failed && options.strict) break;
  }
  return part;
}

/// Answers records in parts, on all threads if `threads` says so, and writes them in order. Returns whether
/// one failed.
bool write_answers(std::span<const std::string> records, std::size_t number, bool from_input,
                   const RecordOptions& options, const AnswerRecord& answer, Threads threads) {
  constexpr std::size_t kPart = 64;
  std::vector<Part> parts((records.size() + kPart - 1) / kPart);
  const auto answer_one = [&](std::size_t k) {
    const std::size_t first = k * kPart;
    parts[k] = answer_part(records.subspan(first, std::min(kPart, records.size() - first)), number + first,
                           from_input, options, answer);
  };
  if (threads == Threads::kAll && parts.size() > 1) {
    oneapi::tbb::parallel_for(std::size_t{0}, parts.size(), answer_one);
  } else {
    for (std::size_t k = 0; k < parts.size(); ++k) {
      answer_one(k);
      if (parts[k].failed && options.strict) break;
    }
  }
  bool failed = false;
  for (const Part& part : parts) {
    std::fwrite(part.text.data(), 1, part.text.size(), stdout);
    failed = failed || part.failed;
    if (failed && options.strict) break;
  }
  return failed;
}

}  // namespace

void add_record_options(CLI::App& command, RecordOptions& options) {
  CLI::Option* json = command.add_flag("--json", options.json, "one JSON object a line");
  command.add_flag("--csv", options.csv, "a table with a header line")->excludes(json);
  command.add_flag("--strict", options.strict, "stop at the first bad record");
  command
      .add_option("--precision", options.precision, "decimals of every number with a fraction (default: all)")
      ->check(CLI::Range(0, 17));
}

int answer_records(const std::vector<std::string>& operands, const RecordOptions& options,
                   const std::string& csv_header,
                   const std::function<std::string(const std::string&)>& answer, Threads threads) {
  bool failed = false;
  if (options.csv) std::fputs((csv_header + '\n').c_str(), stdout);
  if (!operands.empty()) {
    failed = write_answers(operands, 1, false, options, answer, threads);
  } else {
    LineReader reader;
    std::size_t number = 1;
    for (std::vector<std::string> lines = reader.next(); !lines.empty(); lines = reader.next()) {
      failed = write_answers(lines, number, true, options, answer, threads) || failed;
      if (failed && options.strict) break;
      number += lines.size();
    }
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw globe::Error("standard output", "could not be written", "check that the disk is not full");
  return failed ? 1 : 0;
}

void append_number(std::string& text, double value, std::optional<int> precision) {
  std::array<char, 400> digits;
  const double no_minus_zero = value + 0.0;
  char* const first = digits.data();
  char* const last = digits.data() + digits.size();
  const char* end = precision
                        ? std::to_chars(first, last, no_minus_zero, std::chars_format::fixed, *precision).ptr
                        : std::to_chars(first, last, no_minus_zero).ptr;
  std::string_view shown_text(first, static_cast<std::size_t>(end - first));
  if (shown_text.starts_with('-') && shown_text.find_first_not_of("-0.") == std::string_view::npos)
    shown_text.remove_prefix(1);
  text += shown_text;
}

void append_integer(std::string& text, std::uint64_t value) {
  std::array<char, 20> digits;
  text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

std::string number_text(double value, std::optional<int> precision) {
  std::string text;
  append_number(text, value, precision);
  return text;
}

double shown(double value, std::optional<int> precision) {
  if (!precision) return value + 0.0;
  const std::string text = number_text(value, precision);
  double result = 0;
  std::from_chars(text.data(), text.data() + text.size(), result);
  return result;
}

double shown_longitude(double lon_deg, std::optional<int> precision) {
  const double lon = shown(lon_deg, precision);
  return lon >= 180.0 ? lon - 360.0 : lon;
}

std::optional<std::string> take_planet(std::vector<std::string>& operands) {
  if (operands.empty()) return std::nullopt;
  const std::string word = operands.front();
  std::error_code ignored;
  if (!word.starts_with("procedural") && !std::filesystem::is_directory(word, ignored)) return std::nullopt;
  operands.erase(operands.begin());
  return word;
}

}  // namespace app
