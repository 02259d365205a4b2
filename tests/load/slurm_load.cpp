// Measures what Slurm itself needs, on a cluster of two nodes with one processor each on this machine: for the answer
// of sbatch, for each task of an array, and for squeue. Prints the median, lowest and greatest of some rounds.
// usage: slurm_load [ROUNDS]
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "slurm/slurm_cluster.h"

namespace {

using cellcrush::testing::SlurmCluster;
using Clock = std::chrono::steady_clock;

constexpr int kTasks = 40;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

double seconds_of(const SlurmCluster& cluster, const std::vector<std::string>& command) {
  const auto begin = Clock::now();
  const auto end = cluster.run(command, std::chrono::seconds(60));
  if (end.exit_code != 0) throw std::runtime_error(end.all());
  return seconds_since(begin);
}

void print(const char* what, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  fmt::print("{}: {:.3f} s ({:.3f} to {:.3f})\n", what, values[values.size() / 2], values.front(), values.back());
}

}  // namespace

int main(int count, char** words) {
  const int rounds = count > 1 ? std::max(1, std::atoi(words[1])) : 3;
  if (!cellcrush::testing::slurm_is_installed()) {
    fmt::print(stderr, "{}.\n", cellcrush::testing::kSlurmIsMissing);
    return 1;
  }
  try {
    std::vector<double> answers;
    std::vector<double> tasks;
    std::vector<double> lists;
    for (int i = 0; i < rounds; ++i) {
      const SlurmCluster cluster;
      const auto begin = Clock::now();
      answers.push_back(seconds_of(
          cluster, {"sbatch", "--array=1-" + std::to_string(kTasks), "--output=/dev/null", "--wrap", "true"}));
      lists.push_back(seconds_of(cluster, {"squeue", "--noheader", "--array", "--states=all"}));
      if (!cluster.wait_for({"squeue", "--noheader"}, "", std::chrono::minutes(5)))
        throw std::runtime_error("The array did not end. " + cluster.logs());
      tasks.push_back(seconds_since(begin) / kTasks);
    }
    print("sbatch answers after", answers);
    print("one task of an array of 40 on two processors", tasks);
    print("squeue of an array of 40", lists);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
