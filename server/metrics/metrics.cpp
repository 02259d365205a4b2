#include "metrics/metrics.h"

#include <prometheus/counter.h>
#include <prometheus/exposer.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>

#include <array>
#include <exception>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "cellcrush/simd.h"
#include "error.h"
#include "metrics/measured.h"
#include "mutex.h"
#include "revision.h"

namespace cellcrush::metrics {
namespace {

using Counters = prometheus::Family<prometheus::Counter>;

prometheus::Gauge& gauge(prometheus::Registry& registry, const char* name, const char* help) {
  return prometheus::BuildGauge().Name(name).Help(help).Register(registry).Add({});
}

Counters& counters(prometheus::Registry& registry, const char* name, const char* help) {
  return prometheus::BuildCounter().Name(name).Help(help).Register(registry);
}

prometheus::Family<prometheus::Gauge>& gauges(prometheus::Registry& registry, const char* name, const char* help) {
  return prometheus::BuildGauge().Name(name).Help(help).Register(registry);
}

using Bounds = prometheus::Histogram::BucketBoundaries;

// Of times, s: from a tenth of a millisecond to ten seconds.
const Bounds& times() {
  static const Bounds out = {1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0, 3.0, 10.0};
  return out;
}

// Of a predicted time over the actual one.
const Bounds& ratios() {
  static const Bounds out = {0.25, 0.5, 0.67, 0.8, 0.9, 1.0, 1.1, 1.25, 1.5, 2.0, 4.0};
  return out;
}

prometheus::Family<prometheus::Histogram>& histograms(prometheus::Registry& registry, const char* name,
                                                      const char* help) {
  return prometheus::BuildHistogram().Name(name).Help(help).Register(registry);
}

prometheus::Histogram& histogram(prometheus::Registry& registry, const char* name, const char* help) {
  return histograms(registry, name, help).Add({}, times());
}

constexpr std::array kNoticeResults = {"delivered", "retried", "dropped"};  // as Metrics::Notice

// A scraper that connects and sends nothing, or a byte now and then, holds one thread for a second. At most 8
// connections are served, 8 wait in the queue and 16 in the kernel; behind these a scrape waits for 4 s.
std::vector<std::string> http_options(const ListenAddress& address) {
  return {"listening_ports",    address.place + ":" + std::to_string(address.port),
          "num_threads",        "8",
          "connection_queue",   "8",
          "listen_backlog",     "16",
          "request_timeout_ms", "1000",
          "enable_keep_alive",  "no"};
}

/// Calls visit(stage, seconds) for every stage of a step, by the names of the fields, which end in "_s".
template <class Visit>
void visit_stages(const v1::StageTimes& times, const Visit& visit) {
  const auto* descriptor = v1::StageTimes::descriptor();
  for (int i = 0; i < descriptor->field_count(); ++i) {
    const auto* field = descriptor->field(i);
    visit(field->name().substr(0, field->name().size() - 2), times.GetReflection()->GetDouble(times, field));
  }
}

}  // namespace

struct Metrics::Impl {
  Impl() {
    // All are there from the start, at 0.
    add_stages({});
    set_holds({});
    for (int cause = 1; cause < v1::Job::Cause_ARRAYSIZE; ++cause) {
      if (v1::Job::Cause_IsValid(cause)) failure(static_cast<v1::Job::Cause>(cause));
    }
    gauges(*registry, "cellcrush_build_info", "1; the labels say what runs.")
        .Add({{"version", kVersion}, {"revision", kSourceRevision}, {"simd", simd_target()}})
        .Set(1.0);
  }

  void set_holds(const std::set<Shortage>& holds) {
    for (const Shortage shortage : kShortages)
      held.Add({{"cause", name_of(shortage)}}).Set(holds.contains(shortage) ? 1.0 : 0.0);
  }

  prometheus::Counter& device_runs(bool advanced) {
    return counters(*registry, "cellcrush_device_runs_total", "Runs that have ended on a machine with a device.")
        .Add({{"use", advanced ? "advanced" : "left_to_processor"}});
  }

  void add_stages(const v1::StageTimes& stage_times) {
    visit_stages(stage_times, [this](const std::string& stage, double seconds) {
      stages.Add({{"stage", stage}}).Increment(seconds);
    });
  }

  prometheus::Counter& failure(v1::Job::Cause cause) { return failures.Add({{"cause", v1::Job::Cause_Name(cause)}}); }

  std::shared_ptr<Measured> measured = std::make_shared<Measured>();
  std::shared_ptr<prometheus::Registry> registry = std::make_shared<prometheus::Registry>();
  prometheus::Gauge& waiting = gauge(*registry, "cellcrush_jobs_waiting", "Jobs waiting in the queue.");
  prometheus::Gauge& running = gauge(*registry, "cellcrush_jobs_running", "Jobs running, or accepted by an executor.");
  prometheus::Family<prometheus::Gauge>& held =
      gauges(*registry, "cellcrush_queue_held", "1 while a queue is held for this cause, else 0.");
  prometheus::Gauge& journal_damaged =
      gauge(*registry, "cellcrush_journal_damaged", "1 if the journal lost changes or was found damaged, else 0.");
  Counters& ended = counters(*registry, "cellcrush_jobs_ended_total", "Jobs that have ended, by final state.");
  Counters& failures = counters(*registry, "cellcrush_job_failures_total", "Jobs that have FAILED, by cause.");
  prometheus::Counter& run_seconds =
      counters(*registry, "cellcrush_run_seconds_total",
               "Wall-clock time of runs on this machine that succeeded without interruption.")
          .Add({});
  prometheus::Counter& forecast_seconds = counters(*registry, "cellcrush_forecast_seconds_total",
                                                   "Predicted time of the runs of cellcrush_run_seconds_total.")
                                              .Add({});
  prometheus::Histogram& forecast_ratios =
      histograms(*registry, "cellcrush_forecast_ratio",
                 "Predicted over actual time, per run of cellcrush_run_seconds_total.")
          .Add({}, ratios());
  Counters& calls = counters(*registry, "cellcrush_calls_total", "Calls that have ended, by method and code.");
  prometheus::Family<prometheus::Histogram>& call_times =
      histograms(*registry, "cellcrush_call_seconds", "Time from a call to its answer, without streams.");
  Counters& notices = counters(*registry, "cellcrush_notices_total",
                               "Notices to a webhook, a command or a collector of traces, by result.");
  prometheus::Counter& steps =
      counters(*registry, "cellcrush_steps_total", "Time steps of jobs that have ended with a result.").Add({});
  Counters& stages = counters(*registry, "cellcrush_stage_seconds_total",
                              "Processor time of jobs that have ended with a result, by stage of the time step.");
  prometheus::Gauge& speed =
      gauge(*registry, "cellcrush_steps_per_second", "Time steps per second of the running jobs, added up.");
  prometheus::Histogram& commits =
      histogram(*registry, "cellcrush_commit_seconds", "Time to commit a change to the journal.");
  prometheus::Histogram& events = histogram(*registry, "cellcrush_event_seconds",
                                            "Time from an event of a watched job to its message on the stream.");
  prometheus::Gauge& watchers = gauge(*registry, "cellcrush_watchers", "Open watches.");
  prometheus::Gauge& connections = gauge(*registry, "cellcrush_connections", "Open gRPC connections.");
  prometheus::Counter& refused = counters(*registry, "cellcrush_refused_connections_total",
                                          "Connections refused because of the connection limits.")
                                     .Add({});
  prometheus::Counter& skipped =
      counters(*registry, "cellcrush_skipped_frames_total", "Frames skipped because a watcher was too slow.").Add({});
  struct JobCount {
    std::size_t waiting = 0;
    std::size_t running = 0;
  };
  Mutex mutex;
  std::map<std::int64_t, double> speeds CELLCRUSH_GUARDED_BY(mutex);  ///< by job
  std::map<std::string, JobCount> jobs CELLCRUSH_GUARDED_BY(mutex);   ///< by executor
  std::optional<prometheus::Exposer> exposer;
};

Metrics::Metrics() : impl_(std::make_unique<Impl>()) {}

Metrics::~Metrics() = default;

ListenAddress Metrics::serve(const ListenAddress& address) {
  ListenAddress bound = address;
  try {
    impl_->exposer.emplace(http_options(address));
    bound.port = impl_->exposer->GetListeningPorts().front();
  } catch (const std::exception&) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       "Cannot serve metrics on " + address.text() +
                           ": the address is in use or not permitted. Give another address with --metrics.");
  }
  impl_->exposer->RegisterCollectable(impl_->registry);
  impl_->exposer->RegisterCollectable(impl_->measured);
  return bound;
}

void Metrics::set_jobs(const std::string& executor, std::size_t waiting, std::size_t running) {
  const MutexLock lock(impl_->mutex);
  impl_->jobs[executor] = {waiting, running};
  std::size_t all_waiting = 0;
  std::size_t all_running = 0;
  for (const auto& [name, count] : impl_->jobs) {
    all_waiting += count.waiting;
    all_running += count.running;
  }
  impl_->waiting.Set(static_cast<double>(all_waiting));
  impl_->running.Set(static_cast<double>(all_running));
}

void Metrics::set_journal_damaged(bool damaged) { impl_->journal_damaged.Set(damaged ? 1.0 : 0.0); }

void Metrics::set_holds(const std::set<Shortage>& holds) { impl_->set_holds(holds); }

void Metrics::set_speed(std::int64_t job, double steps_per_second) {
  const MutexLock lock(impl_->mutex);
  if (steps_per_second > 0.0) {
    impl_->speeds[job] = steps_per_second;
  } else {
    impl_->speeds.erase(job);
  }
  double all = 0.0;
  for (const auto& [running, speed] : impl_->speeds) all += speed;
  impl_->speed.Set(all);
}

void Metrics::observe_commit(double seconds) { impl_->commits.Observe(seconds); }

void Metrics::observe_event(double seconds) { impl_->events.Observe(seconds); }

void Metrics::count_watcher(int change) { impl_->watchers.Increment(change); }

void Metrics::set_connections(std::size_t open) { impl_->connections.Set(static_cast<double>(open)); }

void Metrics::count_refused_connection() { impl_->refused.Increment(); }

void Metrics::count_skipped_frames(int frames) { impl_->skipped.Increment(frames); }

void Metrics::ask(std::function<Standing()> standing) { impl_->measured->ask(std::move(standing)); }

void Metrics::observe_run(double seconds, double predicted_seconds) {
  impl_->run_seconds.Increment(seconds);
  impl_->forecast_seconds.Increment(predicted_seconds);
  impl_->forecast_ratios.Observe(predicted_seconds / seconds);
}

void Metrics::count_call(const std::string& method, const std::string& code, std::optional<double> seconds) {
  impl_->calls.Add({{"method", method}, {"code", code}}).Increment();
  if (seconds) impl_->call_times.Add({{"method", method}}, times()).Observe(*seconds);
}

void Metrics::set_device(const std::string& device) {
  gauges(*impl_->registry, "cellcrush_device_info", "1; the label names the device of this machine's runs.")
      .Add({{"device", device}})
      .Set(1.0);
  for (const bool advanced : {true, false}) impl_->device_runs(advanced);
}

void Metrics::count_device_run(bool advanced) { impl_->device_runs(advanced).Increment(); }

void Metrics::count_notices(const std::string& target, Notice result, int count) {
  impl_->notices.Add({{"target", target}, {"result", kNoticeResults.at(static_cast<std::size_t>(result))}})
      .Increment(count);
}

void Metrics::count_ended(v1::Job::State state, v1::Job::Cause cause, const v1::Summary* summary) {
  impl_->ended.Add({{"state", v1::Job::State_Name(state)}}).Increment();
  if (state == v1::Job::FAILED) impl_->failure(cause).Increment();
  if (summary == nullptr) return;
  impl_->steps.Increment(static_cast<double>(summary->step_count()));
  impl_->add_stages(summary->stage_times());
}

}  // namespace cellcrush::metrics
