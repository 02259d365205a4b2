#pragma once

#include <grpcpp/support/status.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cellcrush/v1/event.pb.h"

namespace cellcrush::testing {

/// Holds one watch of a job against what event.proto and WatchJob promise: a snapshot first and once; then every state
/// and sample behind the number that was given, in order, none twice and none missing, but samples of a run that the
/// job gives up later, by beginning again; progress and frames between them in their order; nothing behind the job's
/// last state, and OK only then. Not thread-safe.
class WatchContract {
 public:
  /// Of a watch with this after_sequence.
  explicit WatchContract(std::int64_t after = 0) : sequence_(after) {}

  /// The next message.
  void see(const v1::JobEvent& event);
  /// How the watch ended.
  void end(const grpc::Status& status);

  /// What was not kept, a sentence each.
  [[nodiscard]] const std::vector<std::string>& broken() const { return broken_; }
  /// Number of the last state or sample.
  [[nodiscard]] std::int64_t sequence() const { return sequence_; }
  /// The states and samples.
  [[nodiscard]] const std::vector<v1::JobEvent>& numbered() const { return numbered_; }
  /// Whether the job's last state was seen.
  [[nodiscard]] bool job_ended() const { return job_ended_; }

 private:
  void require(bool kept, const std::string& promise);
  void see_numbered(const v1::JobEvent& event);
  void see_frame(const v1::FrameChunk& chunk);

  std::int64_t sequence_;
  std::int64_t step_ = -1;  ///< of the last sample
  bool any_ = false;
  bool job_ended_ = false;
  bool had_ended_ = false;  ///< the snapshot says so
  std::optional<v1::Job::State> state_;
  std::optional<std::int64_t> gap_;  ///< the state before which samples are missing, until the job begins again
  std::optional<int> frame_;         ///< index of the last one
  int parts_left_ = 0;               ///< of that frame
  std::vector<v1::JobEvent> numbered_;
  std::vector<std::string> broken_;
};

}  // namespace cellcrush::testing
