#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cellcrush {

// The kernels are one text, compiled for the vector instructions of several processors: on x86-64 "sse4", "avx2" and
// "avx512", and for none, "scalar", which computes one number at a time. The choice is the process's; without one it is
// the best that the processor has. Where multiplication and addition are fused, as on avx2 and avx512, the bits are the
// same.

/// Names of the kernels that this processor can run, the best first; the last is "scalar".
std::vector<std::string> simd_targets();

/// The one in use.
std::string simd_target();

/// Makes a kernel the one in use; "" is the best. Returns whether simd_targets() has it; if not, nothing changes. Not
/// to be called while a simulation advances.
bool use_simd_target(std::string_view name);

}  // namespace cellcrush
