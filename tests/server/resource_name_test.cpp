#include "store/resource_name.h"

#include <gtest/gtest.h>

namespace cellcrush::store {
namespace {

TEST(ResourceName, IsReadBackAsItIsWritten) {
  EXPECT_EQ(name_of(12), "jobs/12");
  EXPECT_EQ(number_of("jobs/12"), 12);
  EXPECT_EQ(sweep_name_of(3), "sweeps/3");
  EXPECT_EQ(sweep_number_of("sweeps/3"), 3);
}

TEST(ResourceName, NothingElseIsAName) {
  for (const char* name : {"", "12", "jobs/", "jobs/0", "jobs/-1", "jobs/+1", "jobs/012", "jobs/1 ", "jobs/1/2",
                           "jobs/x", "jobs/99999999999999999999", "sweeps/1"})
    EXPECT_FALSE(number_of(name)) << name;
  EXPECT_FALSE(sweep_number_of("jobs/1"));
}

}  // namespace
}  // namespace cellcrush::store
