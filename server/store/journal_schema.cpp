#include "store/journal_schema.h"

#include "error.h"
#include "store/epoch.h"
#include "store/search_columns.h"

namespace cellcrush::store {
namespace {

constexpr std::int64_t kVersion = 6;

constexpr const char* kJobTables = R"sql(
CREATE TABLE jobs (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  state INTEGER NOT NULL,
  job BLOB NOT NULL,
  submitted_case BLOB NOT NULL,
  request_id TEXT,
  request_hash TEXT,
  last_sequence INTEGER NOT NULL
) STRICT;
CREATE UNIQUE INDEX jobs_by_request ON jobs(request_id) WHERE request_id IS NOT NULL;
CREATE INDEX jobs_by_state ON jobs(state);
CREATE TABLE events (
  job INTEGER NOT NULL REFERENCES jobs(number),
  sequence INTEGER NOT NULL,
  kind INTEGER NOT NULL,
  payload BLOB NOT NULL,
  PRIMARY KEY (job, sequence)
) STRICT, WITHOUT ROWID;
CREATE TABLE meshes (
  job INTEGER PRIMARY KEY REFERENCES jobs(number),
  mesh BLOB NOT NULL
) STRICT;
PRAGMA user_version = 1;
)sql";

// From version 1 to 2.
constexpr const char* kSweepTables = R"sql(
CREATE TABLE sweeps (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  sweep BLOB NOT NULL,
  max_parallel INTEGER NOT NULL,
  request_id TEXT,
  request_hash TEXT
) STRICT;
CREATE UNIQUE INDEX sweeps_by_request ON sweeps(request_id) WHERE request_id IS NOT NULL;
CREATE TABLE sweep_jobs (
  sweep INTEGER NOT NULL REFERENCES sweeps(number),
  position INTEGER NOT NULL,
  job INTEGER NOT NULL REFERENCES jobs(number),
  point BLOB NOT NULL,
  PRIMARY KEY (sweep, position)
) STRICT, WITHOUT ROWID;
CREATE UNIQUE INDEX sweep_jobs_by_job ON sweep_jobs(job);
CREATE TABLE deleted_jobs (
  number INTEGER PRIMARY KEY
) STRICT;
PRAGMA user_version = 2;
)sql";

// From version 2 to 3. Each column has the right value for existing rows: jobs of a sweep were submitted with its
// first.
constexpr const char* kQueueColumns = R"sql(
ALTER TABLE jobs ADD COLUMN priority INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN submission INTEGER;
ALTER TABLE jobs ADD COLUMN element_steps INTEGER NOT NULL DEFAULT 0;
ALTER TABLE sweeps ADD COLUMN max_failures INTEGER NOT NULL DEFAULT 0;
ALTER TABLE sweep_jobs ADD COLUMN stopped INTEGER NOT NULL DEFAULT 0;
UPDATE jobs SET submission = (
  SELECT first.job FROM sweep_jobs AS own JOIN sweep_jobs AS first ON first.sweep = own.sweep
  WHERE own.job = jobs.number ORDER BY first.position LIMIT 1);
PRAGMA user_version = 3;
)sql";

// From version 3 to 4. fill_in_search_columns fills the columns whose values are inside the messages.
constexpr const char* kSearchColumns = R"sql(
ALTER TABLE jobs ADD COLUMN owner TEXT NOT NULL DEFAULT '';
ALTER TABLE jobs ADD COLUMN title TEXT NOT NULL DEFAULT '';
ALTER TABLE jobs ADD COLUMN ended_at INTEGER;
ALTER TABLE jobs ADD COLUMN bytes INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN measured INTEGER NOT NULL DEFAULT 0;
ALTER TABLE sweeps ADD COLUMN owner TEXT NOT NULL DEFAULT '';
ALTER TABLE sweeps ADD COLUMN deleting INTEGER NOT NULL DEFAULT 0;
CREATE TABLE job_labels (
  key TEXT NOT NULL,
  value TEXT NOT NULL,
  job INTEGER NOT NULL REFERENCES jobs(number),
  PRIMARY KEY (key, value, job)
) STRICT, WITHOUT ROWID;
CREATE TABLE service_clock (
  id INTEGER PRIMARY KEY CHECK (id = 1),
  seconds INTEGER NOT NULL
) STRICT;
INSERT INTO service_clock (id, seconds) VALUES (1, 0);
CREATE TABLE facts (
  name TEXT PRIMARY KEY,
  value TEXT NOT NULL
) STRICT, WITHOUT ROWID;
PRAGMA user_version = 4;
)sql";

constexpr const char* kSearchIndexes = R"sql(
DROP INDEX jobs_by_request;
DROP INDEX sweeps_by_request;
CREATE UNIQUE INDEX jobs_by_request ON jobs(request_id, owner) WHERE request_id IS NOT NULL;
CREATE UNIQUE INDEX sweeps_by_request ON sweeps(request_id, owner) WHERE request_id IS NOT NULL;
CREATE INDEX jobs_by_owner ON jobs(owner);
CREATE INDEX jobs_by_owner_bytes ON jobs(owner, bytes);
CREATE INDEX jobs_by_title ON jobs(number, title);
CREATE INDEX jobs_by_end ON jobs(ended_at, number, bytes) WHERE ended_at IS NOT NULL;
CREATE INDEX jobs_to_measure ON jobs(number) WHERE measured = 0 AND ended_at IS NOT NULL;
CREATE INDEX job_labels_by_job ON job_labels(job);
CREATE INDEX sweeps_in_deletion ON sweeps(number) WHERE deleting = 1;
)sql";

// From version 4 to 5. Triggers keep the list, so that no writer can forget it. The numbers are those of ChangeKind.
constexpr const char* kChanges = R"sql(
CREATE TABLE changes (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  kind INTEGER NOT NULL,
  resource INTEGER NOT NULL,
  sequence INTEGER NOT NULL
) STRICT;
CREATE TRIGGER note_state AFTER INSERT ON events WHEN new.kind = 1 BEGIN
  INSERT INTO changes (kind, resource, sequence) VALUES (1, new.job, new.sequence);
END;
CREATE TRIGGER note_deleted_job AFTER DELETE ON jobs BEGIN
  INSERT INTO changes (kind, resource, sequence) VALUES (2, old.number, 0);
END;
CREATE TRIGGER note_sweep AFTER INSERT ON sweeps BEGIN
  INSERT INTO changes (kind, resource, sequence) VALUES (3, new.number, 0);
END;
CREATE TRIGGER note_retry AFTER UPDATE OF job ON sweep_jobs BEGIN
  INSERT INTO changes (kind, resource, sequence) VALUES (3, new.sweep, 0);
END;
CREATE TRIGGER note_deleted_sweep AFTER UPDATE OF deleting ON sweeps WHEN new.deleting = 1 AND old.deleting = 0 BEGIN
  INSERT INTO changes (kind, resource, sequence) VALUES (4, new.number, 0);
END;
CREATE TRIGGER forget_changes AFTER INSERT ON changes WHEN new.number % 1000 = 0 BEGIN
  DELETE FROM changes WHERE number <= new.number - 100000;
END;
PRAGMA user_version = 5;
)sql";

// From version 5 to 6.
constexpr const char* kExecutor = R"sql(
ALTER TABLE jobs ADD COLUMN executor TEXT NOT NULL DEFAULT '';
PRAGMA user_version = 6;
)sql";

// A killed daemon has recorded too little time. The latest end of a job then shows how far the clock was.
std::int64_t read_service_clock(Database& database) {
  Statement read(database,
                 "SELECT MAX(seconds, COALESCE((SELECT MAX(ended_at) FROM jobs WHERE ended_at IS NOT NULL), 0)) "
                 "FROM service_clock");
  return read.step() ? read.integer(0) : 0;
}

}  // namespace

std::int64_t journal_version(Database& database) {
  Statement read(database, "PRAGMA user_version");
  return read.step() ? read.integer(0) : 0;
}

void require_known_version(Database& database) {
  const std::int64_t version = journal_version(database);
  if (version <= kVersion) return;
  throw ServiceError(ServiceError::Kind::failed_precondition,
                     "The journal has version " + std::to_string(version) + "; this daemon supports versions up to " +
                         std::to_string(kVersion) + ". Run a newer cellcrushd, or use another data folder.");
}

std::int64_t prepare_journal(Database& database) {
  Transaction transaction(database);
  require_known_version(database);
  const std::int64_t version = journal_version(database);
  if (version < 1) database.execute(kJobTables);
  if (version < kVersionWithSweeps) database.execute(kSweepTables);
  if (version < 3) database.execute(kQueueColumns);
  if (version < 4) {
    database.execute(kSearchColumns);
    fill_in_search_columns(database);
    database.execute(kSearchIndexes);
  }
  if (version < 5) database.execute(kChanges);
  if (version < 6) database.execute(kExecutor);
  ensure_epoch(database);
  transaction.commit();
  return read_service_clock(database);
}

}  // namespace cellcrush::store
