#include "store/change_reader.h"

#include <string>

#include "error.h"

namespace cellcrush::store {

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

std::vector<Change> ChangeReader::after(std::int64_t change, int limit) {
  const MutexLock lock(mutex_);
  Statement read(database_,
                 "SELECT number, kind, resource, sequence, checksum = expected_checksum FROM changes WHERE number > ?1 "
                 "ORDER BY number LIMIT ?2");
  read.bind(1, change).bind(2, limit);
  std::vector<Change> out;
  while (read.step()) {
    if (read.integer(4) == 0) {
      if (!out.empty()) break;
      throw ServiceError(ServiceError::Kind::data_loss, "Change " + std::to_string(read.integer(0)) +
                                                            " cannot be read: the journal was damaged. Watch again " +
                                                            "from the beginning.");
    }
    out.push_back({read.integer(0), static_cast<ChangeKind>(read.integer(1)), read.integer(2), read.integer(3)});
  }
  return out;
}

}  // namespace cellcrush::store
