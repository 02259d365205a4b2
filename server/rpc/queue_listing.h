#pragma once

#include <cstdint>
#include <vector>

#include "cellcrush/v1/admin_service.pb.h"
#include "jobs/queue_forecast.h"
#include "jobs/queues.h"
#include "store/journal_reader.h"
#include "watch/hub.h"

namespace cellcrush::rpc {

/// Lists the waiting jobs of all executors, for GetQueue. Thread-safe.
class QueueListing {
 public:
  /// References outlive the listing.
  struct Parts {
    store::JournalReader& reader;
    watch::Hub& hub;
    jobs::Queues& queues;
    double step_cost = 0.0;     ///< seconds of one core per element and step
    int owner_max_running = 0;  ///< jobs of one owner that run at once on one executor; 0: no limit
  };

  explicit QueueListing(const Parts& parts) : parts_(parts) {}

  /// Throws ServiceError if the journal cannot be read.
  v1::Queue list();

 private:
  /// Jobs of one executor.
  struct Jobs {
    std::vector<jobs::RunningJob> running;  ///< or with the executor, which has not started them
    std::vector<store::QueuedJob> waiting;
  };

  /// Jobs that the executor has, and entries for those that it has not started.
  Jobs jobs_of(const std::string& executor, v1::Queue& out);
  jobs::RunningJob running_job(const store::QueuedJob& job, v1::Job::State state);
  jobs::JobFacts facts_of(std::int64_t job);
  void add_queue(const jobs::Queues::Standing& standing, v1::Queue& out);
  void add_kept_jobs(const std::string& executor, v1::Queue& out);

  Parts parts_;
};

}  // namespace cellcrush::rpc
