#include "contact/contact_workspace.h"

namespace cellcrush {

void AwakeCandidates::make_room(std::size_t most) {
  if (place.size() < most) {
    place.resize(most);
    ball.resize(most);
    segment.resize(most);
    reach.resize(most);
    travel.resize(most);
    alarm.resize(most);
  }
}

void Touches::resize(std::size_t count) {
  known.resize(count);
  share.resize(count);
  depth.resize(count);
  normal.resize(count);
  viscous.resize(count);
  slip.resize(count);
  node.resize(count);
  node_depth.resize(count);
  node_normal.resize(count);
}

}  // namespace cellcrush
