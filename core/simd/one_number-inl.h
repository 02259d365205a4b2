#pragma once

// The functions of Highway that the laws use, for a single number: on a device every thread computes one element,
// particle or pair, and the laws are those of the processor, in the same text. A source that defines
// CELLCRUSH_ON_DEVICE has these in place of Highway (simd/lane-inl.h). The operations are those of AVX2 and AVX-512,
// rounded alike, so a device gives their bits.

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#define HWY_NAMESPACE N_DEVICE
#define HWY_BEFORE_NAMESPACE() static_assert(true)
#define HWY_AFTER_NAMESPACE() static_assert(true)
#define HWY_SCALAR 1
#define HWY_TARGET HWY_SCALAR
#define HWY_AVX3 0
#define HWY_ATTR
#define HWY_RESTRICT __restrict
#define HWY_LIKELY(condition) (condition)
#define HWY_UNLIKELY(condition) (condition)
#ifdef __CUDACC__
#define HWY_INLINE __host__ __device__ __forceinline__
#define HWY_NOINLINE __host__ __device__ __noinline__
#else
#define HWY_INLINE inline __attribute__((always_inline))
#define HWY_NOINLINE __attribute__((noinline))
#endif

namespace hwy::HWY_NAMESPACE {

/// A tag of one number, and the number as a vector.
template <class T>
struct OneNumber {
  using Number = T;
};
template <class T>
struct Vec1 {
  T number;
};

template <class T>
using UnsignedOf = std::conditional_t<sizeof(T) == sizeof(std::uint64_t), std::uint64_t, std::uint32_t>;

template <class D>
using TFromD = typename D::Number;
template <class T, std::size_t>
using CappedTag = OneNumber<T>;
template <class T, class>
using Rebind = OneNumber<T>;
template <class D>
using RebindToUnsigned = OneNumber<UnsignedOf<TFromD<D>>>;
template <class D>
using Half = D;
template <class D>
using Vec = Vec1<TFromD<D>>;
template <class>
using Mask = bool;

template <class D>
HWY_INLINE constexpr std::size_t MaxLanes(D) {
  return 1;
}

#define CELLCRUSH_OF_ONE(NAME, RESULT, EXPRESSION) \
  template <class T>                               \
  HWY_INLINE RESULT NAME(Vec1<T> a) {              \
    return {EXPRESSION};                           \
  }
#define CELLCRUSH_OF_TWO(NAME, RESULT, EXPRESSION) \
  template <class T>                               \
  HWY_INLINE RESULT NAME(Vec1<T> a, Vec1<T> b) {   \
    return {EXPRESSION};                           \
  }
#define CELLCRUSH_OF_THREE(NAME, EXPRESSION)                 \
  template <class T>                                         \
  HWY_INLINE Vec1<T> NAME(Vec1<T> a, Vec1<T> b, Vec1<T> c) { \
    return {EXPRESSION};                                     \
  }

CELLCRUSH_OF_ONE(Neg, Vec1<T>, -a.number)
CELLCRUSH_OF_ONE(Abs, Vec1<T>, std::fabs(a.number))
CELLCRUSH_OF_ONE(Sqrt, Vec1<T>, std::sqrt(a.number))
CELLCRUSH_OF_ONE(GetLane, T, a.number)
CELLCRUSH_OF_TWO(Add, Vec1<T>, a.number + b.number)
CELLCRUSH_OF_TWO(Sub, Vec1<T>, a.number - b.number)
CELLCRUSH_OF_TWO(Mul, Vec1<T>, a.number* b.number)
CELLCRUSH_OF_TWO(Div, Vec1<T>, a.number / b.number)
// As on x86: the second where either is not a number.
CELLCRUSH_OF_TWO(Min, Vec1<T>, a.number < b.number ? a.number : b.number)
CELLCRUSH_OF_TWO(Max, Vec1<T>, a.number > b.number ? a.number : b.number)
CELLCRUSH_OF_TWO(Lt, bool, a.number < b.number)
CELLCRUSH_OF_TWO(Le, bool, a.number <= b.number)
CELLCRUSH_OF_TWO(Gt, bool, a.number > b.number)
CELLCRUSH_OF_TWO(Ge, bool, a.number >= b.number)
CELLCRUSH_OF_TWO(Eq, bool, a.number == b.number)
CELLCRUSH_OF_TWO(Ne, bool, a.number != b.number)
CELLCRUSH_OF_THREE(MulAdd, std::fma(a.number, b.number, c.number))
CELLCRUSH_OF_THREE(MulSub, std::fma(a.number, b.number, -c.number))
CELLCRUSH_OF_THREE(NegMulAdd, std::fma(-a.number, b.number, c.number))

#undef CELLCRUSH_OF_ONE
#undef CELLCRUSH_OF_TWO
#undef CELLCRUSH_OF_THREE

template <class D>
HWY_INLINE Vec<D> Set(D, TFromD<D> a) {
  return {a};
}
template <class D>
HWY_INLINE Vec<D> Zero(D) {
  return {TFromD<D>(0)};
}
template <class D>
HWY_INLINE Vec<D> LoadU(D, const TFromD<D>* from) {
  return {*from};
}
template <class D>
HWY_INLINE void StoreU(Vec<D> a, D, TFromD<D>* to) {
  *to = a.number;
}
template <class D, class From>
HWY_INLINE Vec<D> PromoteTo(D, Vec1<From> a) {
  return {static_cast<TFromD<D>>(a.number)};
}
template <class D, class From>
HWY_INLINE Vec<D> DemoteTo(D, Vec1<From> a) {
  return {static_cast<TFromD<D>>(a.number)};
}
template <class D, class From>
HWY_INLINE Vec<D> BitCast(D, Vec1<From> a) {
  return {std::bit_cast<TFromD<D>>(a.number)};
}
template <class D, class T>
HWY_INLINE Vec1<T> MinOfLanes(D, Vec1<T> a) {
  return a;
}
template <class D, class T>
HWY_INLINE Vec1<T> MaxOfLanes(D, Vec1<T> a) {
  return a;
}

template <class T>
HWY_INLINE UnsignedOf<T> bits_of_number(Vec1<T> a) {
  return std::bit_cast<UnsignedOf<T>>(a.number);
}
template <class T>
HWY_INLINE Vec1<T> And(Vec1<T> a, Vec1<T> b) {
  return {std::bit_cast<T>(bits_of_number(a) & bits_of_number(b))};
}
template <class T>
HWY_INLINE Vec1<T> Or(Vec1<T> a, Vec1<T> b) {
  return {std::bit_cast<T>(bits_of_number(a) | bits_of_number(b))};
}
template <class T>
HWY_INLINE Vec1<T> Xor(Vec1<T> a, Vec1<T> b) {
  return {std::bit_cast<T>(bits_of_number(a) ^ bits_of_number(b))};
}
template <class T>
HWY_INLINE Vec1<T> ShiftLeftSame(Vec1<T> a, int count) {
  return {a.number << count};
}
template <class T>
HWY_INLINE Vec1<T> ShiftRightSame(Vec1<T> a, int count) {
  return {a.number >> count};
}
template <class T>
HWY_INLINE bool TestBit(Vec1<T> a, Vec1<T> bit) {
  return (a.number & bit.number) != 0;
}

HWY_INLINE bool And(bool a, bool b) { return a && b; }
HWY_INLINE bool Or(bool a, bool b) { return a || b; }
HWY_INLINE bool Not(bool a) { return !a; }
template <class D>
HWY_INLINE bool AllTrue(D, bool a) {
  return a;
}
template <class D>
HWY_INLINE bool AllFalse(D, bool a) {
  return !a;
}
template <class D>
HWY_INLINE bool RebindMask(D, bool a) {
  return a;
}
template <class D>
HWY_INLINE void StoreMaskBits(D, bool a, std::uint8_t* to) {
  *to = a ? 1 : 0;
}
template <class T>
HWY_INLINE Vec1<T> IfThenElse(bool a, Vec1<T> yes, Vec1<T> no) {
  return a ? yes : no;
}
template <class T>
HWY_INLINE Vec1<T> IfThenElseZero(bool a, Vec1<T> yes) {
  return a ? yes : Vec1<T>{T(0)};
}

// Of several lanes only, so never called.
template <class D, class... Numbers>
void LoadInterleaved2(D, Numbers&&...);
template <class D, class... Numbers>
void LoadInterleaved4(D, Numbers&&...);
template <class... Arguments>
void StoreInterleaved2(Arguments&&...);

}  // namespace hwy::HWY_NAMESPACE
