#include "worker/job_scene.h"

#include <stdexcept>

#include "cellcrush/simulation.h"
#include "translate/case_to_spec.h"

namespace cellcrush::worker {

std::shared_ptr<const Scene> scene_of(const Order& order) {
  const auto reading = translate::to_spec(order.case_());
  auto built = build_scene(reading.spec);
  Problems problems = reading.problems;
  problems.insert(problems.end(), built.problems.begin(), built.problems.end());
  // The daemon has checked the case, so this is an old job that the present version rejects.
  if (!problems.empty()) {
    throw std::runtime_error("this version no longer accepts the case: " + problems.front().field + ": " +
                             problems.front().message);
  }
  return built.scene;
}

}  // namespace cellcrush::worker
