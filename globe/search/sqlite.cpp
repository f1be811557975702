#include "globe/search/sqlite.h"

#include <cerrno>
#include <cstring>
#include <string>

#include "globe/base/error.h"

namespace globe::search {
namespace {

constexpr const char* kIndexAgain = "index the features again";

[[noreturn]] void fail(sqlite3* handle) {
  const char* name = sqlite3_db_filename(handle, "main");
  const std::string file = name == nullptr || *name == '\0' ? "SQLite" : name;
  const std::string why = sqlite3_errmsg(handle);
  switch (sqlite3_errcode(handle) & 0xff) {
    case SQLITE_NOTADB:
      throw Error(file, "it is no SQLite file", "give a database that globe index has made");
    case SQLITE_CORRUPT:
    case SQLITE_ERROR:
    case SQLITE_MISMATCH:
      throw Error(file, "it is damaged (" + why + ")", kIndexAgain);
    case SQLITE_FULL:
    case SQLITE_IOERR:
      throw Error(file, why, "check the disk and its free space");
    default:
      throw Error(file, why, "check the file and its permissions");
  }
}

}  // namespace

Connection::Connection(const std::filesystem::path& path, int flags) {
  sqlite3* handle = nullptr;
  const int result = sqlite3_open_v2(path.c_str(), &handle, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  handle_.reset(handle);
  if (result == SQLITE_OK) return;
  const int reason = handle == nullptr ? ENOMEM : sqlite3_system_errno(handle);
  throw Error(path.string(), reason != 0 ? std::strerror(reason) : sqlite3_errstr(result),
              "check its name and its permissions");
}

Connection Connection::create(const std::filesystem::path& path) {
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  return {path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE};
}

Connection Connection::open_read_only(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    throw Error(path.string(), "there is no such file", "make one with globe index");
  if (std::filesystem::is_directory(path, ignored))
    throw Error(path.string(), "it is a folder", "give a database that globe index has made");
  Connection connection(path, SQLITE_OPEN_READONLY);
  sqlite3* handle = connection.handle();
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  return connection;
}

void Connection::execute(const char* sql) {
  if (sqlite3_exec(handle_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail(handle_.get());
}

Statement::Statement(Connection& connection, std::string_view sql) {
  sqlite3_stmt* handle = nullptr;
  const int result = sqlite3_prepare_v3(connection.handle(), sql.data(), static_cast<int>(sql.size()),
                                        SQLITE_PREPARE_PERSISTENT, &handle, nullptr);
  handle_.reset(handle);
  if (result != SQLITE_OK) fail(connection.handle());
}

bool Statement::step() {
  const int result = sqlite3_step(handle_.get());
  if (result == SQLITE_ROW) return true;
  if (result != SQLITE_DONE) fail(sqlite3_db_handle(handle_.get()));
  return false;
}

std::string_view Statement::bytes(int column) const {
  const void* data = sqlite3_column_blob(handle_.get(), column);
  if (data == nullptr) return {};
  return {static_cast<const char*>(data),
          static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column))};
}

void Statement::check(int result) const {
  if (result != SQLITE_OK) fail(sqlite3_db_handle(handle_.get()));
}

void Statement::bind(int index, std::int64_t value) {
  check(sqlite3_bind_int64(handle_.get(), index, value));
}

void Statement::bind(int index, double value) { check(sqlite3_bind_double(handle_.get(), index, value)); }

void Statement::bind(int index, std::string_view text) {
  const char* data = text.data() == nullptr ? "" : text.data();  // a null pointer would be NULL
  check(sqlite3_bind_text64(handle_.get(), index, data, text.size(), SQLITE_STATIC, SQLITE_UTF8));
}

void Statement::bind(int index, const Blob& blob) {
  check(sqlite3_bind_blob64(handle_.get(), index, blob.bytes.data(), blob.bytes.size(), SQLITE_STATIC));
}

}  // namespace globe::search
