#pragma once

#include <cstddef>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace globe {

/// One record of a CSV file, or why there is none.
struct CsvRecord {
  std::vector<std::string> fields;
  std::size_t line = 0;  ///< where it begins, from 1
  std::string fault;     ///< not empty: the line is no record, and the fields mean nothing
};

/// Reads comma-separated values (RFC 4180) record by record.
///
/// By libcsv in its strict mode: quoted fields may hold commas, newlines and doubled quotes, lines may end in
/// LF or CRLF, blank lines are passed over, spaces around a field that is not quoted are no part of it. A
/// byte order mark is passed over. Memory: one record, at most kLongest bytes.
///
/// A fault costs one line: after an opening quote without its end, reading goes on with the next line.
class CsvReader {
 public:
  static constexpr std::size_t kLongest = std::size_t{1} << 20;

  explicit CsvReader(std::istream& stream);
  ~CsvReader();
  CsvReader(const CsvReader&) = delete;
  CsvReader& operator=(const CsvReader&) = delete;

  /// Nothing at the end.
  std::optional<CsvRecord> next();

 private:
  struct Parser;

  bool read_line(std::string& line);

  std::istream& stream_;
  std::unique_ptr<Parser> parser_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;
  std::vector<std::string> again_;  ///< lines to be read anew, last first
  std::size_t next_line_ = 1;
};

}  // namespace globe
