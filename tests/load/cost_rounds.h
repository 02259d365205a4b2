#pragma once

#include <map>
#include <string>
#include <vector>

namespace cellcrush::load {

/// What each round has measured, by the name of the figure (deploy/scale/figures.csv).
using Rounds = std::map<std::string, std::vector<double>>;

/// Adds a round of the journal's costs: commits of one change each, of a thousand changes, and of many samples.
void measure_journal(Rounds& rounds);

/// Adds a round of the costs of jobs that run one after the other, with few and with many samples: the costs of a
/// sample are the difference. Runs twice that many jobs. Throws std::runtime_error if one fails.
void measure_runs(int jobs, Rounds& rounds);

/// Adds a round of the costs of following a job, of watchers and of waiting jobs. Throws std::runtime_error if the
/// daemon does not start.
void measure_daemon(Rounds& rounds);

std::map<std::string, double> medians_of(const Rounds& rounds);

}  // namespace cellcrush::load
