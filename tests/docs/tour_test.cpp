// A reader who types what the tour shows sees what it shows.
#include <gtest/gtest.h>

#include "docs/session.h"

namespace cellcrush::docs {
namespace {

TEST(Tour, EveryCommandDoesWhatThePageShows) { expect_shown("client-cli/tour.md"); }

}  // namespace
}  // namespace cellcrush::docs
