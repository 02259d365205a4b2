#include "watch/published_frame.h"

#include <utility>

#include "watch/packed_frame.h"

namespace cellcrush::watch {

PublishedFrame::PublishedFrame(v1::FieldFrame frame, std::shared_ptr<const v1::Mesh> mesh)
    : numbers_(std::move(frame)), mesh_(std::move(mesh)) {}

const v1::FieldFrame& PublishedFrame::in(v1::FieldFrame::Encoding encoding) const {
  if (encoding != v1::FieldFrame::PACKED) return numbers_;
  std::call_once(once_, [this] { packed_ = pack(numbers_, mesh_.get()); });
  return packed_;
}

}  // namespace cellcrush::watch
