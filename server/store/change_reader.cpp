#include "store/change_reader.h"

#include <spdlog/spdlog.h>

#include <string>

#include "error.h"
#include "store/journal_schema.h"

namespace cellcrush::store {
namespace {

constexpr const char* kRowsAfter =
    "SELECT number, kind, resource, sequence, checksum = expected_checksum FROM changes WHERE number > ?1 "
    "ORDER BY number LIMIT ?2";

Change change_of(const Statement& row) {
  return {row.integer(0), static_cast<ChangeKind>(row.integer(1)), row.integer(2), row.integer(3)};
}

}  // namespace

ChangeReader::ChangeReader(const std::filesystem::path& path) : database_(path) {}

std::int64_t ChangeReader::last() {
  const MutexLock lock(mutex_);
  return read_last();
}

bool ChangeReader::has_after(std::int64_t change, const Stamp& stamp) {
  const MutexLock lock(mutex_);
  if (stamp_ != stamp) {
    last_ = read_last();
    stamp_ = stamp;
  }
  return last_ > change;
}

std::int64_t ChangeReader::read_last() {
  return Statement(database_, "SELECT COALESCE(MAX(number), 0) FROM changes").number();
}

bool ChangeReader::has_all_after(std::int64_t change) {
  const MutexLock lock(mutex_);
  Statement read(database_, "SELECT COALESCE(MIN(number), 1) FROM changes");
  return read.step() && change >= read.integer(0) - 1;
}

std::string ChangeReader::fact(const std::string& name) {
  const MutexLock lock(mutex_);
  return read_fact(database_, name);
}

ChangeReader::Readable ChangeReader::readable_after(std::int64_t change, int limit) {
  const MutexLock lock(mutex_);
  Statement read(database_, kRowsAfter);
  read.bind(1, change).bind(2, limit);
  Readable out;
  while (read.step()) {
    out.last = read.integer(0);
    if (out.first == 0) out.first = out.last;
    if (read.integer(4) == 0) {
      spdlog::error("Change {} cannot be read: the journal was damaged. Receivers of notices may miss one.", out.last);
    } else {
      out.changes.push_back(change_of(read));
    }
  }
  return out;
}

std::vector<Change> ChangeReader::after(std::int64_t change, int limit) {
  const MutexLock lock(mutex_);
  Statement read(database_, kRowsAfter);
  read.bind(1, change).bind(2, limit);
  std::vector<Change> out;
  while (read.step()) {
    if (read.integer(4) == 0) {
      if (!out.empty()) break;
      throw ServiceError(ServiceError::Kind::data_loss, "Change " + std::to_string(read.integer(0)) +
                                                            " cannot be read: the journal was damaged. Watch again " +
                                                            "from the beginning.");
    }
    out.push_back(change_of(read));
  }
  return out;
}

}  // namespace cellcrush::store
