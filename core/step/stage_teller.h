#pragma once

#include "cellcrush/stage.h"

namespace cellcrush {

/// Tells an observer, if there is one.
class StageTeller {
 public:
  explicit StageTeller(StageObserver* observer) : observer_(observer) {}
  void begin(Stage stage) const {
    if (observer_ != nullptr) {
      observer_->begin(stage);
    }
  }
  void end_step() const {
    if (observer_ != nullptr) {
      observer_->end_step();
    }
  }

 private:
  StageObserver* observer_;
};

}  // namespace cellcrush
