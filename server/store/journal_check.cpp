#include "store/journal_check.h"

#include "cellcrush/v1/event.pb.h"
#include "cellcrush/v1/sweep.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"
#include "error.h"
#include "store/job_state.h"
#include "store/journal_mending.h"
#include "store/journal_schema.h"
#include "store/resource_name.h"

namespace cellcrush::store {
namespace {

constexpr std::size_t kMostProblems = 1000;

class JournalCheck {
 public:
  explicit JournalCheck(Database& database) : database_(database) {}

  JournalFindings run() {
    require_known_version(database_);
    database_.execute("BEGIN");
    // A damaged page stops one check and not the others.
    for (const auto check : {&JournalCheck::check_pages, &JournalCheck::check_references, &JournalCheck::check_jobs,
                             &JournalCheck::check_events, &JournalCheck::check_meshes, &JournalCheck::check_sweeps})
      attempt(check);
    database_.execute("ROLLBACK");
    return std::move(found_);
  }

 private:
  void attempt(void (JournalCheck::*check)()) {
    try {
      (this->*check)();
    } catch (const ServiceError& error) {
      if (error.kind() != ServiceError::Kind::data_loss) throw;
      add(error.what());
    }
  }

  void add(std::string problem) {
    if (found_.problems.size() < kMostProblems) found_.problems.push_back(std::move(problem));
  }

  void add_row(const std::string& what, std::int64_t job) {
    add(what + " of " + name_of(job) +
        " cannot be read. Restore a backup, or, once the job has ended, delete it with `cellcrush delete " +
        name_of(job) + "`.");
  }

  void check_pages() {
    Statement read(database_, "PRAGMA integrity_check");
    while (read.step()) {
      if (read.bytes(0) != "ok") add("journal.sqlite is damaged: " + read.bytes(0) + ". Restore a backup.");
    }
  }

  void check_references() {
    Statement read(database_, "PRAGMA foreign_key_check");
    while (read.step()) {
      add("A row of " + read.bytes(0) + " refers to a missing row of " + read.bytes(2) + ". Restore a backup.");
    }
  }

  void check_jobs() {
    Statement read(database_,
                   "SELECT number, state, job, submitted_case, last_sequence, samples, begun_again, "
                   "(SELECT MAX(sequence) FROM events WHERE events.job = jobs.number) FROM jobs ORDER BY number");
    while (read.step()) {
      ++found_.jobs;
      const std::int64_t number = read.integer(0);
      v1::Job job;
      if (!read_job_bytes(read.bytes(2), read.integer(1), job)) {
        add_row("The entry", number);
      } else if (is_terminal(job.state()) && job.has_summary()) {
        found_.with_result.push_back(number);
      } else if (is_terminal(job.state()) && read.integer(5) > 0) {
        found_.with_history.push_back({number, read.integer(6), read.integer(5) - 1, 1});
      }
      if (!v1::Case().ParseFromString(read.bytes(3))) add_row("The case", number);
      // The newest events of a job that has not ended may be samples.
      if (read.integer(4) < read.integer(7) || (is_terminal(job.state()) && read.integer(4) != read.integer(7)))
        add_row("The newest event", number);
    }
  }

  void check_events() {
    Statement read(database_, "SELECT job, sequence, payload FROM events");
    while (read.step()) {
      if (!v1::Job().ParseFromString(read.bytes(2)))
        add_row("Event " + std::to_string(read.integer(1)), read.integer(0));
    }
  }

  void check_meshes() {
    Statement read(database_, "SELECT job, mesh FROM meshes");
    while (read.step()) {
      if (!v1::Mesh().ParseFromString(read.bytes(1))) add_row("The mesh", read.integer(0));
    }
  }

  void check_sweeps() {
    Statement sweeps(database_, "SELECT number, sweep FROM sweeps");
    while (sweeps.step()) {
      ++found_.sweeps;
      if (!v1::Sweep().ParseFromString(sweeps.bytes(1)))
        add(sweep_name_of(sweeps.integer(0)) + " cannot be read. Restore a backup.");
    }
    Statement points(database_, "SELECT job, point FROM sweep_jobs");
    while (points.step()) {
      if (!v1::SweepTable::Row().ParseFromString(points.bytes(1))) add_row("The sweep's point", points.integer(0));
    }
  }

  Database& database_;
  JournalFindings found_;
};

}  // namespace

JournalFindings check_journal(Database& database) { return JournalCheck(database).run(); }

}  // namespace cellcrush::store
