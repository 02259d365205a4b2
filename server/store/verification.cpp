#include "store/verification.h"

#include <algorithm>
#include <set>

#include "cellcrush/v1/event.pb.h"
#include "cellcrush/v1/sweep.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"
#include "error.h"
#include "store/backup_manifest.h"
#include "store/change_count.h"
#include "store/contents.h"
#include "store/job_folder.h"
#include "store/job_rows.h"
#include "store/job_state.h"
#include "store/journal_mending.h"
#include "store/journal_schema.h"
#include "store/report_log.h"
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
  std::vector<SampleRange> unended;       // the last samples of jobs that have not ended, if they have some
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
    for (const auto check : {&JournalCheck::check_pages, &JournalCheck::check_references}) attempt(check);
    has_whole_pages_ = found_.problems.empty();
    for (const auto check : {&JournalCheck::check_jobs, &JournalCheck::check_events, &JournalCheck::check_meshes,
                             &JournalCheck::check_sweeps, &JournalCheck::check_others})
      attempt(check);
    database_.execute("ROLLBACK");
    return std::move(found_);
  }

  /// Of the last run: whether only rows are damaged.
  [[nodiscard]] bool has_whole_pages() const { return has_whole_pages_; }

 private:
  // A damaged page stops one check and not the others.
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
                   "(SELECT MAX(sequence) FROM events WHERE events.job = jobs.number), "
                   "checksum = expected_checksum, case_checksum = row_checksum(submitted_case), "
                   "states = (SELECT COUNT(*) FROM events WHERE events.job = jobs.number) FROM jobs ORDER BY number");
    ContentReader contents(database_);
    while (read.step()) {
      ++found_.jobs;
      const std::int64_t number = read.integer(0);
      v1::Job job;
      v1::Case submitted;
      if (read.integer(9) == 0 || !contents.read_case(read.bytes(3), submitted)) add_row("The case", number);
      if (read.integer(8) == 0 || !read_job_bytes(read.bytes(2), read.integer(1), job)) {
        add_row("The entry", number);
        continue;
      }
      if (is_terminal(job.state()) && job.has_summary()) {
        found_.with_result.push_back(number);
      } else if (is_terminal(job.state()) && read.integer(5) > 0) {
        found_.with_history.push_back({number, read.integer(6), read.integer(5) - 1, 1});
      } else if (!is_terminal(job.state())) {
        found_.unended.push_back(
            {number, read.integer(6), read.integer(5) - 1, std::min<std::int64_t>(read.integer(5), 1)});
      }
      // The newest events of a job that has not ended may be samples.
      if (read.integer(10) == 0 || read.integer(4) < read.integer(7) ||
          (is_terminal(job.state()) && read.integer(4) != read.integer(7)))
        add_row("An event", number);
    }
  }

  void check_events() {
    Statement read(database_, "SELECT job, sequence, payload, checksum = expected_checksum FROM events");
    while (read.step()) {
      if (read.integer(3) == 0 || !v1::Job().ParseFromString(read.bytes(2)))
        add_row("Event " + std::to_string(read.integer(1)), read.integer(0));
    }
  }

  void check_meshes() {
    Statement read(database_, "SELECT job, mesh, checksum = expected_checksum FROM meshes");
    while (read.step()) {
      v1::Mesh mesh;
      if (read.integer(2) == 0 || !ContentReader(database_).read_mesh(read.bytes(1), mesh))
        add_row("The mesh", read.integer(0));
    }
  }

  void check_sweeps() {
    Statement sweeps(database_, "SELECT number, sweep, checksum = expected_checksum FROM sweeps");
    while (sweeps.step()) {
      ++found_.sweeps;
      v1::Sweep sweep;
      if (sweeps.integer(2) == 0 || !ContentReader(database_).read_sweep(sweeps.bytes(1), sweep))
        add(unreadable_sweep(sweeps.integer(0)).what());
    }
    Statement points(database_, "SELECT job, point, checksum = expected_checksum FROM sweep_jobs");
    while (points.step()) {
      if (points.integer(2) == 0 || !v1::SweepTable::Row().ParseFromString(points.bytes(1)))
        add_row("The sweep's point", points.integer(0));
    }
  }

  void check_others() {
    for (const std::string table : {"changes", "service_clock", "facts"}) {
      if (Statement(database_, "SELECT 1 FROM " + table + " WHERE checksum <> expected_checksum").step())
        add("The table " + table + " of the journal is damaged. Restart the daemon to repair it.");
    }
  }

  Database& database_;
  JournalFindings found_;
  bool has_whole_pages_ = true;
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

// Nothing if all reports so far are whole, up to the last sample that the journal counts. A backup has no reports.
std::string problem_of_reports(const std::filesystem::path& folder, const SampleRange& last) {
  const std::string name = name_of(last.job);
  const auto path = JobFolder(folder / name).reports();
  std::error_code none;
  try {
    if (!std::filesystem::exists(path, none)) return "";
    ReportLogReader reader(path);
    worker::Report report;
    auto read = ReportLogReader::Read::message;
    while (read == ReportLogReader::Read::message) read = reader.read(report);
    // A damaged length looks like the end.
    if (read == ReportLogReader::Read::end && !SampleReader(folder).read(last, {}).is_cut) return "";
  } catch (const ServiceError& error) {
    // The job has ended meanwhile.
    return std::filesystem::exists(path, none) ? error.what() : "";
  }
  return name +
         "/reports is damaged: a report does not match its checksum. The samples before it are kept; to compute " +
         "the others, submit the case of " + name + " again.";
}

// Whether the job has not begun again, with other reports, since the journal was checked.
bool has_not_begun_again(Database& journal, const SampleRange& last) {
  Statement read(journal, "SELECT 1 FROM jobs WHERE number = ?1 AND begun_again = ?2");
  return read.bind(1, last.job).bind(2, last.run).step();
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
  for (const SampleRange& last : found.unended) {
    const std::string problem = problem_of_reports(folder, last);
    if (has_not_begun_again(journal, last)) note(last.job, problem);
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

// What a backup says itself it lacks is no problem of the backup.
void note_problems(std::vector<std::string> problems, const std::set<std::string>& known, Verification& out) {
  std::erase_if(problems, [&known](const std::string& problem) { return known.contains(problem); });
  out.problems.insert(out.problems.end(), problems.begin(), problems.end());
}

}  // namespace

std::vector<std::string> problems_of_rows(Database& journal) {
  JournalCheck check(journal);
  auto problems = check.run().problems;
  if (check.has_whole_pages()) return problems;
  throw ServiceError(ServiceError::Kind::data_loss, problems.front());
}

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
  std::set<std::string> known;
  if (out.is_backup) {
    const auto manifest = read_manifest(folder);
    out.created = manifest.created;
    check_files(folder, manifest, out);
    for (const auto& sentence : manifest.lost) {
      lost.insert(sentence.substr(0, sentence.find(' ')));
      known.insert(sentence);
      out.notes.push_back(sentence);
    }
    if (!out.problems.empty()) return out;
  }
  try {
    // Before the journal, which a daemon may be writing.
    const ChangeCount changes(folder);
    Database journal(path, Database::Access::read_only);
    auto found = JournalCheck(journal).run();
    out.jobs = found.jobs;
    out.sweeps = found.sweeps;
    if (const std::int64_t missing = changes.lost(journal); missing > 0) {
      out.problems.push_back("The journal lacks its last " + std::to_string(missing) +
                             " changes: its WAL was damaged, or an older copy is in its place. Restore a backup, or "
                             "start the daemon to continue without them.");
    }
    note_problems(std::move(found.problems), known, out);
    check_job_files(folder, journal, found, lost, out);
    if (!out.is_backup) note_strangers(folder, journal, out);
  } catch (const ServiceError& error) {
    if (error.kind() != ServiceError::Kind::data_loss) throw;
    out.problems.emplace_back(error.what());
  }
  return out;
}

}  // namespace cellcrush::store
