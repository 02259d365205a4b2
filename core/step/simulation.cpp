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
#include "step/rest_watch.h"

namespace cellcrush {

struct Simulation::Impl {
  Impl(std::shared_ptr<const Scene> built, int threads)
      : scene(std::move(built)), state(make_initial_state(*scene)), workspace(threads), sampler(*scene) {
    make_frame(*scene, state, 0, last_good);
  }

  void keep_frame() {
    if (kFramesKept * (state.step - last_good_step) >= scene->schedule.step_count) {
      make_frame(*scene, state, 0, last_good);
      last_good_step = state.step;
    }
  }

  /// Advances to a step, or to rest.
  void advance_to(std::int64_t end, StageObserver* observer) {
    const std::int64_t interval = scene->schedule.end_at_rest > 0.0 ? RestWatch::interval(scene->schedule) : end;
    while (state.step < end && !rest.is_at_rest()) {
      const std::int64_t next = std::min(end, (state.step / interval + 1) * interval);
      advance_steps(*scene, state, workspace, next - state.step, observer);
      if (scene->schedule.end_at_rest > 0.0 && state.step % interval == 0) {
        rest.look(*scene, state);
      }
    }
  }

  [[nodiscard]] bool has_ended() const { return state.step >= scene->schedule.step_count || rest.is_at_rest(); }

  /// Frames kept over a run in case it fails: often enough to see it come, seldom enough to take less than a hundredth
  /// of the time.
  static constexpr std::int64_t kFramesKept = 100;

  std::shared_ptr<const Scene> scene;
  State state;
  Workspace workspace;
  Sampler sampler;
  RestWatch rest;
  RunStatus status;
  FieldFrame last_good;
  std::int64_t last_good_step = 0;
};

namespace {

// Changes with what follows it in a checkpoint.
constexpr std::uint64_t kCheckpointFormat = 0x63656C6C63720006;

/// Whether the states are of equal scenes, so far as their lists tell.
bool fit(const State& one, const State& other) {
  return one.position.size() == other.position.size() && one.rotation.size() == other.rotation.size() &&
         one.rigid_centre.size() == other.rigid_centre.size() && one.length.size() == other.length.size() &&
         one.fibres.stress.size() == other.fibres.stress.size() &&
         one.single_fibres.stress.size() == other.single_fibres.stress.size() &&
         one.wall_force.size() == other.wall_force.size() && one.contact_force.size() == other.contact_force.size();
}

}  // namespace

Simulation::Simulation(std::shared_ptr<const Scene> scene, int threads)
    : impl_(std::make_unique<Impl>(std::move(scene), threads)) {}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::advance(std::int64_t steps, StageObserver* observer) {
  const std::int64_t last = std::min(impl_->state.step + steps, impl_->scene->schedule.step_count);
  if (impl_->status.kind == RunStatus::Kind::running) {
    impl_->advance_to(last, observer);
    if (impl_->has_ended()) {
      impl_->status.kind = RunStatus::Kind::finished;
    }
  }
}

Sample Simulation::take_sample() {
  Sample sample = impl_->sampler.take(*impl_->scene, impl_->state);
  const RunStatus found = check_run(*impl_->scene, impl_->state, sample);
  if (found.kind != RunStatus::Kind::running) {
    impl_->status = found;
  } else {
    impl_->keep_frame();
  }
  return sample;
}

FieldFrame Simulation::take_frame(int index) const {
  FieldFrame frame;
  make_frame(*impl_->scene, impl_->state, index, frame);
  return frame;
}

const FieldFrame& Simulation::last_good_frame() const { return impl_->last_good; }

std::string Simulation::checkpoint() const {
  std::string out;
  ByteWriter writer(out);
  writer.put(kCheckpointFormat);
  put_state(writer, impl_->state);
  impl_->sampler.visit_memory([&writer](const auto& field) { writer.put(field); });
  writer.put(impl_->last_good.time);
  writer.put(impl_->last_good.strain);
  writer.put(impl_->last_good.position);
  writer.put(impl_->last_good.plastic_fraction);
  writer.put(impl_->last_good_step);
  writer.put(impl_->rest);
  return out;
}

bool Simulation::restore(std::string_view checkpoint) {
  ByteReader reader(checkpoint);
  std::uint64_t format = 0;
  State state;
  state.contacts.resize(impl_->scene->bands.size());
  Sampler sampler(*impl_->scene);
  FieldFrame last_good;
  std::int64_t last_good_step = 0;
  RestWatch rest;
  reader.take(format);
  if (format != kCheckpointFormat) {
    return false;
  }
  take_state(reader, state);
  sampler.visit_memory([&reader](auto& field) { reader.take(field); });
  reader.take(last_good.time);
  reader.take(last_good.strain);
  reader.take(last_good.position);
  reader.take(last_good.plastic_fraction);
  reader.take(last_good_step);
  reader.take(rest);
  if (!reader.sound() || !reader.at_end() || !fit(state, impl_->state)) {
    return false;
  }
  impl_->state = std::move(state);
  impl_->sampler = std::move(sampler);
  impl_->last_good = std::move(last_good);
  impl_->last_good_step = last_good_step;
  impl_->rest = rest;
  impl_->status = {};
  return true;
}

bool Simulation::has_ended() const { return impl_->has_ended(); }
RunStatus Simulation::status() const { return impl_->status; }
std::int64_t Simulation::step() const { return impl_->state.step; }
double Simulation::time() const { return impl_->state.time; }
double Simulation::strain() const {
  return impl_->scene->length > 0.0 ? impl_->state.impact_travel / impl_->scene->length : 0.0;
}

void Simulation::visit_arrays(const std::function<void(const void*, std::size_t)>& visit) const {
  const auto visit_array = [&visit](const auto& array) {
    if (!array.empty()) {
      visit(array.data(), array.size() * sizeof(array[0]));
    }
  };
  cellcrush::visit_arrays(impl_->state, visit_array);
  cellcrush::visit_arrays(*impl_->scene, visit_array);
}

const Scene& Simulation::scene() const { return *impl_->scene; }
const State& Simulation::state() const { return impl_->state; }

}  // namespace cellcrush
