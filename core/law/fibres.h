#pragma once

#include <cstddef>

#include "cellcrush/state.h"

namespace cellcrush {

/// History of the fibres of an element: every `stride`-th value of the arrays in the state. MPa; plastic_strain is the
/// accumulated (effective) one, dimensionless. Null: the law does not keep it. Without plastic strain there is
/// one bit for each fibre that has yielded. T: double or float.
template <class T>
struct Fibres {
  T* __restrict stress;
  T* __restrict back_stress;
  T* __restrict plastic_strain;
  T* __restrict tangent;  ///< modulus over E of the last flow
  T* __restrict flow;     ///< plastic strain increment of the last flow, not below 0
  typename FibreHistory<T>::Bits* __restrict yielded;
  std::size_t stride = 1;
};

}  // namespace cellcrush
