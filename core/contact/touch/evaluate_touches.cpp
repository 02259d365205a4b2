#include "contact/touch/contact_stages.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/touch/evaluate_touches.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "contact/search/candidate_lists.h"
#include "contact/touch/evaluate_touches-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

std::size_t evaluate_all(const Scene& scene, const State& state, ContactLists& lists, Touches& touches,
                         std::size_t first, std::size_t end, int* released) {
  using Wide = WideTag<double, 8>;
  using One = hn::CappedTag<double, 1>;
  const PairArrays arrays = {scene, state, lists, touches};
  std::size_t released_count = 0;
  std::size_t i = first;
  for (; i + Lane<Wide>::kWidth <= end; i += Lane<Wide>::kWidth) {
    released_count += write_set_lanes(evaluate_pairs<Wide>(arrays, i), i, released + released_count);
  }
  for (; i < end; ++i) {
    released_count += write_set_lanes(evaluate_pairs<One>(arrays, i), i, released + released_count);
  }
  return released_count;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(evaluate_all);

void evaluate_touches(const Scene& scene, const State& state, ContactLists& lists, Touches& touches, std::size_t first,
                      std::size_t end, std::vector<int>& released) {
  resize_with_room(released, end - first);
  released.resize(HWY_DYNAMIC_DISPATCH(evaluate_all)(scene, state, lists, touches, first, end, released.data()));
}

}  // namespace cellcrush
#endif
