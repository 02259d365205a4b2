#include "scenes/portal_frame.h"

#include <gtest/gtest.h>

#include "scenes/run_frame.h"

namespace cellcrush {
namespace {

using scenes::PortalFrame;

constexpr int kElements = 12;

TEST(PortalFrame, UnderALightVerticalLoadCollapsesBySway) {
  scenes::expect_portal_collapse(scenes::run_frame(PortalFrame::swayed(2.0, 0.8, kElements)),
                                 PortalFrame::Mechanism::sway, 2.0);
}

TEST(PortalFrame, UnderAHeavyVerticalLoadCollapsesByTheCombinedMechanism) {
  scenes::expect_portal_collapse(scenes::run_frame(PortalFrame::swayed(6.0, 1.0, kElements)),
                                 PortalFrame::Mechanism::combined, 6.0);
}

TEST(PortalFrame, UnderALightHorizontalLoadCollapsesByItsBeam) {
  scenes::expect_portal_collapse(scenes::run_frame(PortalFrame::sagged(1.0, 0.8, kElements)),
                                 PortalFrame::Mechanism::beam, 1.0);
}

}  // namespace
}  // namespace cellcrush
