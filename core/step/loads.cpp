#include "step/loads.h"

#include <algorithm>

namespace cellcrush {

void evaluate_loads(const Scene& scene, State& state) {
  if (scene.loads.empty()) {
    return;
  }
  std::fill(state.load_force.begin(), state.load_force.end(), Vector2::Zero());
  std::fill(state.load_moment.begin(), state.load_moment.end(), 0.0);
  for (const NodalLoad& load : scene.loads) {
    const double value = load.value_at(state.time);
    switch (load.component) {
      case NodalLoad::Component::x: state.load_force[load.node].x() += value; break;
      case NodalLoad::Component::y: state.load_force[load.node].y() += value; break;
      case NodalLoad::Component::rotation: state.load_moment[load.node] += value; break;
    }
  }
}

}  // namespace cellcrush
