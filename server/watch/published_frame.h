#pragma once

#include <memory>
#include <mutex>

#include "cellcrush/v1/sample.pb.h"

namespace cellcrush::watch {

/// A frame that any number of watchers read, as numbers or packed. It is packed once, by the first who asks.
/// Thread-safe.
class PublishedFrame {
 public:
  /// `mesh` has the positions before loading; null: packed displacements are positions.
  PublishedFrame(v1::FieldFrame frame, std::shared_ptr<const v1::Mesh> mesh);

  [[nodiscard]] int index() const { return numbers_.index(); }
  [[nodiscard]] const v1::FieldFrame& in(v1::FieldFrame::Encoding encoding) const;

 private:
  v1::FieldFrame numbers_;
  std::shared_ptr<const v1::Mesh> mesh_;
  mutable std::once_flag once_;
  mutable v1::FieldFrame packed_;
};

}  // namespace cellcrush::watch
