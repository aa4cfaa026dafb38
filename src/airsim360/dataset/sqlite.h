// A thin wrapper of SQLite for this module: errors become exceptions, handles close themselves.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace airsim360::internal {

/// An open database file. Every failure is a RuntimeError that names the file and SQLite's reason.
class Database {
 public:
  enum class Mode { kRead, kWrite };  ///< kWrite creates the file if it is missing
  Database(std::filesystem::path path, Mode mode);

  /// Runs statements that give no rows.
  void Run(const std::string& sql);
  const std::filesystem::path& path() const { return path_; }
  sqlite3* handle() const { return handle_.get(); }
  [[noreturn]] void Fail() const;

 private:
  std::filesystem::path path_;
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> handle_;
};

/// A prepared statement. Parameters and columns are numbered from 0.
class Statement {
 public:
  Statement(Database& database, const std::string& sql);

  Statement& Bind(int parameter, int64_t value);
  Statement& Bind(int parameter, double value);
  Statement& Bind(int parameter, std::string_view value);
  /// True if there is a row; false at the end, and the statement can be bound and run again.
  bool Next();
  /// Runs a statement that gives no rows.
  void Run();
  int64_t Int(int column) const;
  double Real(int column) const;
  std::string Text(int column) const;

 private:
  void Check(int code) const;
  Database& database_;
  std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement_;
};

/// Rolls back in its destructor unless Commit was called.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void Commit();

 private:
  Database* database_;
};

}  // namespace airsim360::internal
