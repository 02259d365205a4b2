#include "store/journal.h"

#include <google/protobuf/util/time_util.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "clocks.h"
#include "error.h"
#include "store/durable_file.h"
#include "store/job_folder.h"
#include "store/job_rows.h"
#include "store/job_state.h"
#include "store/journal_mending.h"
#include "store/resource_name.h"

namespace cellcrush::store {
namespace {

constexpr std::chrono::milliseconds kBeforeNextTry{200};

void apply(const StateChange& change, v1::Job& job) {
  const auto now = google::protobuf::util::TimeUtil::GetCurrentTime();
  job.set_state(change.state);
  *job.mutable_state_time() = time_now();
  job.set_cause(change.cause);
  job.set_cause_message(change.message);
  job.set_remedy(change.remedy);
  job.set_worker_pid(change.worker_pid);
  if (change.state == v1::Job::RUNNING) {
    job.set_attempt(job.attempt() + 1);
    if (!job.has_start_time()) *job.mutable_start_time() = now;
  }
  if (is_terminal(change.state)) *job.mutable_end_time() = now;
  if (change.summary) *job.mutable_summary() = *change.summary;
}

}  // namespace

Journal::Journal(const std::filesystem::path& path, Durable on_durable, GroupCommit::Committed on_commit,
                 Clocks::Source uptime)
    : data_folder_(path.parent_path()),
      on_durable_(std::move(on_durable)),
      database_(path),
      clock_(prepare_journal(database_, data_folder_), std::move(uptime)),
      changes_(data_folder_),
      writes_(database_, [this, on_commit = std::move(on_commit)](double seconds) {
        changes_.note(database_);
        if (on_commit) on_commit(seconds);
      }) {
  note_lost_changes();
  mend_jobs(database_, data_folder_, clock_.seconds());
  prepare_giving_back(database_);
  // Each statement with a trigger keeps the pages that it changes, for its undoing, which is not worth a file; and a
  // large transaction, as of a sweep, keeps its pages until it commits (at most 16 MB).
  database_.execute("PRAGMA temp_store=MEMORY; PRAGMA cache_spill=4096;");
  epoch_ = read_epoch(database_);
  upkeep_.emplace(path, kUpkeepInterval);
  committer_ = std::thread([this] { commit_gathered_when_due(); });
}

void Journal::note_lost_changes() {
  lost_changes_ = changes_.lost(database_);
  if (lost_changes_ > 0) {
    spdlog::error(
        "The journal lacks its last {} changes: its WAL was damaged, or an older copy is in its place. Jobs are as "
        "they "
        "were before; later jobs are gone. Compare `cellcrush list` with a backup, and watch jobs from the beginning.",
        lost_changes_);
    // Their numbers will be used again.
    Transaction transaction(database_);
    begin_epoch(database_, "");
    transaction.commit();
  }
  changes_.note(database_);
}

Journal::~Journal() {
  {
    const MutexLock lock(gather_mutex_);
    stopping_ = true;
  }
  sooner_.notify_all();
  committer_.join();
  try {
    note_service_clock();
  } catch (const ServiceError& error) {
    spdlog::warn("The service clock cannot be saved: {} Jobs are kept longer by this daemon's running time.",
                 error.what());
  }
}

std::vector<std::int64_t> Journal::change_state(std::int64_t job, const StateChange& change) {
  std::vector<std::int64_t> stopped;
  const auto samples = durable_samples(job);
  writes_.run([&] {
    add_samples(samples);
    write_change(job, change);
    if (change.state == v1::Job::FAILED) stopped = stop_failing_sweep(job);
  });
  forget_gathered(is_terminal(change.state) ? Counts{{job, std::numeric_limits<std::int64_t>::max()}} : samples);
  on_durable_(job);
  for (const std::int64_t other : stopped) on_durable_(other);
  return stopped;
}

Journal::StoredState Journal::read_state(std::int64_t job) {
  Statement read(database_,
                 "SELECT job, state, last_sequence, checksum = expected_checksum FROM jobs WHERE number = ?1");
  if (!read.bind(1, job).step()) throw ServiceError(ServiceError::Kind::not_found, "There is no " + name_of(job) + ".");
  StoredState out;
  if (read.integer(3) == 0 || !read_job_bytes(read.bytes(0), read.integer(1), out.job)) throw unreadable_entry(job);
  out.last_sequence = read.integer(2);
  return out;
}

void Journal::begin_again(std::int64_t job, const std::string& why) {
  writes_.run([&] {
    auto [stored, last] = read_state(job);
    if (stored.state() != v1::Job::PENDING && stored.state() != v1::Job::RUNNING &&
        stored.state() != v1::Job::SUSPENDED) {
      throw ServiceError(ServiceError::Kind::failed_precondition,
                         name_of(job) + " is " + v1::Job::State_Name(stored.state()) + " and cannot be restarted.");
    }
    if (stored.state() == v1::Job::RUNNING) {
      stored.set_state(v1::Job::PENDING);
      *stored.mutable_state_time() = time_now();
    }
    stored.set_cause_message(why);
    stored.set_worker_pid(0);
    stored.set_begun_again_sequence(last + 1);
    add_state(database_, job, stored, last + 1);
    Statement update(database_, "UPDATE jobs SET samples = 0, begun_again = last_sequence WHERE number = ?1");
    update.bind(1, job).run();
    Statement(database_, "DELETE FROM meshes WHERE job = ?1").bind(1, job).run();
    // Those of a failed attempt are noted again with the next reports.
    const MutexLock lock(gather_mutex_);
    gathered_.erase(job);
  });
  on_durable_(job);
}

void Journal::write_change(std::int64_t job, const StateChange& change) {
  auto [stored, last] = read_state(job);
  if (!may_follow(stored.state(), change.state)) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       name_of(job) + " is " + v1::Job::State_Name(stored.state()) + " and cannot become " +
                           v1::Job::State_Name(change.state) + ".");
  }
  apply(change, stored);
  const auto ended_at = is_terminal(stored.state()) ? std::optional(clock_.seconds()) : std::nullopt;
  add_state(database_, job, stored, last + 1, ended_at);
}

void Journal::note_samples(std::int64_t job, std::int64_t count, std::chrono::milliseconds within) {
  const auto limit = std::chrono::steady_clock::now() + within;
  {
    const MutexLock lock(gather_mutex_);
    std::int64_t& gathered = gathered_[job];
    gathered = std::max(gathered, count);
    if (limit >= commit_at_) return;
    commit_at_ = limit;
  }
  sooner_.notify_all();
}

void Journal::set_mesh(std::int64_t job, const v1::Mesh& mesh) {
  writes_.run([&] { insert_mesh(database_, job, mesh); });
}

void Journal::commit_gathered_when_due() {
  bool failing = false;
  for (bool stop = false; !stop;) {
    {
      MutexLock lock(gather_mutex_);
      while (!stopping_ && std::chrono::steady_clock::now() < commit_at_) {
        commit_at_ == kNothingIsDue ? sooner_.wait(lock) : static_cast<void>(sooner_.wait_until(lock, commit_at_));
      }
      stop = stopping_;
      commit_at_ = kNothingIsDue;
    }
    try {
      commit_samples();
      failing = false;
    } catch (const std::exception& error) {
      // The same failure is logged once.
      if (!failing) spdlog::error("Samples cannot be saved: {}", error.what());
      failing = true;
      const MutexLock lock(gather_mutex_);
      commit_at_ = std::min(commit_at_, std::chrono::steady_clock::now() + kBeforeNextTry);
    }
  }
}

void Journal::commit_samples() {
  const auto samples = durable_samples(std::nullopt);
  if (samples.empty()) return;
  writes_.run([&] { add_samples(samples); });
  forget_gathered(samples);
  for (const auto& [job, count] : samples) on_durable_(job);
}

Journal::Counts Journal::durable_samples(std::optional<std::int64_t> job) {
  Counts out;
  {
    const MutexLock lock(gather_mutex_);
    for (const auto& gathered : gathered_) {
      if (!job || gathered.first == *job) out.insert(gathered);
    }
  }
  // Before the journal counts them: a number that somebody has seen is not used again.
  std::erase_if(out, [this](const auto& gathered) {
    return !synchronize_file(JobFolder(data_folder_ / name_of(gathered.first)).reports());
  });
  return out;
}

void Journal::add_samples(const Counts& counts) {
  Statement update(database_,
                   "UPDATE jobs SET last_sequence = last_sequence + ?2 - samples, samples = ?2 "
                   "WHERE number = ?1 AND samples < ?2 AND ended_at IS NULL");
  for (const auto& [job, count] : counts) {
    std::int64_t gathered = 0;
    {
      const MutexLock lock(gather_mutex_);
      if (const auto found = gathered_.find(job); found != gathered_.end()) gathered = found->second;
    }
    // Less if another write has added them, or the job has begun again.
    update.bind(1, job).bind(2, std::min(count, gathered)).run();
  }
}

void Journal::forget_gathered(const Counts& counts) {
  const MutexLock lock(gather_mutex_);
  for (const auto& [job, count] : counts) {
    const auto gathered = gathered_.find(job);
    if (gathered != gathered_.end() && gathered->second <= count) gathered_.erase(gathered);
  }
}

}  // namespace cellcrush::store
