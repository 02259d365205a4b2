#pragma once

// Operations without an order on numbers that several threads of a device write.

#ifndef __CUDACC__
#include <atomic>
#endif
#include <bit>
#include <cstdint>

#include "simd/lane-inl.h"

namespace cellcrush::HWY_NAMESPACE {

/// Adds and returns the number before.
HWY_INLINE int add_at(int& number, int added) {
#ifdef __CUDA_ARCH__
  return atomicAdd(&number, added);
#else
  return std::atomic_ref(number).fetch_add(added, std::memory_order_relaxed);
#endif
}

/// Replaces and returns the number before.
HWY_INLINE int exchange_at(int& number, int by) {
#ifdef __CUDA_ARCH__
  return atomicExch(&number, by);
#else
  return std::atomic_ref(number).exchange(by, std::memory_order_relaxed);
#endif
}

HWY_INLINE void or_at(unsigned& bits, unsigned added) {
#ifdef __CUDA_ARCH__
  atomicOr(&bits, added);
#else
  std::atomic_ref(bits).fetch_or(added, std::memory_order_relaxed);
#endif
}

/// Of numbers that are not negative, the bits have the order of the numbers. One that is not a number is the greatest.
HWY_INLINE void raise_at(std::uint64_t& greatest, double number) {
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(number);
#ifdef __CUDA_ARCH__
  atomicMax(reinterpret_cast<unsigned long long*>(&greatest), static_cast<unsigned long long>(bits));
#else
  std::atomic_ref most(greatest);
  for (std::uint64_t before = most.load(std::memory_order_relaxed);
       bits > before && !most.compare_exchange_weak(before, bits, std::memory_order_relaxed);) {
  }
#endif
}

}  // namespace cellcrush::HWY_NAMESPACE
