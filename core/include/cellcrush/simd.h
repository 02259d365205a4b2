#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cellcrush {

// The kernels are compiled from one source for the vector instructions of several processors. On x86-64 these are
// "avx2", "avx512", and "scalar", which computes one number at a time. The choice holds for the whole process; by
// default it is the best kernel that the processor can run. Kernels that fuse multiplication and addition, like avx2
// and avx512, give the same bits.

/// Names of the kernels that this processor can run, best first; the last is "scalar".
std::vector<std::string> simd_targets();

/// Name of the kernel in use.
std::string simd_target();

/// Selects a kernel; "" selects the best one. Returns false, and changes nothing, if simd_targets() does not list it.
/// Must not be called while a simulation advances.
bool use_simd_target(std::string_view name);

}  // namespace cellcrush
