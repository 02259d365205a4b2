#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>

#include "cellcrush/v1/event.pb.h"
#include "cellcrush/v1/jobs_service.pb.h"
#include "store/journal_reader.h"
#include "watch/hub.h"
#include "watch/pump.h"
#include "watch/watch_cursor.h"

namespace cellcrush::rpc {

/// One open WatchJob: moves messages from its cursor to the stream, one at a time, as fast as the client takes them.
/// It keeps itself until gRPC is done with it.
class WatchReactor final : public grpc::ServerWriteReactor<v1::JobEvent>, public watch::Pump::Task {
 public:
  struct Parts {
    store::JournalReader& reader;
    watch::Hub& hub;
    watch::Pump& pump;
    std::chrono::milliseconds bookmark_interval;
  };

  /// Begins a watch. Throws ServiceError when the request cannot be met.
  static grpc::ServerWriteReactor<v1::JobEvent>* start(const Parts& parts, std::int64_t job,
                                                       const v1::WatchJobRequest& request);

  WatchReactor(const Parts& parts, std::shared_ptr<watch::Channel> channel, watch::WatchCursor cursor);

  void run() override;

  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

 private:
  using Clock = std::chrono::steady_clock;

  /// What to do next; decided under the lock, done without it, because gRPC may answer at once.
  enum class Action { none, write, finish };
  Action decide();
  Action close(grpc::Status status);

  watch::Pump& pump_;
  std::chrono::milliseconds bookmark_interval_;
  std::shared_ptr<watch::Channel> channel_;
  std::uint64_t subscription_ = 0;
  std::shared_ptr<WatchReactor> self_;

  std::mutex mutex_;  ///< guards all below
  watch::WatchCursor cursor_;
  v1::JobEvent message_;  ///< in the hands of gRPC while writing_
  grpc::Status status_;
  bool writing_ = false;
  bool finished_ = false;
  bool cancelled_ = false;
  Clock::time_point last_write_ = Clock::now();
};

}  // namespace cellcrush::rpc
