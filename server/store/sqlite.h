#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace cellcrush::store {

/// A connection to an SQLite file. Not thread-safe. Every failure throws ServiceError: with the shortage behind it
/// (full disk, lock, no descriptors or memory), data_loss for a file that is no database or is damaged, otherwise
/// internal.
class Database {
 public:
  /// How the file is opened; synchronous=FULL and foreign keys on in every case.
  enum class Access {
    shared,       ///< beside other connections, in WAL mode; makes the file where there is none
    single_file,  ///< for a file that nobody else has open: once closed, it is complete without a WAL
    read_only,    ///< changes nothing
  };
  explicit Database(const std::filesystem::path& path, Access access = Access::shared);

  /// How long a statement waits for a lock of another connection before it fails.
  static constexpr std::chrono::milliseconds kPatience{10'000};
  void set_patience(std::chrono::milliseconds patience);

  /// Copies what `source` holds now into this database, in one piece, while others write to `source`.
  void copy_from(Database& source);

  /// Runs statements that give no rows.
  void execute(const char* sql);

  /// Number of the row that was inserted last.
  [[nodiscard]] std::int64_t last_number() const;

  /// Whether a transaction is open: a failure may have ended it.
  [[nodiscard]] bool in_transaction() const;

  [[nodiscard]] sqlite3* raw() const { return handle_.get(); }

 private:
  friend class Statement;
  bool is_empty();

  struct Close {
    void operator()(sqlite3* handle) const;
  };
  struct Finalize {
    void operator()(sqlite3_stmt* handle) const;
  };
  using Prepared = std::unique_ptr<sqlite3_stmt, Finalize>;

  std::unique_ptr<sqlite3, Close> handle_;
  /// What was prepared before and nobody uses now, by its text: to parse that takes longer than most statements
  /// themselves.
  std::map<std::string, std::vector<Prepared>, std::less<>> idle_;
};

/// A prepared statement, which goes back to its database for the next one of the same text; parameters and columns
/// count from 1 and 0, as in SQLite. The database outlives it.
class Statement {
 public:
  Statement(Database& database, std::string_view sql) : Statement(database, sql, Reuse::yes) {}
  /// A text that a caller's request shapes is not kept: there is no bound on how many there are.
  enum class Reuse { yes, no };
  Statement(Database& database, std::string_view sql, Reuse reuse);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(int parameter, std::int64_t value);
  Statement& bind_text(int parameter, const std::string& value);
  Statement& bind_blob(int parameter, const std::string& value);
  Statement& bind_null(int parameter);

  /// Goes to the next row; false when there is none.
  bool step();
  /// Runs a statement that gives no rows, and makes it ready for the next.
  void run();

  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] std::string bytes(int column) const;

 private:
  Database& database_;
  std::map<std::string, std::vector<Database::Prepared>, std::less<>>::iterator
      place_;  ///< where it goes back to; the end: nowhere
  Database::Prepared handle_;
};

/// A write transaction: rolled back unless it was committed.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;

  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace cellcrush::store
