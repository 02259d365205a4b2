#include "store/verification.h"

#include <algorithm>
#include <set>

#include "cellcrush/v1/event.pb.h"
#include "cellcrush/v1/sweep.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"
#include "error.h"
#include "store/backup_manifest.h"
#include "store/job_rows.h"
#include "store/job_state.h"
#include "store/journal_mending.h"
#include "store/journal_schema.h"
#include "store/resource_name.h"
#include "store/result_seal.h"
#include "store/sample_reader.h"
#include "store/sqlite.h"

namespace cellcrush::store {
namespace {

constexpr std::size_t kMostProblems = 1000;

// Result of checking every row of a journal.
struct JournalFindings {
  std::vector<std::string> problems;
  std::vector<std::int64_t> with_result;  // ended jobs with a summary, and therefore a result.h5, ascending
  std::vector<SampleRange> with_history;  // the last samples of other ended jobs that have some
  std::int64_t jobs = 0;
  std::int64_t sweeps = 0;
};

// Checks a journal against the daemon's assumptions: SQLite's own checks of pages, indexes and references, then every
// row of every table. Sees one moment, so that it may run beside a daemon.
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

// Checks that every file of the manifest exists with its bytes.
void check_files(const std::filesystem::path& folder, const BackupManifest& manifest, Verification& out) {
  for (const auto& wanted : manifest.files) {
    std::string problem;
    try {
      const auto found = digest_of(folder / wanted.path, {}, wanted.size);
      if (found.size != wanted.size || found.sha256 != wanted.sha256)
        problem = wanted.path + " has changed since it was backed up.";
    } catch (const ServiceError& error) {
      problem = error.what();
    }
    if (!problem.empty()) out.problems.push_back(problem + " Use another backup.");
  }
}

// Nothing if the job's result is whole.
std::string problem_of_result(const std::filesystem::path& folder, std::int64_t job) {
  const std::string remedy = " Restore a backup, or delete " + name_of(job) + " and submit its case again.";
  const std::string path = name_of(job) + "/result.h5";
  try {
    if (read_seal(folder / path) != Seal::broken) return "";
    return path + " is damaged: its contents do not match its checksum." + remedy;
  } catch (const ServiceError& error) {
    return error.what() + remedy;
  }
}

// Nothing if the last sample is there.
std::string problem_of_history(const std::filesystem::path& folder, const SampleRange& last) {
  try {
    if (!SampleReader(folder).read(last, {}).is_cut) return "";
  } catch (const ServiceError&) {
  }
  const std::string name = name_of(last.job);
  return name + "/history is missing or damaged. Restore a backup, or delete " + name + ".";
}

void check_job_files(const std::filesystem::path& folder, Database& journal, const JournalFindings& found,
                     const std::set<std::string>& lost, Verification& out) {
  // Whether there is none. The daemon may have deleted the job meanwhile.
  const auto note = [&](std::int64_t job, const std::string& problem) {
    if (!problem.empty() && has_job(journal, job)) out.problems.push_back(problem);
    return problem.empty();
  };
  for (const std::int64_t job : found.with_result) {
    if (!lost.contains(name_of(job)) && note(job, problem_of_result(folder, job))) ++out.results;
  }
  for (const SampleRange& last : found.with_history) {
    if (!lost.contains(name_of(last.job))) note(last.job, problem_of_history(folder, last));
  }
}

void note_strangers(const std::filesystem::path& folder, Database& journal, Verification& out) {
  if (!find_own(folder / "jobs")) return;
  for (const auto& entry : names_in(folder / "jobs")) {
    const std::string name = "jobs/" + entry;
    const auto job = number_of(name);
    if (!job || !has_job(journal, *job))
      out.notes.push_back(name + " belongs to no job of the journal; the daemon moves it aside at its next start.");
  }
}

}  // namespace

Verification verify_folder(const std::filesystem::path& given) {
  Verification out;
  const auto folder = canonical_of(given);
  const auto path = folder / "journal.sqlite";
  out.is_backup = find_own(folder / kManifestName).has_value();
  if (!out.is_backup && !find_own(path)) {
    throw ServiceError(ServiceError::Kind::not_found,
                       given.string() + " is neither a backup nor a data folder: it has no " +
                           std::string(kManifestName) +
                           " and no journal.sqlite. If it is an interrupted backup, make a new one.");
  }
  std::set<std::string> lost;
  if (out.is_backup) {
    const auto manifest = read_manifest(folder);
    out.created = manifest.created;
    check_files(folder, manifest, out);
    for (const auto& sentence : manifest.lost) {
      lost.insert(sentence.substr(0, sentence.find(' ')));
      out.notes.push_back(sentence);
    }
    if (!out.problems.empty()) return out;
  }
  try {
    Database journal(path, Database::Access::read_only);
    auto found = JournalCheck(journal).run();
    out.jobs = found.jobs;
    out.sweeps = found.sweeps;
    out.problems = std::move(found.problems);
    check_job_files(folder, journal, found, lost, out);
    if (!out.is_backup) note_strangers(folder, journal, out);
  } catch (const ServiceError& error) {
    if (error.kind() != ServiceError::Kind::data_loss) throw;
    out.problems.emplace_back(error.what());
  }
  return out;
}

}  // namespace cellcrush::store
