// Included once for each target.
#if defined(CELLCRUSH_BEAM_CHUNK_SCRATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_BEAM_CHUNK_SCRATCH_INL_H_
#undef CELLCRUSH_BEAM_CHUNK_SCRATCH_INL_H_
#else
#define CELLCRUSH_BEAM_CHUNK_SCRATCH_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "beam/walls_workspace.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Strain increments of the elements of a row (E5), passed from the first loop over a chunk to the second.
template <class T>
struct RowStrains {
  T* membrane;
  T* bend_start;  ///< h theta_1 / l_m
  T* bend_end;
  T* modulus_share;
};

/// Sums over the stresses of the elements of a row (E7), passed from the second loop to the third.
template <class T>
struct RowSums {
  T* axial;
  T* moment_start;
  T* moment_end;
  T* plastic_work;
};

/// Values passed between the three loops over the elements of a chunk, in the precision of the fibres, kScratchKinds
/// per element. Row by row: values of one kind lie side by side, and the kinds of a row one after the other. The sums
/// overwrite the strains.
template <class T>
class ChunkScratch {
 public:
  ChunkScratch(T* values, std::ptrdiff_t first_element) : values_(values), first_(first_element) {}

  HWY_INLINE RowStrains<T> strains(std::ptrdiff_t row, int lane, int walls) const {
    T* const at = begin(row, lane);
    return {at, at + walls, at + 2 * walls, at + 3 * walls};
  }
  HWY_INLINE RowSums<T> sums(std::ptrdiff_t row, int lane, int walls) const {
    T* const at = begin(row, lane);
    return {at, at + walls, at + 2 * walls, at + 3 * walls};
  }

 private:
  HWY_INLINE T* begin(std::ptrdiff_t row, int lane) const {
    return values_ + static_cast<std::ptrdiff_t>(kScratchKinds) * (row - first_) + lane;
  }

  T* const values_;
  const std::ptrdiff_t first_;
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_CHUNK_SCRATCH_INL_H_
