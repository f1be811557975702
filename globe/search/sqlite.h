#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

namespace globe::search {

struct CloseSqlite {
  void operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
};
struct FinalizeSqlite {
  void operator()(sqlite3_stmt* handle) const { sqlite3_finalize(handle); }
};

/// An SQLite file that is open. What SQLite refuses is thrown as Error that names the file.
class Connection {
 public:
  /// A new, empty file, in place of what has that name. Throws Error.
  static Connection create(const std::filesystem::path& path);

  /// An existing file, for reading only; nothing that its schema holds is trusted to be harmless. Throws
  /// Error when there is none. Whether it is a database is found out by the first statement.
  static Connection open_read_only(const std::filesystem::path& path);

  /// Runs statements that answer nothing.
  void execute(const char* sql);

  sqlite3* handle() const { return handle_.get(); }

 private:
  Connection(const std::filesystem::path& path, int flags);

  std::unique_ptr<sqlite3, CloseSqlite> handle_;
};

/// Bytes to be stored as a BLOB.
struct Blob {
  std::string_view bytes;
};

/// A prepared statement. Parameters count from 1, columns from 0; neither is checked but by SQLite.
class Statement {
 public:
  Statement(Connection& connection, std::string_view sql);

  /// Sets parameters 1, 2, ... and begins anew. Texts are not copied: they must live until the last step().
  template <typename... Values>
  Statement& with(const Values&... values) {
    sqlite3_reset(handle_.get());
    int index = 0;
    (bind(++index, values), ...);
    return *this;
  }

  /// Goes to the next row; false at the end. Throws Error.
  bool step();

  /// Ends a statement that is not to be stepped to its end.
  void reset() { sqlite3_reset(handle_.get()); }

  bool is_null(int column) const { return sqlite3_column_type(handle_.get(), column) == SQLITE_NULL; }
  std::int64_t integer(int column) const { return sqlite3_column_int64(handle_.get(), column); }
  double real(int column) const { return sqlite3_column_double(handle_.get(), column); }
  /// Text or blob; until the next step. Empty for NULL.
  std::string_view bytes(int column) const;

 private:
  void bind(int index, std::int64_t value);
  void bind(int index, std::uint64_t value) { bind(index, static_cast<std::int64_t>(value)); }
  void bind(int index, int value) { bind(index, static_cast<std::int64_t>(value)); }
  void bind(int index, double value);
  void bind(int index, std::string_view text);
  void bind(int index, const Blob& blob);
  void check(int result) const;

  std::unique_ptr<sqlite3_stmt, FinalizeSqlite> handle_;
};

}  // namespace globe::search
