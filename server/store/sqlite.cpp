#include "store/sqlite.h"

#include <sqlite3.h>

#include <cerrno>
#include <utility>

#include "error.h"
#include "store/durable_file.h"
#include "store/row_checksum.h"

namespace cellcrush::store {
namespace {

// An I/O error means what its errno says: SQLite returns SQLITE_FULL for only some of its files.
Shortage shortage_of(sqlite3* handle, int code) {
  switch (code & 0xFF) {
    case SQLITE_FULL: return Shortage::full_disk;
    case SQLITE_NOMEM: return Shortage::memory;
    case SQLITE_IOERR:
    case SQLITE_CANTOPEN: {
      const int error = handle != nullptr ? sqlite3_system_errno(handle) : 0;
      const bool unknown = error == 0 || shortage_of_errno(error) == Shortage::data_folder;
      return unknown ? Shortage::journal : shortage_of_errno(error);
    }
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_PROTOCOL: return Shortage::journal;
    default: return Shortage::none;
  }
}

// "PATH", or its placeholder.
std::string file_of(sqlite3* handle) {
  const char* path = handle != nullptr ? sqlite3_db_filename(handle, "main") : nullptr;
  return path != nullptr && *path != '\0' ? path : "The job journal";
}

// Our statements fit the tables, unless the schema is damaged.
bool is_of_schema(std::string_view reason) {
  return reason.starts_with("no such table") || reason.starts_with("no such column") ||
         reason.starts_with("no such index") || reason.starts_with("unknown function") ||
         reason.find(" has no column named ") != std::string_view::npos;
}

[[noreturn]] void fail(sqlite3* handle, int code) {
  const std::string reason = handle != nullptr ? sqlite3_errmsg(handle) : sqlite3_errstr(code);
  const std::string message = "The job journal cannot be used: " + reason + ".";
  if (const Shortage shortage = shortage_of(handle, code); shortage != Shortage::none)
    throw ServiceError(shortage, message);
  if ((code & 0xFF) == SQLITE_NOTADB) {
    throw ServiceError(ServiceError::Kind::data_loss,
                       file_of(handle) + " is not a cellcrushd journal (" + reason +
                           "). Restore a backup to a new folder with `cellcrushd restore`, or move the file away to "
                           "start with an empty journal.");
  }
  if ((code & 0xFF) == SQLITE_CORRUPT || ((code & 0xFF) == SQLITE_ERROR && is_of_schema(reason))) {
    throw ServiceError(ServiceError::Kind::data_loss, file_of(handle) + " is damaged (" + reason +
                                                          "). Run `cellcrushd verify` to list the damage, and restore "
                                                          "a backup to a new folder with `cellcrushd restore`.");
  }
  throw ServiceError(ServiceError::Kind::internal, message);
}

// Otherwise every connection takes 90 kB at once for its first pages.
void allocate_pages_singly() {
  [[maybe_unused]] static const int code = sqlite3_config(SQLITE_CONFIG_PAGECACHE, nullptr, 0, 0);
}

}  // namespace

Database::Database(const std::filesystem::path& path, Access access) {
  // SQLite opens its files by their names, and would wait for the other end of a FIFO.
  for (const char* suffix : {"", "-wal", "-shm", "-journal"}) {
    const auto file = path.string() + suffix;
    const auto found = find_own(file);
    if (!found && errno == ELOOP) throw_file_error(file, "used", ELOOP);
    if (found && !S_ISREG(found->st_mode))
      throw_file_error(file, "used", S_ISLNK(found->st_mode) ? ELOOP : kNotRegular);
  }
  allocate_pages_singly();
  sqlite3* handle = nullptr;
  const int mode = access == Access::read_only ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  const int code = sqlite3_open_v2(path.c_str(), &handle, mode | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_NOFOLLOW, nullptr);
  handle_.reset(handle);
  if (code != SQLITE_OK) fail(handle, code);
  sqlite3_extended_result_codes(handle, 1);
  if (add_row_checksum(handle) != SQLITE_OK) fail(handle, sqlite3_errcode(handle));
  set_patience(kPatience);
  if (access == Access::shared) {
    // Only a file created with this setting can return free pages (JournalUpkeep).
    if (Statement(*this, "PRAGMA page_count").number() == 0) execute("PRAGMA auto_vacuum=INCREMENTAL;");
    idle_.clear();
    // The log keeps its size when closed, so that the next start needs no room on a full disk. A journal_size_limit
    // would truncate it.
    int keep = 1;
    sqlite3_file_control(handle, "main", SQLITE_FCNTL_PERSIST_WAL, &keep);
    execute("PRAGMA journal_mode=WAL;");
  }
  if (access == Access::single_file) execute("PRAGMA journal_mode=DELETE;");
  execute("PRAGMA synchronous=FULL; PRAGMA foreign_keys=ON;");
}

void Database::set_patience(std::chrono::milliseconds patience) {
  sqlite3_busy_timeout(raw(), static_cast<int>(patience.count()));
}

void Database::copy_from(Database& source) {
  sqlite3_backup* copy = sqlite3_backup_init(raw(), "main", source.raw(), "main");
  if (copy == nullptr) fail(raw(), sqlite3_errcode(raw()));
  const int code = sqlite3_backup_step(copy, -1);
  sqlite3_backup_finish(copy);
  if (code != SQLITE_DONE) fail(raw(), code);
}

void Database::execute(const char* sql) {
  const int code = sqlite3_exec(handle_.get(), sql, nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(handle_.get(), code);
}

std::int64_t Database::last_number() const { return sqlite3_last_insert_rowid(handle_.get()); }

bool Database::in_transaction() const { return sqlite3_get_autocommit(handle_.get()) == 0; }

void Database::Close::operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }

void Database::Finalize::operator()(sqlite3_stmt* handle) const { sqlite3_finalize(handle); }

Statement::Statement(Database& database, std::string_view sql, Reuse reuse)
    : database_(database), place_(database.idle_.find(sql)) {
  if (place_ == database.idle_.end() && reuse == Reuse::yes) place_ = database.idle_.emplace(sql, 0).first;
  if (place_ != database.idle_.end() && !place_->second.empty()) {
    handle_ = std::move(place_->second.back());
    place_->second.pop_back();
    return;
  }
  sqlite3_stmt* handle = nullptr;
  const int code = sqlite3_prepare_v3(database.raw(), sql.data(), static_cast<int>(sql.size()),
                                      SQLITE_PREPARE_PERSISTENT, &handle, nullptr);
  if (code != SQLITE_OK) fail(database.raw(), code);
  handle_.reset(handle);
}

// Without the reset its transaction would stay open.
Statement::~Statement() {
  if (place_ == database_.idle_.end()) return;
  sqlite3_reset(handle_.get());
  sqlite3_clear_bindings(handle_.get());
  place_->second.push_back(std::move(handle_));
}

Statement& Statement::bind(int parameter, std::int64_t value) {
  if (const int code = sqlite3_bind_int64(handle_.get(), parameter, value); code != SQLITE_OK)
    fail(database_.raw(), code);
  return *this;
}

Statement& Statement::bind_text(int parameter, const std::string& value) {
  const int code =
      sqlite3_bind_text64(handle_.get(), parameter, value.data(), value.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
  if (code != SQLITE_OK) fail(database_.raw(), code);
  return *this;
}

Statement& Statement::bind_blob(int parameter, const std::string& value) {
  const int code = sqlite3_bind_blob64(handle_.get(), parameter, value.data(), value.size(), SQLITE_TRANSIENT);
  if (code != SQLITE_OK) fail(database_.raw(), code);
  return *this;
}

Statement& Statement::bind_null(int parameter) {
  if (const int code = sqlite3_bind_null(handle_.get(), parameter); code != SQLITE_OK) fail(database_.raw(), code);
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(handle_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) {
    sqlite3_reset(handle_.get());
    fail(database_.raw(), code);
  }
  return false;
}

void Statement::run() {
  step();
  sqlite3_reset(handle_.get());
}

std::int64_t Statement::number() { return step() ? integer(0) : 0; }

std::vector<std::int64_t> Statement::numbers() {
  std::vector<std::int64_t> out;
  while (step()) out.push_back(integer(0));
  return out;
}

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(handle_.get(), column); }

std::string Statement::bytes(int column) const {
  const void* data = sqlite3_column_blob(handle_.get(), column);
  const int size = sqlite3_column_bytes(handle_.get(), column);
  return data == nullptr ? std::string() : std::string(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

Transaction::Transaction(Database& database) : database_(database) { Statement(database_, "BEGIN IMMEDIATE").run(); }

Transaction::~Transaction() {
  // A failed commit may already have rolled back; a failing rollback cannot be handled.
  if (open_) sqlite3_exec(database_.raw(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  Statement(database_, "COMMIT").run();
  open_ = false;
}

}  // namespace cellcrush::store
