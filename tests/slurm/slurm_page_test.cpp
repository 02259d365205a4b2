// A researcher who types what the pages about clusters show sees what they show.
#include <gtest/gtest.h>

#include <cstdlib>

#include "docs/session.h"
#include "slurm/slurm_cluster.h"

namespace cellcrush::docs {
namespace {

using testing::SlurmCluster;

TEST(JobArrayPage, EveryCommandDoesWhatThePageShows) {
  if (!testing::slurm_is_installed()) GTEST_SKIP() << testing::kSlurmIsMissing;
  const SlurmCluster cluster;
  setenv("SLURM_CONF", cluster.config().c_str(), 1);
  expect_shown("deploy/slurm/job-array.md");
  unsetenv("SLURM_CONF");
}

TEST(ExecutorPage, EveryCommandDoesWhatThePageShows) {
  if (!testing::slurm_is_installed()) GTEST_SKIP() << testing::kSlurmIsMissing;
  const SlurmCluster cluster;
  const testing::TemporaryFolder data;
  setenv("SLURM_CONF", cluster.config().c_str(), 1);
  setenv("SHARED", cluster.shared_folder().c_str(), 1);
  setenv("DATA", data.path().c_str(), 1);
  expect_shown("deploy/slurm/executor.md");
  for (const char* name : {"SLURM_CONF", "SHARED", "DATA"}) unsetenv(name);
}

}  // namespace
}  // namespace cellcrush::docs
