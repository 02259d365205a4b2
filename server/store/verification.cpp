#include "store/verification.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "error.h"
#include "store/backup_manifest.h"
#include "store/journal_check.h"
#include "store/resource_name.h"
#include "store/result_seal.h"
#include "store/sqlite.h"

namespace cellcrush::store {
namespace {

std::string result_path(std::int64_t job) { return name_of(job) + "/result.h5"; }

BackupManifest manifest_in(const std::filesystem::path& folder) {
  std::ifstream file(folder / kManifestName, std::ios::binary);
  return parse_manifest({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
}

// Checks that every file of the manifest exists with its bytes.
void check_files(const std::filesystem::path& folder, const BackupManifest& manifest, Verification& out) {
  for (const auto& wanted : manifest.files) {
    std::string problem;
    try {
      const auto found = digest_of(folder / wanted.path);
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
  try {
    if (read_seal(folder / result_path(job)) != Seal::broken) return "";
    return result_path(job) + " is damaged: its contents do not match its checksum.";
  } catch (const ServiceError& error) {
    return error.what();
  }
}

bool has_history(const std::filesystem::path& folder, const SampleRange& last) {
  try {
    return !SampleReader(folder).read(last, {}).is_cut;
  } catch (const ServiceError&) {
    return false;
  }
}

bool has_job(Database& journal, std::int64_t job) {
  return Statement(journal, "SELECT 1 FROM jobs WHERE number = ?1").bind(1, job).step();
}

void check_results(const std::filesystem::path& folder, Database& journal, const JournalFindings& found,
                   const std::set<std::string>& lost, Verification& out) {
  for (const std::int64_t job : found.with_result) {
    if (lost.contains(name_of(job))) continue;
    const std::string problem = problem_of_result(folder, job);
    if (problem.empty()) {
      ++out.results;
    } else if (has_job(journal, job)) {
      // Otherwise the daemon has deleted it meanwhile.
      out.problems.push_back(problem + " Restore a backup, or delete " + name_of(job) + " and submit its case again.");
    }
  }
}

void check_histories(const std::filesystem::path& folder, Database& journal, const JournalFindings& found,
                     const std::set<std::string>& lost, Verification& out) {
  for (const SampleRange& last : found.with_history) {
    const std::string name = name_of(last.job);
    if (!lost.contains(name) && !has_history(folder, last) && has_job(journal, last.job))
      out.problems.push_back(name + "/history is missing or damaged. Restore a backup, or delete " + name + ".");
  }
}

void note_strangers(const std::filesystem::path& folder, Database& journal, Verification& out) {
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder / "jobs", error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = "jobs/" + entry->path().filename().string();
    const auto job = number_of(name);
    if (!job || !has_job(journal, *job))
      out.notes.push_back(name + " belongs to no job of the journal; the daemon moves it aside at its next start.");
  }
}

}  // namespace

Verification verify_folder(const std::filesystem::path& folder) {
  Verification out;
  const auto path = folder / "journal.sqlite";
  std::error_code none;
  out.is_backup = std::filesystem::exists(folder / kManifestName, none);
  if (!out.is_backup && !std::filesystem::exists(path, none)) {
    throw ServiceError(ServiceError::Kind::not_found,
                       folder.string() + " is neither a backup nor a data folder: it has no " +
                           std::string(kManifestName) +
                           " and no journal.sqlite. If it is an interrupted backup, make a new one.");
  }
  std::set<std::string> lost;
  if (out.is_backup) {
    const auto manifest = manifest_in(folder);
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
    auto found = check_journal(journal);
    out.jobs = found.jobs;
    out.sweeps = found.sweeps;
    out.problems = std::move(found.problems);
    check_results(folder, journal, found, lost, out);
    check_histories(folder, journal, found, lost, out);
    if (!out.is_backup) note_strangers(folder, journal, out);
  } catch (const ServiceError& error) {
    if (error.kind() != ServiceError::Kind::data_loss) throw;
    out.problems.emplace_back(error.what());
  }
  return out;
}

}  // namespace cellcrush::store
