#include "store/job_removal.h"

namespace cellcrush::store {

void remove_rows(Database& database, std::int64_t job) {
  for (const char* sql : {"DELETE FROM events WHERE job = ?1", "DELETE FROM meshes WHERE job = ?1",
                          "DELETE FROM sweep_jobs WHERE job = ?1", "DELETE FROM job_labels WHERE job = ?1",
                          "DELETE FROM jobs WHERE number = ?1"})
    Statement(database, sql).bind(1, job).run();
}

}  // namespace cellcrush::store
