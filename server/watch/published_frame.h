#pragma once

#include <memory>
#include <mutex>
#include <utility>

#include "cellcrush/v1/sample.pb.h"
#include "watch/packed_frame.h"

namespace cellcrush::watch {

/// A frame that any number of watchers read, as numbers or packed. It is packed once, by the first who asks.
/// Thread-safe.
class PublishedFrame {
 public:
  /// `mesh` has the positions before loading; null: packed displacements are positions.
  PublishedFrame(v1::FieldFrame frame, std::shared_ptr<const v1::Mesh> mesh)
      : numbers_(std::move(frame)), mesh_(std::move(mesh)) {}

  [[nodiscard]] int index() const { return numbers_.index(); }
  [[nodiscard]] const v1::FieldFrame& in(v1::FieldFrame::Encoding encoding) const {
    if (encoding != v1::FieldFrame::PACKED) return numbers_;
    std::call_once(once_, [this] { packed_ = pack(numbers_, mesh_.get()); });
    return packed_;
  }

 private:
  v1::FieldFrame numbers_;
  std::shared_ptr<const v1::Mesh> mesh_;
  mutable std::once_flag once_;
  mutable v1::FieldFrame packed_;
};

}  // namespace cellcrush::watch
