#include "connection/job_stream.h"

#include <algorithm>

#include "connection/stream_follower.h"

namespace cellcrush::client {

namespace {

const v1::Job* job_in(const v1::JobEvent& event) {
  if (event.has_snapshot()) return &event.snapshot().job();
  return event.has_state() ? &event.state() : nullptr;
}

}  // namespace

bool follow_job(Connection& connection, const std::string& name, bool frames, const Interruption& interruption,
                JobWatcher& watcher) {
  v1::Jobs::Stub& jobs = connection.jobs();
  v1::WatchJobRequest request;
  request.set_name(name);
  request.set_frames(frames);
  v1::Job::State state = v1::Job::JOB_STATE_UNSPECIFIED;
  const auto read = [&](grpc::ClientContext& context, const std::function<void()>& heard) {
    StreamReading reading;
    const auto reader = jobs.WatchJob(&context, request);
    v1::JobEvent event;
    while (reader->Read(&event)) {
      heard();
      reading.advanced = reading.advanced || event.sequence() > request.after_sequence();
      request.set_after_sequence(std::max(request.after_sequence(), event.sequence()));
      if (event.has_snapshot()) request.set_epoch(event.snapshot().epoch());
      if (const v1::Job* job = job_in(event)) state = job->state();
      watcher.on_event(event);
    }
    reading.status = reader->Finish();
    reading.complete = is_final(state);
    return reading;
  };
  const auto on_break = [&](const std::string& reason) { watcher.on_break(reason); };
  const auto refusal = [&](const grpc::Status& status) { return connection.error_about(name, status); };
  return follow_stream({name, read, on_break, refusal}, interruption);
}

}  // namespace cellcrush::client
