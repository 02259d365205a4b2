#include "touch/contact_workspace.h"

namespace cellcrush {

void Touches::resize(std::size_t count) {
  start.resize(count);
  end.resize(count);
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
