#include "app/records.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "globe/base/error.h"

namespace app {
namespace {

constexpr std::size_t kLongestRecord = 65536;

/// Lines of standard input. Before it waits for more it flushes standard output.
class LineReader {
 public:
  /// False at the end. Of a line longer than kLongestRecord only the beginning is kept, one byte too many.
  bool next(std::string& line) {
    line.clear();
    bool any = false;
    for (;;) {
      if (begin_ == end_ && !fill()) break;
      any = true;
      const char* start = buffer_.data() + begin_;
      const auto* newline = static_cast<const char*>(std::memchr(start, '\n', end_ - begin_));
      const std::size_t length =
          newline == nullptr ? end_ - begin_ : static_cast<std::size_t>(newline - start);
      line.append(start, std::min(length, kLongestRecord + 1 - line.size()));
      begin_ += length;
      if (newline == nullptr) continue;
      ++begin_;
      break;
    }
    if (line.ends_with('\r')) line.pop_back();
    return any;
  }

 private:
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

  std::array<char, 65536> buffer_{};
  std::size_t begin_ = 0, end_ = 0;
};

std::string error_line(std::size_t line, std::string reason, const RecordOptions& options) {
  for (char& c : reason) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  if (options.json) {
    const nlohmann::ordered_json object{{"line", line}, {"error", reason}};
    return object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  }
  if (!options.csv) return "ERROR: " + reason;
  std::string doubled;
  for (const char c : reason) doubled += c == '"' ? std::string("\"\"") : std::string(1, c);
  return "\"ERROR: " + doubled + "\"";
}

void write_line(const std::string& line) {
  std::fwrite(line.data(), 1, line.size(), stdout);
  std::putchar('\n');
}

bool is_comment(const std::string& line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first == std::string::npos || line[first] == '#';
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
                   const std::function<std::string(const std::string&)>& answer) {
  int status = 0;
  const auto write_answer = [&](const std::string& record, std::size_t line) {
    try {
      if (record.size() > kLongestRecord)
        throw globe::Error("record", "is too long", "write one record a line");
      write_line(answer(record));
    } catch (const globe::Error& error) {
      write_line(error_line(line, error.what(), options));
      status = 1;
    }
    return status == 0 || !options.strict;
  };
  if (options.csv) write_line(csv_header);
  if (!operands.empty()) {
    std::size_t number = 0;
    for (const std::string& operand : operands) {
      if (!write_answer(operand, ++number)) break;
    }
  } else {
    LineReader reader;
    std::string line;
    for (std::size_t number = 1; reader.next(line); ++number) {
      if (is_comment(line)) {
        if (!options.json && !options.csv) write_line(line);
      } else if (!write_answer(line, number)) {
        break;
      }
    }
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw globe::Error("standard output", "could not be written", "check that the disk is not full");
  return status;
}

std::string number_text(double value, std::optional<int> precision) {
  std::array<char, 400> text{};
  const double no_minus_zero = value + 0.0;
  char* const first = text.data();
  char* const last = text.data() + text.size();
  const char* end = precision
                        ? std::to_chars(first, last, no_minus_zero, std::chars_format::fixed, *precision).ptr
                        : std::to_chars(first, last, no_minus_zero).ptr;
  std::string_view shown_text(first, static_cast<std::size_t>(end - first));
  if (shown_text.starts_with('-') && shown_text.find_first_not_of("-0.") == std::string_view::npos)
    shown_text.remove_prefix(1);
  return std::string(shown_text);
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
