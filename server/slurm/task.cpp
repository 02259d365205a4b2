#include "slurm/task.h"

#include <absl/strings/numbers.h>
#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <stop_token>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "jobs/local_process.h"
#include "slurm/attempt_folder.h"
#include "slurm/attempt_run.h"
#include "slurm/small_file.h"
#include "store/durable_file.h"

namespace cellcrush::slurm {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kStallLimit{60'000};
constexpr std::chrono::milliseconds kBetweenTries{1'000};
constexpr int kTries = 600;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::string host_name() {
  std::array<char, HOST_NAME_MAX + 1> out{};
  gethostname(out.data(), out.size() - 1);
  return out.data();
}

int own_task() {
  int out = 0;
  return absl::SimpleAtoi(variable("SLURM_ARRAY_TASK_ID"), &out) ? out : 0;
}

Claim own_claim() {
  Claim out;
  out.set_host(host_name());
  out.set_process(getpid());
  out.set_slurm_job(variable("SLURM_JOB_ID"));
  out.set_restart(variable("SLURM_RESTART_COUNT"));
  return out;
}

// Blocked in all threads that are started from now on.
sigset_t block_ends() {
  sigset_t out;
  sigemptyset(&out);
  for (const int signal : {SIGTERM, SIGINT, SIGUSR2}) sigaddset(&out, signal);
  pthread_sigmask(SIG_BLOCK, &out, nullptr);
  return out;
}

void wait_for_ends(const sigset_t& signals, TaskEnd& end, const std::stop_token& stop) {
  const timespec interval{0, 100'000'000};
  while (!stop.stop_requested()) {
    const int received = sigtimedwait(&signals, nullptr, &interval);
    if (received < 0) continue;
    spdlog::info("received {}", strsignal(received));
    auto reason = Ended::REASON_UNSPECIFIED;  // the first counts
    end.compare_exchange_strong(reason, received == SIGUSR2 ? Ended::TIME_LIMIT : Ended::TERMINATED);
  }
}

// Says on behalf of an attempt that was not begun that this task ends.
void leave_unbegun(const AttemptFolder& shared, Ended::Reason reason) {
  Ended ended;
  ended.set_kind(Ended::LEFT);
  ended.set_reason(reason);
  ended.set_advanced(true);
  shared.end(ended);
}

// Names of the attempts of this task.
std::vector<std::string> own_attempts(const fs::path& folder, const std::string& name) {
  const auto batch = read_message<Batch>(folder / "batches" / name / "tasks");
  const int task = own_task();
  if (!batch || task < 0 || task >= batch->tasks_size()) {
    spdlog::info("batch {} has no task {} any more", name, task);
    return {};
  }
  const auto& attempts = batch->tasks(task).attempts();
  return {attempts.begin(), attempts.end()};
}

// Tries for a while: the daemon may be restarting, or the shared folder be full.
template <typename Call>
auto patiently(const TaskEnd& end, const Call& call) {
  for (int i = 0;; ++i) {
    try {
      return call();
    } catch (const std::exception& error) {
      if (i == kTries || end.load() != Ended::REASON_UNSPECIFIED) throw;
      if (i == 0) spdlog::warn("trying again: {}", error.what());
    }
    std::this_thread::sleep_for(kBetweenTries);
  }
}

void compute(const std::string& id, const AttemptFolder& shared, const TaskOptions& options, const TaskEnd& end) {
  const Claim claim = own_claim();
  if (!patiently(end, [&] { return shared.claim(claim); })) {
    spdlog::info("attempt {} is not this task's", id);
    return;
  }
  if (const auto reason = end.load(); reason != Ended::REASON_UNSPECIFIED) return leave_unbegun(shared, reason);
  spdlog::info("attempt {} begins", id);
  try {
    const ScratchFolder scratch(variable("TMPDIR").empty() ? "/tmp" : variable("TMPDIR"));
    const store::JobFolder folder(scratch.path());
    patiently(end, [&] {
      copy_durably(shared.files().order(), folder.order(), kOrder);
      if (store::is_own_file(shared.files().lattice()))
        copy_durably(shared.files().lattice(), folder.lattice(), kOrder);
      copy_run(shared.files(), folder);
    });
    jobs::LocalProcess workers(options.worker_program, kStallLimit, jobs::count_oom_kills,
                               jobs::LocalProcess::Life::ends_with_parent);
    AttemptRun(shared, workers, end, options.lease).run(folder);
    spdlog::info("attempt {} has ended", id);
  } catch (const std::exception& error) {
    Ended ended;
    ended.set_kind(Ended::NOT_STARTED);
    ended.set_message(error.what());
    patiently(end, [&] { shared.end(ended); });
    throw;
  }
}

// The locks of a network file system may not reach other nodes, so each node has names of its own.
std::string prefix_of_node() { return "cellcrush-task-" + host_name() + "@"; }

OpenFile open_folder(const fs::path& path) { return store::try_open_own(path, O_RDONLY | O_DIRECTORY); }

bool is_own(const OpenFile& folder) {
  struct stat status {};
  return fstat(folder.get(), &status) == 0 && status.st_uid == geteuid();
}

// Another task may have taken the new folder for a left one, in the instant before it was locked.
bool still_exists(const OpenFile& folder, const fs::path& path) {
  struct stat opened {};
  struct stat found {};
  return fstat(folder.get(), &opened) == 0 && stat(path.c_str(), &found) == 0 && opened.st_ino == found.st_ino;
}

void remove_left_folders(const fs::path& parent, const std::string& prefix) {
  std::error_code ignored;
  for (auto entry = fs::directory_iterator(parent, ignored); entry != fs::directory_iterator();
       entry.increment(ignored)) {
    if (!entry->path().filename().string().starts_with(prefix)) continue;
    const OpenFile folder = open_folder(entry->path());
    if (folder && is_own(folder) && flock(folder.get(), LOCK_EX | LOCK_NB) == 0)
      static_cast<void>(store::remove_own(entry->path()));
  }
}

}  // namespace

ScratchFolder::ScratchFolder(const fs::path& given) {
  const auto parent = store::canonical_of(given);
  const std::string prefix = prefix_of_node();
  remove_left_folders(parent, prefix);
  while (!lock_) {
    std::string name = (parent / prefix).string() + "XXXXXX";
    if (mkdtemp(name.data()) == nullptr) store::throw_file_error(name, "created", errno);
    path_ = name;
    OpenFile folder = open_folder(path_);
    if (!folder && errno == ENOENT) continue;
    if (!folder) {
      const int error = errno;
      rmdir(name.c_str());
      store::throw_file_error(path_, "used", error);
    }
    // On a file system without locks, nobody takes a folder for a left one.
    static_cast<void>(flock(folder.get(), LOCK_EX));
    if (still_exists(folder, path_)) lock_ = std::move(folder);
  }
}

ScratchFolder::~ScratchFolder() { static_cast<void>(store::remove_own(path_)); }

int run_task(const TaskOptions& options) {
  TaskEnd end = Ended::REASON_UNSPECIFIED;
  const sigset_t signals = block_ends();
  const std::jthread waits([&](const std::stop_token& stop) { wait_for_ends(signals, end, stop); });
  const auto folder = store::canonical_of(options.folder);
  int out = 0;
  try {
    for (const auto& id : own_attempts(folder, options.batch)) {
      try {
        compute(id, AttemptFolder(folder, id), options, end);
      } catch (const std::exception& error) {
        // The next attempt may have more luck.
        spdlog::error("attempt {}: {}", id, error.what());
        out = 1;
      }
    }
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    out = 1;
  }
  return out;
}

}  // namespace cellcrush::slurm
