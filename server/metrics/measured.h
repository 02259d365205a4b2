#pragma once

#include <prometheus/collectable.h>
#include <prometheus/metric_family.h>

#include <functional>
#include <vector>

#include "metrics/metrics.h"
#include "mutex.h"

namespace cellcrush::metrics {

/// The metrics that are read when they are asked for: process_cpu_seconds_total and so on, of the daemon without its
/// workers, counts of the process that began before there were metrics, and the standing of the daemon. Thread-safe.
class Measured final : public prometheus::Collectable {
 public:
  /// As Metrics::ask.
  void ask(std::function<Standing()> standing);

  [[nodiscard]] std::vector<prometheus::MetricFamily> Collect() const override;

 private:
  mutable Mutex mutex_;
  std::function<Standing()> standing_ CELLCRUSH_GUARDED_BY(mutex_);
};

}  // namespace cellcrush::metrics
