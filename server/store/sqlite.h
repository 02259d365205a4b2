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

/// A connection to an SQLite file. Not thread-safe. Every failure throws ServiceError: with its shortage (full disk,
/// lock, no descriptors or memory), data_loss for a damaged file or one that is not a database, otherwise internal.
class Database {
 public:
  /// How to open the file; synchronous=FULL and foreign keys are always on.
  enum class Access {
    shared,       ///< beside other connections, in WAL mode; creates a missing file
    single_file,  ///< for a file that nobody else has open: complete without a WAL once closed
    read_only,    ///< changes nothing
  };
  explicit Database(const std::filesystem::path& path, Access access = Access::shared);

  /// How long a statement waits for another connection's lock before it fails.
  static constexpr std::chrono::milliseconds kPatience{10'000};
  void set_patience(std::chrono::milliseconds patience);

  /// Copies the current contents of `source` into this database in one piece, while others write to `source`.
  void copy_from(Database& source);

  /// Runs statements without result rows.
  void execute(const char* sql);

  /// Row number of the last insertion.
  [[nodiscard]] std::int64_t last_number() const;

  /// Whether a transaction is open: a failure may have ended it.
  [[nodiscard]] bool in_transaction() const;

  [[nodiscard]] sqlite3* raw() const { return handle_.get(); }

 private:
  friend class Statement;

  struct Close {
    void operator()(sqlite3* handle) const;
  };
  struct Finalize {
    void operator()(sqlite3_stmt* handle) const;
  };
  using Prepared = std::unique_ptr<sqlite3_stmt, Finalize>;

  std::unique_ptr<sqlite3, Close> handle_;
  /// Unused prepared statements by text: parsing takes longer than running most statements.
  std::map<std::string, std::vector<Prepared>, std::less<>> idle_;
};

/// A prepared statement, returned to its database for reuse. Parameters count from 1 and columns from 0, as in SQLite.
/// The database outlives it.
class Statement {
 public:
  Statement(Database& database, std::string_view sql) : Statement(database, sql, Reuse::yes) {}
  /// A statement whose text depends on a caller's request is not kept, since their number is unbounded.
  enum class Reuse { yes, no };
  Statement(Database& database, std::string_view sql, Reuse reuse);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(int parameter, std::int64_t value);
  Statement& bind_text(int parameter, const std::string& value);
  Statement& bind_blob(int parameter, const std::string& value);
  Statement& bind_null(int parameter);

  /// Advances to the next row; false at the end.
  bool step();
  /// Runs a statement without result rows, and resets it.
  void run();

  /// First column of the next row, 0 without one; and of all further rows.
  std::int64_t number();
  std::vector<std::int64_t> numbers();

  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] std::string bytes(int column) const;

 private:
  Database& database_;
  std::map<std::string, std::vector<Database::Prepared>, std::less<>>::iterator
      place_;  ///< where it is returned; the end: nowhere
  Database::Prepared handle_;
};

/// A write transaction, rolled back unless committed.
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
