// Memory of a daemon that has checked a large sweep.
#include <gtest/gtest.h>

#include <iostream>

#include "faults/fault_fixture.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {
namespace {

class SweepMemoryTest : public FaultFixture {
 protected:
  // A sweep of a preset, checked but not queued.
  static void check(Client& client, int points) {
    auto request = sweep_of(client.preset("hexagon-small"), kSpeed, {});
    request.set_validate_only(true);
    auto& axis = *request.mutable_sweep()->mutable_axes(0);
    axis.mutable_linear()->set_first(50.0);
    axis.mutable_linear()->set_last(150.0);
    axis.mutable_linear()->set_count(points);
    create(client, request);
  }
};

// Without being returned, the cases of 50,000 points would stay as some 370 MB. The C library keeps up to 64 MB at the
// end of the heap of each thread that has checked some.
TEST_F(SweepMemoryTest, TheCasesOfALargeSweepAreReturnedToTheSystem) {
  start_daemon();
  auto client = this->client();
  check(client, 100);
  const std::size_t before = daemon_->resident_bytes();
  const int points = rounds(50'000, 100'000);
  check(client, points);
  const std::size_t after = daemon_->resident_bytes();
  std::cout << points << " points: " << before / 1'000'000 << " MB before, " << after / 1'000'000 << " MB after\n";
  EXPECT_LT(after, before + 230'000'000);
}

}  // namespace
}  // namespace cellcrush::testing
