#pragma once

#include <algorithm>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "touch/contact_workspace.h"

namespace cellcrush {

/// Records the greatest depths of touches, each divided by the thickness of the thinner wall.
class DepthRecords {
 public:
  DepthRecords(const Scene& scene, const TouchMemory& touching, const Touches& touches, ContactTotals& totals)
      : scene_(scene),
        touching_(touching),
        totals_(totals),
        depth_(touches.depth.data()),
        known_(touches.known.data()) {
    set_bars();
  }

  /// The bars reject most touches before the thicknesses of their walls are loaded.
  void note(int touch) {
    const bool is_new = known_[touch] == Touches::kNew;
    if (depth_[touch] > (is_new ? birth_bar_ : penetration_bar_)) {
      raise(touch, is_new);
    }
  }

 private:
  void raise(int touch, bool is_new) {
    const double thinner =
        std::min(2.0 * scene_.radius[touching_.ball[touch]], scene_.elements[touching_.segment[touch]].thickness);
    const double depth = depth_[touch] / thinner;
    totals_.deepest_penetration = std::max(totals_.deepest_penetration, depth);
    if (is_new) {
      totals_.deepest_birth = std::max(totals_.deepest_birth, depth);
    }
    set_bars();
  }

  void set_bars() {
    birth_bar_ = scene_.contact.thinnest * totals_.deepest_birth;
    penetration_bar_ = scene_.contact.thinnest * totals_.deepest_penetration;
  }

  const Scene& scene_;
  const TouchMemory& touching_;
  ContactTotals& totals_;
  const double* const depth_;
  const int* const known_;
  double birth_bar_ = 0.0;        ///< mm, depth that a touch must exceed in its first step
  double penetration_bar_ = 0.0;  ///< mm, the same in a later step
};

}  // namespace cellcrush
