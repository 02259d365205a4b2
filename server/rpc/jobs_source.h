#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cellcrush/v1/jobs_service.pb.h"
#include "rpc/services.h"
#include "store/job_filter.h"
#include "watch/sent_message.h"

namespace cellcrush::rpc {

/// Source of a WatchJobs: a snapshot, then the changes of all jobs and sweeps, the events of the requested jobs, and
/// the newest progress of running jobs. Not thread-safe, except for `wake`.
class JobsSource {
 public:
  using Message = v1::WatchJobsResponse;
  static constexpr bool kIsWatch = true;

  /// `parts` outlives the source. Throws InvalidField for a filter or token that is not valid, and ServiceError:
  /// out_of_range or failed_precondition for a token whose changes are gone.
  JobsSource(const ServiceParts& parts, const v1::WatchJobsRequest& request);
  ~JobsSource();
  JobsSource(const JobsSource&) = delete;
  JobsSource& operator=(const JobsSource&) = delete;

  /// Calls `wake` from now on whenever there may be another message, on other threads and under locks: it must be
  /// quick.
  void open(const std::function<void()>& wake);
  /// Once this returns, `wake` is not called again.
  void close();

  std::optional<watch::SentMessage> next();
  [[nodiscard]] bool has_more() const;
  [[nodiscard]] static bool ended() { return false; }
  [[nodiscard]] watch::SentMessage bookmark() const;
  [[nodiscard]] static std::string resume_advice() { return "with the most recent resume_token"; }

 private:
  class WatchedJob;

  [[nodiscard]] std::string token() const;
  std::int64_t change_in(const std::string& token) const;
  std::optional<Message> next_change();
  [[nodiscard]] store::ChangeReader::Stamp stamp() const;
  [[nodiscard]] bool is_repeated(const store::Change& change) const;
  std::optional<Message> message_of(const store::Change& change);
  std::optional<watch::SentMessage> next_watched();
  std::optional<Message> next_progress();
  bool is_wanted(std::int64_t job);

  const ServiceParts& parts_;
  store::JobFilter filter_;
  std::int64_t after_;  ///< number of the last change sent or passed over
  bool snapshot_sent_ = false;
  std::deque<store::Change> changes_;  ///< read, not sent yet
  std::vector<std::unique_ptr<WatchedJob>> watched_;
  std::size_t turn_ = 0;                               ///< of the requested jobs
  std::map<std::int64_t, bool> wanted_;                ///< whether running jobs pass the filter
  std::map<std::int64_t, std::uint64_t> progress_of_;  ///< count of each job's progress when last sent
  std::uint64_t subscription_ = 0;
};

}  // namespace cellcrush::rpc
