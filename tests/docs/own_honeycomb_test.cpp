// A reader who saves the case of the tutorial and types what it shows sees what it shows.
#include <gtest/gtest.h>

#include "docs/session.h"

namespace cellcrush::docs {
namespace {

TEST(OwnHoneycomb, EveryCommandDoesWhatThePageShows) {
  expect_shown("client-cli/own-honeycomb.md", Reader::caller, {}, {{"foil.txtpb", "textproto"}});
}

}  // namespace
}  // namespace cellcrush::docs
