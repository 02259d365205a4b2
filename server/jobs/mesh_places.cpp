#include "jobs/mesh_places.h"

#include <malloc.h>

#include <algorithm>

#include "error.h"

namespace cellcrush::jobs {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{100};

}  // namespace

MeshPlaces::Place::Place(MeshPlaces& places, std::int64_t elements, const std::function<bool()>& given_up,
                         std::chrono::milliseconds patience)
    : places_(places) {
  if (elements == 0) return;
  MutexLock lock(places_.mutex_);
  line_ = elements > kMostOfSmall ? &places_.large_ : &places_.small_;
  line_->takers.push_back(this);
  lock.unlock();
  try {
    for (auto looks = patience / kBetweenLooks; looks > 0; --looks) {
      if (given_up()) throw ServiceError(ServiceError::Kind::cancelled, "The client cancelled the call.");
      lock.lock();
      if (places_.changed_.wait_for(lock, kBetweenLooks, [this] { return is_free(); })) return;
      lock.unlock();
    }
    throw ServiceError(ServiceError::Kind::exhausted,
                       "Other large cases are being checked, one at a time. Try again in a few seconds.");
  } catch (...) {
    leave();
    throw;
  }
}

MeshPlaces::Place::~Place() {
  if (line_ == nullptr) return;
  if (line_ == &places_.large_) malloc_trim(0);  // otherwise the thread's heap keeps the memory
  leave();
}

bool MeshPlaces::Place::is_free() const {
  const auto& takers = line_->takers;
  return std::find(takers.begin(), takers.end(), this) - takers.begin() < line_->places;
}

void MeshPlaces::Place::leave() {
  {
    const MutexLock lock(places_.mutex_);
    std::erase(line_->takers, this);
  }
  places_.changed_.notify_all();
}

}  // namespace cellcrush::jobs
