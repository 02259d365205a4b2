#include "faults/filled_journal.h"

#include "store/data_folder.h"
#include "store/journal.h"

namespace cellcrush::testing {

void fill_journal(const std::filesystem::path& data_folder, std::int64_t count, const v1::Case& submitted) {
  const store::DataFolder folder(data_folder);
  {
    store::Journal journal(folder.journal(), [](std::int64_t) {});
    v1::Job job;
    *job.mutable_case_() = submitted;
    journal.create_job(job, "", "");
  }
  // Copies of the first one: ten thousand calls of create_job would take as many waits for the disk.
  store::Database database(folder.journal());
  store::Transaction transaction(database);
  store::Statement(database,
                   "WITH RECURSIVE numbers(n) AS (SELECT 2 UNION ALL SELECT n + 1 FROM numbers WHERE n < ?1) "
                   "INSERT INTO jobs (state, job, submitted_case, last_sequence, owner, title, bytes) "
                   "SELECT state, job, submitted_case, last_sequence, owner, title, bytes FROM jobs, numbers WHERE "
                   "number = 1 AND n <= ?1")
      .bind(1, count)
      .run();
  database.execute("INSERT INTO events (job, sequence, payload) SELECT number, 1, job FROM jobs WHERE number > 1");
  transaction.commit();
}

}  // namespace cellcrush::testing
