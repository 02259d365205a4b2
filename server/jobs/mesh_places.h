#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <vector>

#include "mutex.h"

namespace cellcrush::jobs {

/// Bounds the meshes that checks build at once, so that many calls do not take the daemon's memory: a few small ones of
/// some 25 MB at most, and one larger. The mesh of two million elements takes some 900 MB and two seconds. Thread-safe.
class MeshPlaces {
 public:
  class Place;

  static constexpr int kSmallMeshes = 16;               ///< at once
  static constexpr std::int64_t kMostOfSmall = 50'000;  ///< elements of a small mesh
  static constexpr std::chrono::seconds kPatience{10};

 private:
  /// Places of one kind.
  struct Line {
    int places;
    std::vector<const Place*> takers = {};  ///< in the order in which they came; the first of them have the places
  };

  Mutex mutex_;
  std::condition_variable_any changed_;
  Line small_ CELLCRUSH_GUARDED_BY(mutex_){kSmallMeshes};
  Line large_ CELLCRUSH_GUARDED_BY(mutex_){1};
};

/// The place of a mesh that is being built, given back when this goes away.
class MeshPlaces::Place {
 public:
  /// Waits for a place for a mesh of so many elements; of none there is nothing to wait for. Throws ServiceError:
  /// cancelled once `given_up`, asked several times a second, says that nobody waits any more, exhausted when no place
  /// is free within `patience`.
  Place(MeshPlaces& places, std::int64_t elements, const std::function<bool()>& given_up,
        std::chrono::seconds patience = kPatience);
  ~Place();
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

 private:
  [[nodiscard]] bool is_free() const;
  void leave();

  MeshPlaces& places_;
  Line* line_ = nullptr;  ///< null: of a mesh of no elements
};

}  // namespace cellcrush::jobs
