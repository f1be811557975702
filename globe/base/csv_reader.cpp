#include "globe/base/csv_reader.h"

#include <csv.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <utility>

namespace globe {
namespace {

constexpr std::size_t kBuffer = std::size_t{1} << 18;

}  // namespace

/// libcsv's parser, fed with whole lines.
struct CsvReader::Parser {
  csv_parser state{};
  std::vector<std::string> fields;
  bool complete = false;

  Parser() { begin(); }
  ~Parser() { csv_free(&state); }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;

  void begin() {
    csv_init(&state, CSV_STRICT | CSV_STRICT_FINI);
    csv_set_blk_size(&state, 4096);
    // Records end at LF; a CR before it is space.
    csv_set_term_func(&state, [](unsigned char c) { return static_cast<int>(c == CSV_LF); });
    csv_set_space_func(&state, [](unsigned char c) {
      return static_cast<int>(c == CSV_SPACE || c == CSV_TAB || c == CSV_CR);
    });
    fields.clear();
    complete = false;
  }

  void restart() {
    csv_free(&state);
    begin();
  }

  static void on_field(void* text, std::size_t length, void* self) {
    static_cast<Parser*>(self)->fields.emplace_back(static_cast<const char*>(text), length);
  }
  static void on_record(int, void* self) { static_cast<Parser*>(self)->complete = true; }

  /// False when the text breaks the rules of quoting.
  bool feed(const std::string& text) {
    const std::size_t used = csv_parse(&state, text.data(), text.size(), on_field, on_record, this);
    return accepted(used == text.size());
  }
  bool finish() { return accepted(csv_fini(&state, on_field, on_record, this) == 0); }

 private:
  bool accepted(bool done) const {
    if (!done && csv_error(const_cast<csv_parser*>(&state)) != CSV_EPARSE) throw std::bad_alloc();
    return done;
  }
};

CsvReader::CsvReader(std::istream& stream)
    : stream_(stream), parser_(std::make_unique<Parser>()), buffer_(kBuffer) {
  std::string line;
  if (!read_line(line)) return;
  if (line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
  again_.push_back(std::move(line));
}

CsvReader::~CsvReader() = default;

/// Takes a line with its newline; of one that is longer than kLongest the beginning, one byte too many.
bool CsvReader::read_line(std::string& line) {
  line.clear();
  if (!again_.empty()) {
    line = std::move(again_.back());
    again_.pop_back();
    return true;
  }
  for (;;) {
    if (begin_ == end_) {
      stream_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
      begin_ = 0;
      end_ = static_cast<std::size_t>(stream_.gcount());
      if (end_ == 0) return !line.empty();
    }
    const char* start = buffer_.data() + begin_;
    const auto* newline = static_cast<const char*>(std::memchr(start, '\n', end_ - begin_));
    const std::size_t length =
        newline == nullptr ? end_ - begin_ : static_cast<std::size_t>(newline - start) + 1;
    line.append(start, std::min(length, kLongest + 1 - line.size()));
    begin_ += length;
    if (newline != nullptr) return true;
  }
}

std::optional<CsvRecord> CsvReader::next() {
  std::vector<std::string> lines;  // of this record
  std::size_t length = 0;
  const auto fault = [&](std::string why) {
    parser_->restart();
    // All but the first are read again.
    while (lines.size() > 1) {
      again_.push_back(std::move(lines.back()));
      lines.pop_back();
    }
    return CsvRecord{{}, next_line_++, std::move(why)};
  };
  std::string line;
  while (read_line(line)) {
    lines.push_back(std::move(line));
    length += lines.back().size();
    if (lines.back().size() > kLongest) return fault("the line is longer than 1 MiB");
    if (length > kLongest) return fault("a quoted field has no end within 1 MiB");
    if (!parser_->feed(lines.back())) {
      return fault(lines.size() == 1 ? "a quote stands in the middle of a field"
                                     : "a quoted field has no end here, nor where a field ends below");
    }
    if (!parser_->complete) {
      if (lines.size() > 1 || lines[0].find_first_not_of(" \t\r\n") != std::string::npos) continue;
      // A blank line.
      lines.clear();
      length = 0;
      ++next_line_;
      parser_->restart();
      continue;
    }
    CsvRecord record{std::exchange(parser_->fields, {}), next_line_, {}};
    parser_->complete = false;
    next_line_ += lines.size();
    return record;
  }
  if (lines.empty()) return std::nullopt;
  if (!parser_->finish()) return fault("a quoted field has no end");
  CsvRecord record{std::exchange(parser_->fields, {}), next_line_, {}};
  parser_->restart();
  next_line_ += lines.size();
  return record;
}

}  // namespace globe
