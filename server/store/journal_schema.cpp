#include "store/journal_schema.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <algorithm>
#include <system_error>
#include <utility>
#include <vector>

#include "error.h"
#include "store/contents.h"
#include "store/durable_file.h"
#include "store/job_folder.h"
#include "store/job_state.h"
#include "store/report_log.h"
#include "store/resource_name.h"
#include "store/row_checksum.h"

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
  static_cast<void>(make_own_folder(folder.root()));
  static_cast<void>(remove_own(folder.history()));
  ReportLog log(folder.history());
  std::int64_t count = 0;
  Statement read(database, "SELECT payload, sequence FROM events WHERE job = ?1 AND kind = 2 ORDER BY sequence");
  read.bind(1, job.number);
  while (read.step()) {
    worker::Report report;
    if (!report.mutable_sample()->ParseFromString(read.bytes(0))) {
      spdlog::error("Event {} of {} cannot be read: the journal was damaged. The history continues without it.",
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
  return Statement(database, "SELECT COUNT(*) FROM events WHERE job = ?1 AND kind = 2").bind(1, job).number();
}

// Version 6 had the samples as events. Those of an ended job go to its `history`; those of other jobs are in their
// reports. A repetition begins again.
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

constexpr std::int64_t kVersion = 9;

// As version 7 had them; those of a new journal are then sealed too.
constexpr const char* kTables = R"sql(
CREATE TABLE jobs (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  state INTEGER NOT NULL,
  job BLOB NOT NULL,
  submitted_case BLOB NOT NULL,
  request_id TEXT,
  request_hash TEXT,
  last_sequence INTEGER NOT NULL,
  priority INTEGER NOT NULL DEFAULT 0,
  submission INTEGER,
  element_steps INTEGER NOT NULL DEFAULT 0,
  owner TEXT NOT NULL DEFAULT '',
  title TEXT NOT NULL DEFAULT '',
  ended_at INTEGER,
  bytes INTEGER NOT NULL DEFAULT 0,
  measured INTEGER NOT NULL DEFAULT 0,
  executor TEXT NOT NULL DEFAULT '',
  samples INTEGER NOT NULL DEFAULT 0,
  begun_again INTEGER NOT NULL DEFAULT 0
) STRICT;
CREATE TABLE events (
  job INTEGER NOT NULL REFERENCES jobs(number),
  sequence INTEGER NOT NULL,
  payload BLOB NOT NULL,
  PRIMARY KEY (job, sequence)
) STRICT, WITHOUT ROWID;
CREATE TABLE meshes (
  job INTEGER PRIMARY KEY REFERENCES jobs(number),
  mesh BLOB NOT NULL
) STRICT;
CREATE TABLE sweeps (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  sweep BLOB NOT NULL,
  max_parallel INTEGER NOT NULL,
  request_id TEXT,
  request_hash TEXT,
  max_failures INTEGER NOT NULL DEFAULT 0,
  owner TEXT NOT NULL DEFAULT '',
  deleting INTEGER NOT NULL DEFAULT 0
) STRICT;
CREATE TABLE sweep_jobs (
  sweep INTEGER NOT NULL REFERENCES sweeps(number),
  position INTEGER NOT NULL,
  job INTEGER NOT NULL REFERENCES jobs(number),
  point BLOB NOT NULL,
  stopped INTEGER NOT NULL DEFAULT 0,
  PRIMARY KEY (sweep, position)
) STRICT, WITHOUT ROWID;
CREATE TABLE deleted_jobs (
  number INTEGER PRIMARY KEY
) STRICT;
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
CREATE TABLE changes (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  kind INTEGER NOT NULL,
  resource INTEGER NOT NULL,
  sequence INTEGER NOT NULL
) STRICT;
)sql";

constexpr const char* kIndexes = R"sql(
CREATE INDEX jobs_by_state ON jobs(state);
CREATE UNIQUE INDEX sweep_jobs_by_job ON sweep_jobs(job);
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

// They keep the list of changes, so that no writer can forget it. The numbers are those of ChangeKind.
constexpr const char* kTriggers = R"sql(
CREATE TRIGGER note_state AFTER INSERT ON events BEGIN
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
)sql";

// 0 without tables.
std::int64_t journal_version(Database& database) { return Statement(database, "PRAGMA user_version").number(); }

// A killed daemon has recorded too little time, and a damaged row says nothing. The latest end of a job then shows how
// far the clock was.
std::int64_t read_service_clock(Database& database) {
  const std::int64_t latest_end =
      Statement(database,
                "SELECT ended_at FROM jobs WHERE ended_at IS NOT NULL AND checksum = expected_checksum "
                "ORDER BY ended_at DESC LIMIT 1")
          .number();
  Statement read(database, "SELECT seconds FROM service_clock WHERE id = 1 AND checksum = expected_checksum");
  if (read.step()) return std::max(read.integer(0), latest_end);
  Statement(database, "INSERT OR REPLACE INTO service_clock (id, seconds) VALUES (1, ?1)").bind(1, latest_end).run();
  return latest_end;
}

}  // namespace

std::string read_fact(Database& database, const std::string& name) {
  Statement read(database, "SELECT value FROM facts WHERE name = ?1 AND checksum = expected_checksum");
  return read.bind_text(1, name).step() ? read.bytes(0) : "";
}

void write_fact(Database& database, const std::string& name, const std::string& value) {
  Statement write(database, "INSERT OR REPLACE INTO facts (name, value) VALUES (?1, ?2)");
  write.bind_text(1, name).bind_text(2, value).run();
}

Epoch read_epoch(Database& database) { return {read_fact(database, "epoch"), read_fact(database, "restored")}; }

Epoch epoch_for_callers(Epoch epoch, const std::filesystem::path& journal) {
  // Both stay when the folder is renamed or the machine starts again. A file system may know no time of birth: 0.
  struct statx file {};
  statx(AT_FDCWD, journal.c_str(), 0, STATX_INO | STATX_BTIME, &file);
  epoch.id += fmt::format("{:08x}{:08x}", file.stx_ino & 0xffffffffU,
                          static_cast<std::uint32_t>(file.stx_btime.tv_sec) ^ file.stx_btime.tv_nsec);
  return epoch;
}

void begin_epoch(Database& database, const std::string& restored) {
  write_fact(database, "epoch", random_name());
  if (!restored.empty()) write_fact(database, "restored", restored);
}

void require_known_version(Database& database) {
  const std::int64_t version = journal_version(database);
  if (version == kVersion) return;
  throw ServiceError(
      ServiceError::Kind::failed_precondition,
      "The journal has version " + std::to_string(version) + "; this daemon supports version " +
          std::to_string(kVersion) + ". " +
          (version >= 6 && version < kVersion ? "cellcrushd upgrades the folder when it starts on it."
                                              : std::string("Run ") + (version > kVersion ? "a newer" : "an earlier") +
                                                    " cellcrushd, or use another data folder."));
}

std::int64_t prepare_journal(Database& database, const std::filesystem::path& data_folder) {
  Transaction transaction(database);
  if (journal_version(database) == 0) {
    for (const char* sql : {kTables, kIndexes, kTriggers}) database.execute(sql);
    database.execute("PRAGMA user_version = 7");
  }
  if (journal_version(database) == 6) upgrade_from_version_6(database, data_folder);
  if (journal_version(database) == 7) {
    seal_tables(database);
    database.execute("PRAGMA user_version = 8");
  }
  // Rows of version 8 keep their large parts to themselves.
  if (journal_version(database) == 8) {
    add_contents(database);
    database.execute("PRAGMA user_version = 9");
  }
  require_known_version(database);
  if (read_epoch(database).id.empty()) {
    if (Statement(database, "SELECT 1 FROM facts WHERE name = 'epoch'").step())
      spdlog::error("The journal's epoch was damaged. A new one begins: watchers must watch again from the beginning.");
    begin_epoch(database, "");
  }
  const std::int64_t seconds = read_service_clock(database);
  transaction.commit();
  return seconds;
}

}  // namespace cellcrush::store
