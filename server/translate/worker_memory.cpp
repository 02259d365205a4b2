#include "translate/worker_memory.h"

#include <algorithm>
#include <cmath>

namespace cellcrush::translate {
namespace {

// Measured bytes: of the program with its libraries; of mesh, frames and buffers for each element; of a sample.
constexpr double kOfProgram = 30e6;
constexpr double kOfOutput = 60.0;
constexpr double kOfSample = 500.0;

// Beside the prediction.
constexpr double kMargin = 1.25;
constexpr double kRoom = 64.0 * 1024 * 1024;
constexpr double kOfThread = 9.0 * 1024 * 1024;

}  // namespace

std::int64_t memory_of_worker(const WorkerSize& size) {
  return std::llround(kOfProgram + static_cast<double>(size.run_bytes) +
                      kOfOutput * static_cast<double>(size.elements) + kOfSample * static_cast<double>(size.samples));
}

std::int64_t memory_limit(std::int64_t predicted, int threads, double factor, std::int64_t most) {
  const double first = kMargin * static_cast<double>(predicted) + kRoom + kOfThread * threads;
  const double bound = most > 0 ? std::max(first, static_cast<double>(most)) : factor * first;
  return std::llround(std::min(factor * first, bound));
}

}  // namespace cellcrush::translate
