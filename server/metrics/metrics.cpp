#include "metrics/metrics.h"

#include <prometheus/counter.h>
#include <prometheus/exposer.h>
#include <prometheus/gauge.h>
#include <prometheus/registry.h>

#include <exception>
#include <optional>
#include <string>

#include "error.h"

namespace cellcrush::metrics {
namespace {

using Counters = prometheus::Family<prometheus::Counter>;

prometheus::Gauge& gauge(prometheus::Registry& registry, const char* name, const char* help) {
  return prometheus::BuildGauge().Name(name).Help(help).Register(registry).Add({});
}

Counters& counters(prometheus::Registry& registry, const char* name, const char* help) {
  return prometheus::BuildCounter().Name(name).Help(help).Register(registry);
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
  }

  void add_stages(const v1::StageTimes& times) {
    visit_stages(times, [this](const std::string& stage, double seconds) {
      stages.Add({{"stage", stage}}).Increment(seconds);
    });
  }

  std::shared_ptr<prometheus::Registry> registry = std::make_shared<prometheus::Registry>();
  prometheus::Gauge& waiting = gauge(*registry, "cellcrush_jobs_waiting", "Jobs that wait for a slot.");
  prometheus::Gauge& running = gauge(*registry, "cellcrush_jobs_running", "Jobs that run.");
  Counters& ended = counters(*registry, "cellcrush_jobs_ended_total", "Jobs that have ended, by state.");
  prometheus::Counter& steps =
      counters(*registry, "cellcrush_steps_total", "Time steps of jobs that have ended with a result.").Add({});
  Counters& stages =
      counters(*registry, "cellcrush_stage_seconds_total", "Processor time of those steps, by stage of a step.");
  std::optional<prometheus::Exposer> exposer;
};

Metrics::Metrics() : impl_(std::make_unique<Impl>()) {}

Metrics::~Metrics() = default;

ListenAddress Metrics::serve(const ListenAddress& address) {
  ListenAddress bound = address;
  try {
    impl_->exposer.emplace(address.place + ":" + std::to_string(address.port), 1);
    bound.port = impl_->exposer->GetListeningPorts().front();
  } catch (const std::exception&) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       "Cannot serve metrics on " + address.text() +
                           ": another program listens there, or it may not be used. Give another address with "
                           "--metrics.");
  }
  impl_->exposer->RegisterCollectable(impl_->registry);
  return bound;
}

void Metrics::set_jobs(std::size_t waiting, std::size_t running) {
  impl_->waiting.Set(static_cast<double>(waiting));
  impl_->running.Set(static_cast<double>(running));
}

void Metrics::count_ended(v1::JobState state, const v1::Summary* summary) {
  impl_->ended.Add({{"state", v1::JobState_Name(state)}}).Increment();
  if (summary == nullptr) return;
  impl_->steps.Increment(static_cast<double>(summary->step_count()));
  impl_->add_stages(summary->stage_times());
}

}  // namespace cellcrush::metrics
