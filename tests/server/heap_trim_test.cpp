#include <gtest/gtest.h>

#include "net/connection_limits.h"

namespace cellcrush::net {
namespace {

TEST(HeapTrim, GivesMemoryBackOnceWhenHalfOfAFloodHasGone) {
  HeapTrim heap;
  EXPECT_FALSE(heap.note(1000));
  EXPECT_FALSE(heap.note(600));
  EXPECT_TRUE(heap.note(400));
  EXPECT_FALSE(heap.note(300)) << "a second time only when half of what is left has gone";
  EXPECT_TRUE(heap.note(100));
}

TEST(HeapTrim, LeavesAFewConnectionsAlone) {
  HeapTrim heap;
  EXPECT_FALSE(heap.note(90));
  EXPECT_FALSE(heap.note(0));
}

}  // namespace
}  // namespace cellcrush::net
