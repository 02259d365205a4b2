#include "cellcrush/simulation.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "measure/sampler.h"
#include "step/advance_step.h"
#include "step/check_run.h"

namespace cellcrush {

struct Simulation::Impl {
  explicit Impl(std::shared_ptr<const Scene> built)
      : scene(std::move(built)), state(make_initial_state(*scene)), sampler(*scene) {}

  std::shared_ptr<const Scene> scene;
  State state;
  Workspace workspace;
  Sampler sampler;
  RunStatus status;
};

Simulation::Simulation(std::shared_ptr<const Scene> scene) : impl_(std::make_unique<Impl>(std::move(scene))) {}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::advance(std::int64_t steps, StageObserver* observer) {
  const std::int64_t last = std::min(impl_->state.step + steps, impl_->scene->schedule.step_count);
  while (impl_->status.kind == RunStatus::Kind::running && impl_->state.step < last) {
    advance_step(*impl_->scene, impl_->state, impl_->workspace, observer);
  }
  if (impl_->status.kind == RunStatus::Kind::running && impl_->state.step >= impl_->scene->schedule.step_count) {
    impl_->status.kind = RunStatus::Kind::finished;
  }
}

Sample Simulation::take_sample() {
  const Sample sample = impl_->sampler.take(*impl_->scene, impl_->state);
  const RunStatus found = check_run(*impl_->scene, impl_->state, sample);
  if (found.kind != RunStatus::Kind::running) {
    impl_->status = found;
  }
  return sample;
}

FieldFrame Simulation::take_frame(int index) const { return make_frame(*impl_->scene, impl_->state, index); }

RunStatus Simulation::status() const { return impl_->status; }
std::int64_t Simulation::step() const { return impl_->state.step; }
double Simulation::time() const { return impl_->state.time; }
double Simulation::strain() const {
  return impl_->scene->length > 0.0 ? impl_->state.impact_travel / impl_->scene->length : 0.0;
}
const Scene& Simulation::scene() const { return *impl_->scene; }
const State& Simulation::state() const { return impl_->state; }

}  // namespace cellcrush
