#include "slurm/batcher.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <numeric>
#include <system_error>
#include <utility>

#include "error.h"
#include "pause.h"
#include "slurm/attempt_folder.h"
#include "slurm/cluster_view.h"
#include "slurm/small_file.h"
#include "store/durable_file.h"
#include "store/resource_name.h"

namespace cellcrush::slurm {
namespace {

// Attempts of a sweep arrive within this time.
constexpr std::chrono::milliseconds kToGather{300};
// Slurm's MaxArraySize is 1001 unless the site has raised it.
constexpr std::size_t kMostTasks = 1000;
constexpr std::int64_t kMebibyte = 1024 * 1024;
// For the task's own process, and the files that the worker's has mapped.
constexpr std::int64_t kMemoryBeside = 64;
constexpr std::int64_t kMemoryStep = 128;
// Contacts and slower nodes.
constexpr double kTimeFactor = 3.0;
constexpr double kTimeBeside = 600.0;

// Seconds before the time limit at which Slurm sends SIGUSR2; up to 60 s earlier.
int warning_seconds(std::int64_t minutes) { return minutes > 5 ? 120 : 30; }

// A word for a shell.
std::string shell_word(const std::string& word) {
  std::string out = "'";
  for (const char c : word) c == '\'' ? out += "'\\''" : out += c;
  return out + "'";
}

// The ids of the attempts, or of as many as a comment should hold.
std::string comment_of(const Batch& batch) {
  constexpr int kMost = 20;
  std::string out = "cellcrush attempts:";
  int count = 0;
  for (const auto& task : batch.tasks()) {
    for (const auto& attempt : task.attempts()) {
      if (++count <= kMost) out += " " + attempt;
    }
  }
  return count <= kMost ? out : out + fmt::format(" and {} more", count - kMost);
}

}  // namespace

// NOLINTNEXTLINE(bugprone-easily-swappable-parameters)
Need need_of(int threads, std::int64_t first_bytes, double raised, double seconds) {
  const auto in_steps = [](std::int64_t mib) { return (mib + kMemoryStep - 1) / kMemoryStep * kMemoryStep; };
  const std::int64_t first = in_steps(first_bytes / kMebibyte + kMemoryBeside);
  return {threads, in_steps(std::llround(raised * static_cast<double>(first))), seconds};
}

std::vector<Pack> pack(const std::vector<Need>& attempts, std::chrono::duration<double> task_length,
                       std::size_t most_tasks) {
  std::map<std::pair<int, std::int64_t>, std::vector<std::size_t>> alike;
  for (std::size_t i = 0; i < attempts.size(); ++i) alike[{attempts[i].threads, attempts[i].memory_mib}].push_back(i);
  std::vector<Pack> out;
  for (const auto& [kind, members] : alike) {
    double filled = 0.0;  // of the last task
    bool begins_pack = true;
    for (const std::size_t i : members) {
      if (begins_pack || task_length.count() == 0 || filled + attempts[i].seconds > task_length.count()) {
        if (begins_pack || out.back().tasks.size() == most_tasks) out.push_back({{kind.first, kind.second, 0.0}, {}});
        begins_pack = false;
        out.back().tasks.emplace_back();
        filled = 0.0;
      }
      filled += attempts[i].seconds;
      out.back().tasks.back().push_back(i);
      out.back().need.seconds = std::max(out.back().need.seconds, filled);
    }
  }
  return out;
}

std::int64_t time_limit_minutes(double seconds, std::chrono::seconds longest) {
  double wanted = kTimeFactor * seconds + kTimeBeside;
  if (longest.count() > 0) wanted = std::min(wanted, static_cast<double>(longest.count()));
  return std::max<std::int64_t>(1, std::llround(std::ceil(wanted / 60.0)));
}

Submission::State Submission::state() {
  const MutexLock lock(mutex_);
  return state_;
}

bool Submission::keep(const store::JobFolder& job, State state) {
  const MutexLock lock(mutex_);
  if (is_closed_) return false;
  state_ = std::move(state);
  write_attempt(job, state_.attempt);
  return true;
}

void Submission::close(const store::JobFolder& job) {
  const MutexLock lock(mutex_);
  is_closed_ = true;
  static_cast<void>(store::remove_own(job.attempt()));
}

bool Submission::withdraw() {
  const MutexLock lock(mutex_);
  if (state_.stage == Stage::gathered) is_withdrawn_ = true;
  return is_withdrawn_;
}

bool Submission::take() {
  const MutexLock lock(mutex_);
  if (!is_withdrawn_) state_.stage = Stage::taken;
  return !is_withdrawn_;
}

Batcher::Batcher(const ClusterOptions& options, const Commands& commands)
    : options_(options), commands_(commands), thread_([this](const std::stop_token& stop) { run(stop); }) {}

std::shared_ptr<Submission> Batcher::submit(Attempt attempt, const store::JobFolder& job, const Need& need) {
  auto submission = std::make_shared<Submission>(std::move(attempt));
  {
    const MutexLock lock(mutex_);
    gathered_.push_back({submission, job, need});
  }
  changed_.notify_all();
  return submission;
}

std::filesystem::path Batcher::batch_folder(const ClusterOptions& options, const std::string& batch) {
  return options.folder / "batches" / batch;
}

void Batcher::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    {
      MutexLock lock(mutex_);
      changed_.wait(lock, stop, [this]() CELLCRUSH_REQUIRES(mutex_) { return !gathered_.empty(); });
    }
    if (!pause_unless_stopped(stop, kToGather)) return;
    std::vector<Gathered> gathered;
    {
      const MutexLock lock(mutex_);
      gathered.swap(gathered_);
    }
    std::vector<Need> needs;
    needs.reserve(gathered.size());
    for (const auto& each : gathered) needs.push_back(each.need);
    for (const auto& each : pack(needs, options_.task_length, kMostTasks)) {
      // The next daemon submits the rest.
      if (stop.stop_requested()) return;
      submit_pack(each, gathered);
    }
  }
}

void Batcher::submit_pack(Pack pack, const std::vector<Gathered>& gathered) {
  // Without those that were withdrawn meanwhile.
  for (auto& task : pack.tasks) std::erase_if(task, [&](std::size_t i) { return !gathered[i].submission->take(); });
  std::erase_if(pack.tasks, [](const Share& task) { return task.empty(); });
  if (pack.tasks.empty()) return;
  Submission::State state;
  const std::string batch = store::random_name();
  try {
    const auto arguments = prepare(batch, pack, gathered);
    const Submitted answer = commands_.sbatch(arguments);
    state.stage = answer.job          ? Submission::Stage::answered
                  : answer.is_refused ? Submission::Stage::refused
                                      : Submission::Stage::lost;
    state.why = answer.why;
    state.attempt.set_slurm_job(answer.job.value_or(0));
    if (answer.job)
      spdlog::info("Slurm job {} of {} computes {} attempts in {} tasks", *answer.job, options_.name,
                   std::accumulate(pack.tasks.begin(), pack.tasks.end(), std::size_t{0},
                                   [](std::size_t sum, const Share& share) { return sum + share.size(); }),
                   pack.tasks.size());
  } catch (const std::exception& error) {
    // sbatch was not run.
    static_cast<void>(store::remove_own(batch_folder(options_, batch)));
    state.stage = Submission::Stage::refused;
    state.why = error.what();
    state.trouble = trouble_of(error);
  }
  for (const auto& task : pack.tasks) {
    for (const std::size_t i : task) {
      auto own = state;
      own.attempt = gathered[i].submission->state().attempt;
      own.attempt.set_slurm_job(state.attempt.slurm_job());
      tell(gathered[i], std::move(own));
    }
  }
}

void Batcher::tell(const Gathered& gathered, Submission::State state) {
  const auto attempt = state.attempt;
  try {
    if (gathered.submission->keep(gathered.job, std::move(state))) return;
    // It was given up meanwhile: its task has nothing to compute.
    if (attempt.slurm_job() != 0 && attempt.shares() <= 1)
      static_cast<void>(commands_.scancel(attempt.slurm_job(), task_index(attempt)));
  } catch (const std::exception& error) {
    // The next daemon finds the job by its name.
    spdlog::warn("The number of Slurm job {} cannot be kept: {}", attempt.slurm_job(), error.what());
  }
}

std::vector<std::string> Batcher::prepare(const std::string& batch, const Pack& pack,
                                          const std::vector<Gathered>& gathered) {
  const auto folder = batch_folder(options_, batch);
  if (const int error = store::make_own_folder(folder); error != 0) store::throw_file_error(folder, "written", error);
  Batch tasks;
  const bool is_array = pack.tasks.size() > 1;
  for (std::size_t task = 0; task < pack.tasks.size(); ++task) {
    auto* own = tasks.add_tasks();
    for (const std::size_t i : pack.tasks[task]) {
      auto state = gathered[i].submission->state();
      state.attempt.set_batch(batch);
      state.attempt.set_task(static_cast<int>(task));
      state.attempt.set_is_array(is_array);
      state.attempt.set_shares(static_cast<int>(pack.tasks[task].size()));
      own->add_attempts(state.attempt.id());
      if (!gathered[i].submission->keep(gathered[i].job, std::move(state)))
        spdlog::info("attempt {} is submitted in vain", own->attempts().at(own->attempts_size() - 1));
    }
  }
  write_small_file(folder / "tasks", tasks.SerializeAsString());
  write_small_file(folder / "script", script_of(batch));
  const auto on_nodes = options_.named_folder / "batches" / batch;
  const std::string log = is_array ? "task-%a.log" : "task-0.log";
  const auto minutes = time_limit_minutes(pack.need.seconds, options_.longest);
  std::vector<std::string> out = {"--job-name=" + (kJobPrefix + batch),
                                  "--comment=" + comment_of(tasks),
                                  "--nodes=1",
                                  "--ntasks=1",
                                  fmt::format("--cpus-per-task={}", pack.need.threads),
                                  fmt::format("--mem={}M", pack.need.memory_mib),
                                  fmt::format("--time={}", minutes),
                                  fmt::format("--signal=B:USR2@{}", warning_seconds(minutes)),
                                  "--no-requeue",
                                  "--export=NIL",
                                  "--chdir=" + on_nodes.string(),
                                  "--output=" + (on_nodes / log).string()};
  if (is_array) out.push_back(fmt::format("--array=0-{}%{}", pack.tasks.size() - 1, options_.tasks));
  out.insert(out.end(), options_.sbatch.begin(), options_.sbatch.end());
  out.push_back((folder / "script").string());
  return out;
}

std::string Batcher::script_of(const std::string& batch) const {
  std::string out = "#!/bin/sh\n# Computes a batch of crushes for cellcrushd.\n";
  if (!options_.simd.empty()) out += "export CELLCRUSH_SIMD=" + shell_word(options_.simd) + "\n";
  return out + fmt::format("exec {} task --lease {} --folder {} --batch {}\n", shell_word(options_.program.string()),
                           std::chrono::duration<double>(options_.times.lease).count(),
                           shell_word(options_.named_folder.string()), batch);
}

int task_index(const Attempt& attempt) { return attempt.is_array() ? attempt.task() : -1; }

}  // namespace cellcrush::slurm
