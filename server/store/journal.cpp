#include "store/journal.h"

#include <google/protobuf/util/time_util.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "error.h"
#include "store/begin_again.h"
#include "store/job_bytes.h"
#include "store/job_state.h"
#include "store/journal_mending.h"
#include "store/journal_schema.h"
#include "store/resource_name.h"

namespace cellcrush::store {
namespace {

constexpr std::chrono::milliseconds kBeforeNextTry{200};

void apply(const StateChange& change, v1::Job& job) {
  const auto now = google::protobuf::util::TimeUtil::GetCurrentTime();
  job.set_state(change.state);
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

/// Marks that a writer holds gathered samples, until they are durable or given back.
class Journal::Taking {
 public:
  explicit Taking(Journal& journal) : journal_(journal) {
    const MutexLock lock(journal_.gather_mutex_);
    ++journal_.takings_;
  }
  ~Taking() {
    const MutexLock lock(journal_.gather_mutex_);
    --journal_.takings_;
  }
  Taking(const Taking&) = delete;
  Taking& operator=(const Taking&) = delete;

 private:
  Journal& journal_;
};

Journal::Journal(const std::filesystem::path& path, Durable on_durable, GroupCommit::Committed on_commit,
                 Clocks::Source uptime)
    : on_durable_(std::move(on_durable)),
      database_(path),
      clock_(prepare_journal(database_), std::move(uptime)),
      writes_(database_, std::move(on_commit)) {
  mend_jobs(database_, clock_.seconds());
  prepare_giving_back(database_);
  epoch_ = read_epoch(database_);
  upkeep_.emplace(path, kUpkeepInterval);
  committer_ = std::thread([this] { commit_gathered_when_due(); });
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
  Gathered samples;
  const Taking taking(*this);
  writes_.run(
      [&] {
        samples = take_gathered(job);
        insert_samples(job, samples[job]);
        write_change(job, change);
        if (change.state == v1::Job::FAILED) stopped = stop_failing_sweep(job);
      },
      [&] { give_back(std::move(samples)); });
  on_durable_(job);
  for (const std::int64_t other : stopped) on_durable_(other);
  return stopped;
}

void Journal::begin_again(std::int64_t job, const std::string& why) {
  Gathered dropped;
  const Taking taking(*this);
  writes_.run(
      [&] {
        dropped = take_gathered(job);
        store::begin_again(database_, job, why);
      },
      [&] { give_back(std::move(dropped)); });
  on_durable_(job);
}

void Journal::write_change(std::int64_t job, const StateChange& change) {
  v1::Job stored;
  {
    Statement read(database_, "SELECT job, state FROM jobs WHERE number = ?1");
    if (!read.bind(1, job).step())
      throw ServiceError(ServiceError::Kind::not_found, "There is no " + name_of(job) + ".");
    if (!read_job_bytes(read.bytes(0), read.integer(1), stored)) throw unreadable_entry(job);
  }
  if (!may_follow(stored.state(), change.state)) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       name_of(job) + " is " + v1::Job::State_Name(stored.state()) + " and cannot become " +
                           v1::Job::State_Name(change.state) + ".");
  }
  apply(change, stored);
  const std::int64_t sequence = find_last_sequence(job).value() + 1;
  insert_event(job, sequence, kStateEvent, job_bytes(stored));
  Statement update(database_,
                   "UPDATE jobs SET state = ?2, job = ?3, last_sequence = ?4, ended_at = ?5 WHERE number = ?1");
  update.bind(1, job).bind(2, stored.state()).bind_blob(3, job_bytes(stored)).bind(4, sequence);
  if (is_terminal(stored.state())) update.bind(5, clock_.seconds());
  update.run();
}

void Journal::append_sample(std::int64_t job, const v1::Sample& sample, std::chrono::milliseconds within) {
  std::string bytes = sample.SerializeAsString();
  const auto limit = std::chrono::steady_clock::now() + within;
  {
    const MutexLock lock(gather_mutex_);
    gathered_[job].push_back({sample.step(), std::move(bytes)});
    if (limit >= commit_at_) return;
    commit_at_ = limit;
  }
  sooner_.notify_all();
}

void Journal::set_mesh(std::int64_t job, const v1::Mesh& mesh) {
  writes_.run([&] {
    Statement insert(database_, "INSERT OR REPLACE INTO meshes (job, mesh) VALUES (?1, ?2)");
    insert.bind(1, job).bind_blob(2, mesh.SerializeAsString()).run();
  });
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
      // The samples were given back and are retried; the same failure is logged once.
      if (!failing) spdlog::error("Samples cannot be saved: {}", error.what());
      failing = true;
    }
  }
}

void Journal::commit_samples() {
  {
    const MutexLock lock(gather_mutex_);
    if (gathered_.empty() && takings_ == 0) return;
  }
  // Samples taken by another writer are durable once this write has had its turn.
  Gathered samples;
  const Taking taking(*this);
  writes_.run(
      [&] {
        samples = take_gathered(std::nullopt);
        for (const auto& [job, of_job] : samples) insert_samples(job, of_job);
      },
      [&] { give_back(std::move(samples)); });
  for (const auto& [job, of_job] : samples) on_durable_(job);
}

std::optional<std::int64_t> Journal::find_last_sequence(std::int64_t job) {
  Statement read(database_, "SELECT last_sequence FROM jobs WHERE number = ?1");
  return read.bind(1, job).step() ? std::optional(read.integer(0)) : std::nullopt;
}

void Journal::insert_event(std::int64_t job, std::int64_t sequence, int kind, const std::string& payload) {
  Statement insert(database_, "INSERT INTO events (job, sequence, kind, payload) VALUES (?1, ?2, ?3, ?4)");
  insert.bind(1, job).bind(2, sequence).bind(3, kind).bind_blob(4, payload).run();
}

std::int64_t Journal::find_newest_step(std::int64_t job) {
  Statement read(database_, "SELECT payload FROM events WHERE job = ?1 AND kind = ?2 ORDER BY sequence DESC");
  read.bind(1, job).bind(2, kSampleEvent);
  for (v1::Sample sample; read.step();) {
    if (sample.ParseFromString(read.bytes(0))) return sample.step();
  }
  return -1;
}

void Journal::insert_samples(std::int64_t job, const std::vector<GatheredSample>& samples) {
  if (samples.empty()) return;
  const auto newest = find_last_sequence(job);
  // The job was deleted meanwhile.
  if (!newest) return;
  std::int64_t sequence = *newest;
  std::int64_t last_step = find_newest_step(job);
  {
    Statement insert(database_, "INSERT INTO events (job, sequence, kind, payload) VALUES (?1, ?2, ?3, ?4)");
    insert.bind(1, job).bind(3, kSampleEvent);
    for (const auto& sample : samples) {
      if (sample.step <= last_step) continue;
      last_step = sample.step;
      insert.bind(2, ++sequence).bind_blob(4, sample.bytes).run();
    }
  }
  if (sequence == *newest) return;
  Statement update(database_, "UPDATE jobs SET last_sequence = ?2 WHERE number = ?1");
  update.bind(1, job).bind(2, sequence).run();
}

Journal::Gathered Journal::take_gathered(std::optional<std::int64_t> job) {
  const MutexLock lock(gather_mutex_);
  if (!job) return std::exchange(gathered_, {});
  Gathered taken;
  if (auto node = gathered_.extract(*job)) taken.insert(std::move(node));
  return taken;
}

void Journal::give_back(Gathered&& samples) {
  const MutexLock lock(gather_mutex_);
  for (auto& [job, older] : samples) {
    auto& newer = gathered_[job];
    newer.insert(newer.begin(), std::make_move_iterator(older.begin()), std::make_move_iterator(older.end()));
  }
  commit_at_ = std::min(commit_at_, std::chrono::steady_clock::now() + kBeforeNextTry);
  sooner_.notify_all();
}

}  // namespace cellcrush::store
