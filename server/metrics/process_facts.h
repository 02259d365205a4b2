#pragma once

#include <prometheus/metric_family.h>

#include <vector>

namespace cellcrush::metrics {

/// A family with one metric. `name`, `help`: of the format.
prometheus::MetricFamily gauge_family(const char* name, const char* help, double value);
prometheus::MetricFamily counter_family(const char* name, const char* help, double value);

/// The metrics of this process that all Prometheus clients have: process_cpu_seconds_total and so on, without those of
/// its workers. Leaves out what /proc does not tell.
std::vector<prometheus::MetricFamily> process_families();

}  // namespace cellcrush::metrics
