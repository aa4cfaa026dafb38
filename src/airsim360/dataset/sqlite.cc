#include "airsim360/dataset/sqlite.h"

#include <sqlite3.h>

#include "airsim360/base/error.h"

namespace airsim360::internal {

Database::Database(std::filesystem::path path, Mode mode) : path_(std::move(path)), handle_(nullptr, sqlite3_close_v2) {
  sqlite3* handle = nullptr;
  const int flags = mode == Mode::kRead ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  const int code = sqlite3_open_v2(path_.c_str(), &handle, flags, nullptr);
  handle_.reset(handle);
  if (code != SQLITE_OK) Fail();
  sqlite3_extended_result_codes(handle, 1);
  constexpr int kPatienceMs = 60'000;  // while another process of the same collection writes
  sqlite3_busy_timeout(handle, kPatienceMs);
}

void Database::Fail() const { throw RuntimeError(path_.string() + ": " + (handle_ ? sqlite3_errmsg(handle_.get()) : "out of memory")); }

void Database::Run(const std::string& sql) {
  if (sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) Fail();
}

Statement::Statement(Database& database, const std::string& sql) : database_(database), statement_(nullptr, sqlite3_finalize) {
  sqlite3_stmt* statement = nullptr;
  Check(sqlite3_prepare_v2(database.handle(), sql.c_str(), -1, &statement, nullptr));
  statement_.reset(statement);
}

void Statement::Check(int code) const {
  if (code != SQLITE_OK) database_.Fail();
}

Statement& Statement::Bind(int parameter, int64_t value) {
  Check(sqlite3_bind_int64(statement_.get(), parameter + 1, value));
  return *this;
}

Statement& Statement::Bind(int parameter, double value) {
  Check(sqlite3_bind_double(statement_.get(), parameter + 1, value));
  return *this;
}

Statement& Statement::Bind(int parameter, std::string_view value) {
  Check(sqlite3_bind_text64(statement_.get(), parameter + 1, value.data(), value.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
  return *this;
}

bool Statement::Next() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) database_.Fail();
  Check(sqlite3_reset(statement_.get()));
  return false;
}

void Statement::Run() {
  while (Next()) {
  }
}

int64_t Statement::Int(int column) const { return sqlite3_column_int64(statement_.get(), column); }
double Statement::Real(int column) const { return sqlite3_column_double(statement_.get(), column); }

std::string Statement::Text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  return text ? std::string(text, static_cast<size_t>(sqlite3_column_bytes(statement_.get(), column))) : std::string();
}

Transaction::Transaction(Database& database) : database_(&database) { database.Run("BEGIN IMMEDIATE"); }

Transaction::~Transaction() {
  if (database_) sqlite3_exec(database_->handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::Commit() {
  database_->Run("COMMIT");
  database_ = nullptr;
}

}  // namespace airsim360::internal
