#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cellcrush {

// The kernels exist as plain text, "scalar", which is the reference, and for the vector instructions of processors: on
// x86-64 "sse4", "avx2" and "avx512". The choice is the process's; without one it is the best that the processor has.

/// Names of the kernels that this processor can run, the best first; the last is "scalar".
std::vector<std::string> simd_targets();

/// The one in use.
std::string simd_target();

/// Makes a kernel the one in use; "" is the best. Returns whether simd_targets() has it; if not, nothing changes. Not to be
/// called while a simulation advances.
bool use_simd_target(std::string_view name);

}  // namespace cellcrush
