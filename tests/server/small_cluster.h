#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "jobs/executor.h"
#include "jobs/local_process.h"

namespace cellcrush::testing {

/// What a cluster with a queue of its own knows. It outlives the daemons that hand jobs to it. Thread-safe.
class SmallCluster {
 public:
  /// From now on jobs start, and those in its queue do.
  void open() { is_open_ = true; }

  [[nodiscard]] std::size_t queued() const {
    const std::lock_guard lock(mutex_);
    return queued_.size();
  }

  /// Threads of the jobs that were handed to it, in that order.
  [[nodiscard]] std::vector<int> threads() const {
    const std::lock_guard lock(mutex_);
    return threads_;
  }

  /// An executor that hands jobs to it, for a daemon.
  jobs::ExecutorOptions executor(const std::string& name, int slots);

 private:
  class Client;

  mutable std::mutex mutex_;
  std::atomic<bool> is_open_ = false;
  std::set<std::filesystem::path> queued_;  // folders of jobs
  std::vector<int> threads_;
};

/// Puts a job into the cluster's queue, and runs its worker on this machine once the cluster is open.
class SmallCluster::Client final : public jobs::Executor {
 public:
  Client(SmallCluster& cluster, const jobs::ExecutorSurroundings& given)
      : cluster_(cluster), workers_(given.worker_program, given.stall_limit) {}

  bool has_worker(const store::JobFolder& folder) override {
    const std::lock_guard lock(cluster_.mutex_);
    return cluster_.queued_.contains(folder.root()) || workers_.has_worker(folder);
  }

  std::optional<jobs::WorkerExit> read_final_report(const store::JobFolder& folder,
                                                    const jobs::WorkerEvents& events) override {
    return workers_.read_final_report(folder, events);
  }

  void end_worker(const store::JobFolder& folder) override { workers_.end_worker(folder); }

  jobs::WorkerExit run(const store::JobFolder& folder, const worker::Order& order, const jobs::WorkerEvents& events,
                       const jobs::Interruptions& interruptions) override {
    using Kind = jobs::WorkerExit::Kind;
    {
      const std::lock_guard lock(cluster_.mutex_);
      if (cluster_.queued_.insert(folder.root()).second) cluster_.threads_.push_back(order.threads());
    }
    events.placed("Cluster job 7, PENDING (Resources)");
    const auto left = wait(interruptions);
    // The cluster keeps the jobs of a daemon that ends.
    if (left == Kind::stopped) return exit_of(left);
    {
      const std::lock_guard lock(cluster_.mutex_);
      cluster_.queued_.erase(folder.root());
    }
    if (left != Kind::exited) return exit_of(left);
    events.placed("Cluster job 7, RUNNING on node1");
    return workers_.run(folder, order, events, interruptions);
  }

 private:
  static jobs::WorkerExit exit_of(jobs::WorkerExit::Kind kind) {
    jobs::WorkerExit out;
    out.kind = kind;
    return out;
  }

  // Why a job left the queue; `exited` if it starts.
  jobs::WorkerExit::Kind wait(const jobs::Interruptions& interruptions) {
    for (;; std::this_thread::sleep_for(std::chrono::milliseconds(5))) {
      if (interruptions.cancel.stop_requested()) return jobs::WorkerExit::Kind::cancelled;
      if (interruptions.suspend.stop_requested()) return jobs::WorkerExit::Kind::suspended;
      if (interruptions.stop.stop_requested()) return jobs::WorkerExit::Kind::stopped;
      if (cluster_.is_open_) return jobs::WorkerExit::Kind::exited;
    }
  }

  SmallCluster& cluster_;
  jobs::LocalProcess workers_;
};

inline jobs::ExecutorOptions SmallCluster::executor(const std::string& name, int slots) {
  return {name, slots,
          [this](const jobs::ExecutorSurroundings& given) { return std::make_unique<Client>(*this, given); }};
}

}  // namespace cellcrush::testing
