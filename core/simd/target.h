#pragma once

namespace cellcrush {

/// Whether vector kernels are to be used; else the plain ones are.
bool use_wide_kernels();

}  // namespace cellcrush
