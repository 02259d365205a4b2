#include "touch/contact_workspace.h"

#include "search/list_room.h"

namespace cellcrush {

void Touches::resize(std::size_t count) {
  resize_with_room(start, count);
  resize_with_room(end, count);
  resize_with_room(known, count);
  resize_with_room(share, count);
  resize_with_room(depth, count);
  resize_with_room(normal, count);
  resize_with_room(viscous, count);
  resize_with_room(slip, count);
  resize_with_room(node, count);
  resize_with_room(node_depth, count);
  resize_with_room(node_normal, count);
}

}  // namespace cellcrush
