#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <vector>

#include "mutex.h"

namespace cellcrush::jobs {

/// Limits the meshes that checks build at once, so that many calls cannot exhaust the daemon's memory. Allows several
/// small meshes of about 25 MB at most, and one larger. A mesh of two million elements needs about 900 MB and two
/// seconds. Thread-safe.
class MeshPlaces {
 public:
  class Place;

  static constexpr int kSmallMeshes = 16;               ///< at once
  static constexpr std::int64_t kMostOfSmall = 50'000;  ///< elements of a small mesh
  static constexpr std::chrono::seconds kPatience{10};

 private:
  /// Places of one size class.
  struct Line {
    int places;
    std::vector<const Place*> takers = {};  ///< in order of arrival; the first ones hold the places
  };

  Mutex mutex_;
  std::condition_variable_any changed_;
  Line small_ CELLCRUSH_GUARDED_BY(mutex_){kSmallMeshes};
  Line large_ CELLCRUSH_GUARDED_BY(mutex_){1};
};

/// The place of a mesh under construction, released on destruction.
class MeshPlaces::Place {
 public:
  /// Waits for a place for a mesh of this many elements; returns at once for none. Throws ServiceError: cancelled once
  /// `given_up`, polled several times a second, returns true; exhausted if no place is free within `patience`.
  Place(MeshPlaces& places, std::int64_t elements, const std::function<bool()>& given_up,
        std::chrono::milliseconds patience = kPatience);
  ~Place();
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

 private:
  [[nodiscard]] bool is_free() const;
  void leave();

  MeshPlaces& places_;
  Line* line_ = nullptr;  ///< null for a mesh without elements
};

}  // namespace cellcrush::jobs
