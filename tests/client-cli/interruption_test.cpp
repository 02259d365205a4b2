#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "connection/streams.h"

namespace cellcrush::client {
namespace {

using namespace std::chrono_literals;

TEST(Interruption, TakesASignalThatArrivesTwiceAtOnceAsOneRequest) {
  const Interruption interruption;
  EXPECT_FALSE(interruption.requested());
  raise(SIGTERM);
  raise(SIGTERM);  // as `timeout` sends it: to its command and to the command's group
  raise(SIGINT);
  EXPECT_TRUE(interruption.requested());
}

TEST(InterruptionDeathTest, EndsTheProgramAtALaterSignal) {
  EXPECT_EXIT(
      {
        const Interruption interruption;
        raise(SIGTERM);
        std::this_thread::sleep_for(600ms);
        raise(SIGTERM);
      },
      ::testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace cellcrush::client
