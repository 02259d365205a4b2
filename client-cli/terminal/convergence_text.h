#pragma once

#include <string>

#include "cellcrush/v1/sweep.pb.h"

namespace cellcrush::client {

/// The estimates of each quantity by mesh, what the errors are, and the mesh that meets the wanted error.
std::string convergence_text(const v1::Convergence& convergence, int width);

}  // namespace cellcrush::client
