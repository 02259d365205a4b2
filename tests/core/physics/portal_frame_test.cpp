#include "scenes/portal_frame.h"

#include <gtest/gtest.h>

#include "scenes/evidence.h"
#include "scenes/run_frame.h"

namespace cellcrush {
namespace {

using scenes::PortalFrame;

constexpr int kElements = 12;

TEST(PortalFrame, UnderALightVerticalLoadCollapsesBySway) {
  const double load = scenes::expect_portal_collapse(scenes::run_frame(PortalFrame::swayed(2.0, 0.8, kElements)),
                                                     PortalFrame::Mechanism::sway, 2.0);
  scenes::record_figure("sway", load, 4);
}

TEST(PortalFrame, UnderAHeavyVerticalLoadCollapsesByTheCombinedMechanism) {
  const double load = scenes::expect_portal_collapse(scenes::run_frame(PortalFrame::swayed(6.0, 1.0, kElements)),
                                                     PortalFrame::Mechanism::combined, 6.0);
  scenes::record_figure("combined", load, 3);
}

TEST(PortalFrame, UnderALightHorizontalLoadCollapsesByItsBeam) {
  const double load = scenes::expect_portal_collapse(scenes::run_frame(PortalFrame::sagged(1.0, 0.8, kElements)),
                                                     PortalFrame::Mechanism::beam, 1.0);
  scenes::record_figure("beam", load, 3);
}

}  // namespace
}  // namespace cellcrush
