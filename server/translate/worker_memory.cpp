#include "translate/worker_memory.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace cellcrush::translate {
namespace {

// Measured bytes: of the program with its libraries; of mesh, frames and buffers for each element; of a sample; of a
// node or beam of a frame, in the case as it came, as it is computed and as it is stored.
constexpr double kOfProgram = 30e6;
constexpr double kOfOutput = 60.0;
constexpr double kOfSample = 500.0;
constexpr double kOfListed = 450.0;

// Beside the prediction.
constexpr double kMargin = 1.25;
constexpr double kRoom = 64.0 * 1024 * 1024;
constexpr double kOfThread = 9.0 * 1024 * 1024;

std::size_t listed_in(const SceneSpec& spec) {
  if (const auto* network = std::get_if<NetworkWalls>(&spec.lattice)) {
    return network->joint_count() + network->wall_count();
  }
  const auto* frame = std::get_if<FrameWalls>(&spec.lattice);
  return frame == nullptr ? 0 : frame->nodes.size() + frame->beams.size();
}

}  // namespace

std::int64_t memory_of_worker(const SceneSpec& spec, const WorkerSize& size) {
  return std::llround(kOfProgram + static_cast<double>(size.run_bytes) +
                      kOfOutput * static_cast<double>(size.elements) + kOfSample * static_cast<double>(size.samples) +
                      kOfListed * static_cast<double>(listed_in(spec)));
}

std::int64_t memory_limit(std::int64_t predicted, int threads, double factor, std::int64_t most) {
  const double first = kMargin * static_cast<double>(predicted) + kRoom + kOfThread * threads;
  const double bound = most > 0 ? std::max(first, static_cast<double>(most)) : factor * first;
  return std::llround(std::min(factor * first, bound));
}

}  // namespace cellcrush::translate
