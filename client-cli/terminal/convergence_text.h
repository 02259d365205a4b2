#pragma once

#include <string>

#include "cellcrush/v1/sweep.pb.h"

namespace cellcrush::client {

/// "1 run", "15 runs".
std::string run_count_text(int count);

/// The estimates of each quantity by mesh, what the errors are, and the mesh that meets the wanted error.
std::string convergence_text(const v1::Convergence& convergence, int width);

}  // namespace cellcrush::client
