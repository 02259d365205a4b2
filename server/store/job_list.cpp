// Lists of jobs, with and without a filter.
#include <algorithm>
#include <string>
#include <utility>

#include "error.h"
#include "store/job_filter.h"
#include "store/journal_reader.h"

namespace cellcrush::store {
namespace {

// Reading a batch locks out other readers, which get their turn between two batches.
constexpr int kBatch = 200;
constexpr std::size_t kBatchBytes = 4'000'000;
// Numbers searched by one statement.
constexpr std::int64_t kWindow = 100'000;

}  // namespace

std::vector<StoredJob> JournalReader::list_jobs(const JobFilter& wanted, bool newest_first, std::int64_t after,
                                                int limit, std::size_t most_bytes,
                                                const std::function<bool()>& given_up) {
  std::vector<StoredJob> out;
  std::size_t bytes = 0;
  const std::int64_t end = newest_number() + 1;
  std::int64_t next = newest_first && after == 0 ? end : after;
  while (newest_first ? next > 1 : next < end - 1) {
    if (given_up()) throw ServiceError(ServiceError::Kind::cancelled, "The client cancelled the call.");
    const Range range = newest_first ? Range{std::max<std::int64_t>(next - kWindow, 0), next}
                                     : Range{next, std::min(next + kWindow, end)};
    const int room = limit - static_cast<int>(out.size());
    auto batch = read_batch(wanted, newest_first, range, std::min(kBatch, room));
    if (batch.empty()) {
      next = newest_first ? range.low + 1 : range.high - 1;
      continue;
    }
    next = batch.back().number;
    for (auto& job : batch) {
      // The indexes and labels by which jobs are found have no checksum.
      if (!job.is_damaged && !matches(wanted, job.job)) continue;
      bytes += job.job.ByteSizeLong();
      out.push_back(std::move(job));
      if (static_cast<int>(out.size()) == limit || bytes > most_bytes) return out;
    }
  }
  return out;
}

std::vector<StoredJob> JournalReader::read_batch(const JobFilter& wanted, bool newest_first, const Range& range,
                                                 int limit) {
  const MutexLock lock(mutex_);
  const JobConditions conditions(wanted, 4);
  const std::string direction = newest_first ? " DESC" : "";
  const std::string number = conditions.numbers().column;
  Statement read(database_,
                 std::string("SELECT ") + kJobColumns + " FROM jobs WHERE number IN (SELECT " + number + " FROM " +
                     conditions.numbers().table + " WHERE " + number + " > ?1 AND " + number + " < ?2" +
                     conditions.sql() + " ORDER BY " + number + direction + " LIMIT ?3) ORDER BY number" + direction,
                 Statement::Reuse::no);
  read.bind(1, range.low).bind(2, range.high).bind(3, limit);
  conditions.bind_to(read);
  std::vector<StoredJob> out;
  std::size_t bytes = 0;
  while (bytes < kBatchBytes && read.step()) {
    out.push_back(read_job(read));
    bytes += out.back().job.ByteSizeLong();
  }
  return out;
}

std::int64_t JournalReader::newest_number() {
  const MutexLock lock(mutex_);
  return Statement(database_, "SELECT COALESCE(MAX(number), 0) FROM jobs").number();
}

}  // namespace cellcrush::store
