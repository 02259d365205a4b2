#pragma once

#include <vector>

#include "cellcrush/v1/job.pb.h"
#include "cellcrush/v1/sample.pb.h"
#include "chart/chart.h"

namespace cellcrush::client {

/// A job with its samples.
struct JobHistory {
  v1::Job job;
  std::vector<v1::Sample> samples;
};

/// Stress at both plates against strain, smoothed over 2 % strain, with the samples behind it as thin lines, the
/// plateau levels over their window and theory's levels.
Chart build_job_chart(const JobHistory& history);

/// The smoothed curves of several jobs: the impact plate's solid, the support plate's dashed, a colour a job.
Chart build_comparison_chart(const std::vector<JobHistory>& histories);

/// What a job is called in a picture: its title, or its name when it has none, and its speed.
std::string picture_name(const v1::Job& job);

}  // namespace cellcrush::client
