#pragma once

#include "cellcrush/stage.h"

namespace cellcrush {

/// Reports the stages of a step to an observer, if there is one.
class StageScope {
 public:
  explicit StageScope(StageObserver* observer) : observer_(observer) {}
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
