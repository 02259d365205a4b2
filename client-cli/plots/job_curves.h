#pragma once

#include <string>
#include <vector>

#include "cellcrush/v1/job.pb.h"
#include "cellcrush/v1/jobs_service.pb.h"
#include "cellcrush/v1/sample.pb.h"
#include "chart/chart.h"

namespace cellcrush::client {

/// A job with its samples.
struct JobHistory {
  v1::Job job;
  std::vector<v1::Sample> samples;
};

/// Stress at both plates against strain, smoothed over 2 % strain, with the samples as thin lines behind, the plateau
/// stresses over their window, theory, and marks at densification and at warnings that put the result in doubt.
Chart build_job_chart(const JobHistory& history);

/// Tests that are laid over the curves of jobs: their mean, and the band of several.
struct TestOverlay {
  std::string name;  ///< empty: no test
  std::vector<double> x{};
  std::vector<double> mean{};
  std::vector<double> least{};  ///< empty for one test
  std::vector<double> most{};
};

/// The smoothed curves of several jobs, one colour per job: impact plate solid, support plate dashed. A test is black.
Chart build_comparison_chart(const std::vector<JobHistory>& histories, const TestOverlay& test = {});

/// Forces of jobs over a displacement in mm, without smoothing. A test is black.
Chart build_force_chart(const std::vector<v1::Job>& jobs, const std::vector<v1::CompareTestResponse>& forces,
                        const TestOverlay& test);

/// A job's label in a picture: its title, or else its name, and its speed.
std::string picture_name(const v1::Job& job);

/// The energy ledger of a crush against strain: the work of the plates, and one line for each way it was used.
/// Terms that stay 0 are omitted, except the residual.
Chart build_energy_chart(const JobHistory& history);

/// An explicit frame over time: displacements of its watched nodes, or their rotations if none moved; energies if it
/// watches no nodes.
Chart build_node_chart(const JobHistory& history);

}  // namespace cellcrush::client
