// That the validator of watches sees what is wrong with one.
#include "server/watch_contract.h"

#include <gmock/gmock.h>

#include "programs/text_proto.h"

namespace cellcrush::testing {
namespace {

v1::JobEvent at(std::int64_t sequence, const std::string& text) {
  return with_text(from_text<v1::JobEvent>(text), "sequence: " + std::to_string(sequence));
}

v1::JobEvent snapshot_at(std::int64_t sequence) { return at(sequence, "snapshot { job { state: RUNNING } }"); }

v1::JobEvent state_at(std::int64_t sequence, v1::Job::State state) {
  return at(sequence, "state { state: " + v1::Job::State_Name(state) + " }");
}

v1::JobEvent sampled_at(std::int64_t sequence, std::int64_t step) {
  return at(sequence, "sample { step: " + std::to_string(step) + " }");
}

v1::JobEvent frame_at(std::int64_t sequence, int index, int skipped, int part = 0, int parts = 1) {
  return at(sequence, "frame { frame { index: " + std::to_string(index) + " } skipped: " + std::to_string(skipped) +
                          " part: " + std::to_string(part) + " part_count: " + std::to_string(parts) + " }");
}

// How many promises such a watch breaks.
std::size_t broken_by(const std::vector<v1::JobEvent>& events, const grpc::Status& status = grpc::Status::CANCELLED,
                      std::int64_t after = 0) {
  WatchContract contract(after);
  for (const auto& event : events) contract.see(event);
  contract.end(status);
  return contract.broken().size();
}

TEST(WatchContractTest, ASoundWatchBreaksNothing) {
  EXPECT_EQ(
      broken_by({snapshot_at(0), state_at(1, v1::Job::PENDING), state_at(2, v1::Job::RUNNING), frame_at(2, 0, 0),
                 sampled_at(3, 5), frame_at(3, 4, 3, 0, 2), frame_at(3, 4, 3, 1, 2), state_at(4, v1::Job::SUCCEEDED)},
                grpc::Status::OK),
      0U);
  EXPECT_EQ(broken_by({snapshot_at(7), sampled_at(8, 1)}, grpc::Status::CANCELLED, 7), 0U);
}

// A daemon that starts records that the job waits, and only its worker finds that the checkpoint is of another solver.
TEST(WatchContractTest, SamplesOfARunThatIsGivenUpMayBeMissing) {
  v1::JobEvent begun_again = state_at(9, v1::Job::PENDING);
  begun_again.mutable_state()->set_begun_again_sequence(9);
  EXPECT_EQ(broken_by({snapshot_at(3), state_at(7, v1::Job::PENDING), state_at(8, v1::Job::RUNNING), begun_again,
                       state_at(10, v1::Job::RUNNING), sampled_at(11, 0)},
                      grpc::Status::CANCELLED, 3),
            0U);
}

TEST(WatchContractTest, EveryPromiseThatIsBrokenIsSeen) {
  const auto pending = state_at(1, v1::Job::PENDING);
  EXPECT_GT(broken_by({pending}), 0U) << "no snapshot";
  EXPECT_GT(broken_by({snapshot_at(0), pending, snapshot_at(1)}), 0U) << "two snapshots";
  EXPECT_GT(broken_by({snapshot_at(1), pending}), 0U) << "a snapshot of another place";
  EXPECT_GT(broken_by({snapshot_at(0), pending, sampled_at(3, 1)}), 0U) << "an event is missing";
  EXPECT_GT(broken_by({snapshot_at(0), pending, state_at(3, v1::Job::RUNNING)}), 0U)
      << "and the job does not begin again";
  EXPECT_GT(broken_by({snapshot_at(0), pending, pending}), 0U) << "an event comes twice";
  EXPECT_GT(broken_by({snapshot_at(0), pending, sampled_at(2, 4), sampled_at(3, 4)}), 0U) << "a sample comes twice";
  EXPECT_GT(broken_by({snapshot_at(0), state_at(1, v1::Job::RUNNING)}), 0U) << "a wrong first state";
  EXPECT_GT(broken_by({snapshot_at(0), pending, state_at(2, v1::Job::SUCCEEDED)}), 0U) << "a state that cannot follow";
  EXPECT_GT(broken_by({snapshot_at(0), pending, state_at(2, v1::Job::CANCELLED), sampled_at(3, 1)}), 0U)
      << "more behind the end";
  EXPECT_GT(broken_by({snapshot_at(0), pending}, grpc::Status::OK), 0U) << "OK too early";
  EXPECT_GT(broken_by({snapshot_at(0), pending, frame_at(1, 3, 0), frame_at(1, 3, 0)}), 0U) << "a frame twice";
  EXPECT_GT(broken_by({snapshot_at(0), pending, frame_at(1, 0, 0), frame_at(1, 3, 0)}), 0U) << "frames not counted";
  EXPECT_GT(broken_by({snapshot_at(0), pending, frame_at(1, 0, 0, 0, 2), sampled_at(2, 1)}), 0U) << "half a frame";
}

}  // namespace
}  // namespace cellcrush::testing
