#include <spdlog/spdlog.h>

#include <system_error>
#include <utility>
#include <vector>

#include "store/durable_file.h"
#include "store/job_folder.h"
#include "store/job_state.h"
#include "store/journal_schema.h"
#include "store/report_log.h"
#include "store/resource_name.h"

namespace cellcrush::store {
namespace {

struct SampledJob {
  std::int64_t number = 0;
  bool has_ended = false;
  std::int64_t begun_again_sequence = 0;
};

std::vector<SampledJob> find_sampled(Database& database) {
  Statement read(database,
                 "SELECT number, state, job FROM jobs WHERE EXISTS "
                 "(SELECT 1 FROM events WHERE events.job = jobs.number AND kind = 2)");
  std::vector<SampledJob> out;
  while (read.step()) {
    v1::Job job;
    // Of a damaged one, what could be read.
    static_cast<void>(job.ParseFromString(read.bytes(2)));
    out.push_back(
        {read.integer(0), is_terminal(static_cast<v1::Job::State>(read.integer(1))), job.begun_again_sequence()});
  }
  return out;
}

// Returns the number of samples.
std::int64_t move_samples(Database& database, const SampledJob& job, const std::filesystem::path& data_folder) {
  const JobFolder folder(data_folder / name_of(job.number));
  std::error_code error;
  std::filesystem::create_directories(folder.root(), error);
  std::filesystem::remove(folder.history(), error);
  ReportLog log(folder.history());
  std::int64_t count = 0;
  Statement read(database, "SELECT payload, sequence FROM events WHERE job = ?1 AND kind = 2 ORDER BY sequence");
  read.bind(1, job.number);
  while (read.step()) {
    worker::Report report;
    if (!report.mutable_sample()->ParseFromString(read.bytes(0))) {
      spdlog::error("Event {} of {} cannot be read: the journal was damaged. The history goes on without it.",
                    read.integer(1), name_of(job.number));
      continue;
    }
    log.append(report);
    ++count;
  }
  log.synchronize();
  return count;
}

std::int64_t count_samples(Database& database, std::int64_t job) {
  Statement count(database, "SELECT COUNT(*) FROM events WHERE job = ?1 AND kind = 2");
  return count.bind(1, job).step() ? count.integer(0) : 0;
}

}  // namespace

void upgrade_from_version_6(Database& database, const std::filesystem::path& data_folder) {
  database.execute(
      "ALTER TABLE jobs ADD COLUMN samples INTEGER NOT NULL DEFAULT 0;"
      "ALTER TABLE jobs ADD COLUMN begun_again INTEGER NOT NULL DEFAULT 0;");
  for (const SampledJob& job : find_sampled(database)) {
    const std::int64_t count =
        job.has_ended ? move_samples(database, job, data_folder) : count_samples(database, job.number);
    Statement update(database, "UPDATE jobs SET samples = ?2, begun_again = ?3 WHERE number = ?1");
    update.bind(1, job.number).bind(2, count).bind(3, job.begun_again_sequence).run();
  }
  database.execute(
      "DROP TRIGGER note_state;"
      "DELETE FROM events WHERE kind = 2;"
      "ALTER TABLE events DROP COLUMN kind;"
      "CREATE TRIGGER note_state AFTER INSERT ON events BEGIN"
      "  INSERT INTO changes (kind, resource, sequence) VALUES (1, new.job, new.sequence);"
      "END;"
      "PRAGMA user_version = 7;");
}

}  // namespace cellcrush::store
