#include "rpc/stream_limits.h"

#include <gmock/gmock.h>

#include <optional>

#include "error.h"

namespace cellcrush::rpc {
namespace {

using ::testing::HasSubstr;

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const ServiceError& refused) {
    EXPECT_EQ(refused.kind(), ServiceError::Kind::exhausted);
    return refused.what();
  }
  return "";
}

TEST(StreamLimits, RefuseByNameBeyondEachLimitAndAdmitAgainWhenOneEnds) {
  StreamLimits limits({3, 2, 1000});
  std::optional<StreamLimits::Permit> first(limits.admit("anna"));
  const auto second = limits.admit("anna");
  EXPECT_THAT(refusal([&] { limits.admit("anna"); }), HasSubstr("anna has 2 streams open"));
  const auto third = limits.admit("bob");
  EXPECT_THAT(refusal([&] { limits.admit("chief"); }), HasSubstr("3 streams are open, the limit of --max-streams"));
  first.reset();
  EXPECT_EQ(refusal([&] { limits.admit("anna"); }), "");
}

TEST(StreamLimits, BoundTheBytesThatNobodyHasRead) {
  StreamLimits limits({10, 10, 1000});
  auto first = limits.admit("anna");
  first.hold(5000);  // one alone may have its message
  auto second = limits.admit("anna");
  EXPECT_THAT(refusal([&] { second.hold(1); }), HasSubstr("--max-call-memory"));
  first.hold(900);
  EXPECT_EQ(refusal([&] { second.hold(100); }), "");
  EXPECT_THAT(refusal([&] { second.hold(101); }), HasSubstr("--max-call-memory"));
  EXPECT_EQ(refusal([&] { second.hold(100); }), "") << "What was refused is not counted.";
}

}  // namespace
}  // namespace cellcrush::rpc
