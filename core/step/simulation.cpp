#include "cellcrush/simulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "cellcrush/device.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "fracture/new_ends.h"
#include "fracture/part_walls.h"
#include "measure/peak_stress.h"
#include "measure/sampler.h"
#include "push/crush.h"
#include "step/advance_step.h"
#include "step/break_walls.h"
#include "step/check_run.h"
#include "step/plate_control.h"
#include "step/rest_watch.h"

namespace cellcrush {

struct Simulation::Impl {
  Impl(std::shared_ptr<const Scene> built, int threads)
      : unbroken(std::move(built)), state(make_initial_state(*unbroken)), workspace(threads), sampler(*unbroken) {
    if (unbroken->can_break()) breaker.emplace(*unbroken);
    make_frame(0, last_good);
  }

  void start_over() {
    scene = unbroken;
    state = make_initial_state(*scene);
    sampler = Sampler(*scene);
    peak = {};
    rest = {};
    is_crushed_enough = false;
    status = {};
    make_frame(0, last_good);
    last_good_step = 0;
  }

  /// Calls visit(field) for all data of a checkpoint beside the state.
  template <class Visitor>
  void visit_beside_state(const Visitor& visit) {
    sampler.visit_memory(visit);
    peak.visit_memory(visit);
    visit(last_good.time);
    visit(last_good.strain);
    visit(last_good.position);
    visit(last_good.plastic_fraction);
    visit(last_good.fibre_strain);
    visit(last_good.local_strain);
    visit(last_good.broken_end);
    visit(last_good.end_position);
    visit(last_good_step);
    visit(overlaps);
    visit(rest);
    visit(is_crushed_enough);
  }

  /// Calls look(run) with what the sampler looks at.
  template <class Look>
  auto look_at_run(const Look& look) const {
    if (state.breaks.empty()) return look(Sampler::Run{*scene, state, *scene, state});
    const State joined = without_new_ends(*scene, state);
    return look(Sampler::Run{*scene, state, *unbroken, joined});
  }

  void make_frame(int index, FieldFrame& frame) const {
    look_at_run([&](const Sampler::Run& run) { sampler.make_frame(run, index, frame); });
  }

  void keep_frame() {
    if (kFramesKept * (state.step - last_good_step) >= scene->schedule.step_count) {
      make_frame(0, last_good);
      last_good_step = state.step;
    }
  }

  /// Steps up to `end` in which nothing looks at the state.
  [[nodiscard]] std::int64_t steps_to_next_look(std::int64_t end) const {
    std::int64_t next = end;
    const auto look_every = [&](std::int64_t interval) {
      next = std::min(next, (state.step / interval + 1) * interval);
    };
    if (scene->schedule.end_at_rest > 0.0) look_every(RestWatch::interval(scene->schedule));
    if (is_crushed(*scene)) look_every(PeakWatch::interval(*scene));
    if (!is_controlled(*scene)) return next - state.step;
    look_every(control_interval(scene->schedule));
    return std::min(next - state.step, steps_to_arrival(*scene, state));
  }

  /// Has the device advance by some steps. Returns false if it fails: the state is then as it was.
  bool advance_on_device(std::int64_t steps) {
    if (engine == nullptr || state.crossing_step >= 0) return false;
    try {
      if (on_device == nullptr) {
        on_device = engine->begin(*scene, state);
        newest = state;
      }
      const std::optional<std::string> failure = on_device->advance(steps);
      if (!failure) {
        on_device->take(newest);
        std::swap(state, newest);
        return true;
      }
      device_failure = *failure;
    } catch (const DeviceError& error) {
      device_failure = error.what();
    }
    leave_device();
    return false;
  }

  void leave_device() {
    on_device.reset();
    engine = nullptr;
    newest = State();
  }

  /// Advances by some steps, and breaks the walls that fail.
  void advance_by(std::int64_t steps, StageObserver* observer) {
    if (advance_on_device(steps)) return;
    if (!breaker) {
      advance_steps(*scene, state, workspace, steps, observer);
      return;
    }
    for (const std::int64_t end = state.step + steps; state.step < end;) {
      advance_steps(*scene, state, workspace, 1, observer);
      if (std::shared_ptr<const Scene> broken = breaker->break_walls(*scene, state, workspace)) {
        scene = std::move(broken);
        overlaps = scene->start_overlaps.pairs;
      }
    }
  }

  /// Makes the mesh again that the breaks of a restored state have left. Returns whether the state is of it.
  bool break_again() {
    scene = unbroken;
    if (state.breaks.empty()) return true;
    if (!unbroken->can_break()) return false;
    const std::shared_ptr<Scene> broken = part_again(*unbroken, state.breaks);
    put_overlaps(overlaps, *broken);
    scene = broken;
    return broken->particle_count() == state.position.size() && overlaps.size() == state.parted.size();
  }

  /// Advances to a step, to rest, or to where a controlled plate arrives.
  void advance_to(std::int64_t end, StageObserver* observer) {
    while (state.step < end && !has_ended()) {
      advance_by(steps_to_next_look(end), observer);
      if (scene->schedule.end_at_rest > 0.0 && state.step % RestWatch::interval(scene->schedule) == 0) {
        rest.look(*scene, state);
      }
      if (is_crushed(*scene) && state.step % PeakWatch::interval(*scene) == 0) {
        peak.look(*scene, state);
        const double end_strain = scene->schedule.end_strain;
        is_crushed_enough = end_strain > 0.0 && crush_strain_of(*scene, state) >= end_strain;
      }
      if (is_controlled(*scene) && state.step % control_interval(scene->schedule) == 0) {
        control_plate(*scene, state);
      }
    }
  }

  [[nodiscard]] bool has_ended() const {
    return state.step >= most_steps_of(*scene) || rest.is_at_rest() || is_crushed_enough || has_arrived(*scene, state);
  }

  /// Frames kept over a run in case it fails: often enough to see it come, seldom enough to take less than a hundredth
  /// of the time.
  static constexpr std::int64_t kFramesKept = 100;

  std::shared_ptr<const Scene> unbroken;  ///< the mesh before any break
  std::shared_ptr<const Scene> scene = unbroken;
  State state;
  Workspace workspace;
  DeviceEngine* engine = nullptr;
  std::unique_ptr<CrushOnDevice> on_device;  ///< null until the first step there, and after restore()
  State newest;                              ///< of the device, until it is whole
  std::string device_failure;
  Sampler sampler;
  std::optional<WallBreaker> breaker;
  std::vector<StartOverlap> overlaps;  ///< of the scene, if walls have broken
  PeakWatch peak;
  RestWatch rest;
  bool is_crushed_enough = false;  ///< by rigid walls, as loading.end_strain asks
  RunStatus status;
  FieldFrame last_good;
  std::int64_t last_good_step = 0;
};

namespace {

// Changes with what follows it in a checkpoint.
constexpr std::uint64_t kCheckpointFormat = 0x63656C6C6372000E;

/// Sizes of the lists that equal scenes have alike.
std::array<std::size_t, 8> shape_of(const State& state) {
  return {state.position.size(),   state.rotation.size(),      state.rigid_centre.size(),
          state.length.size(),     state.fibres.stress.size(), state.single_fibres.stress.size(),
          state.wall_force.size(), state.contact_force.size()};
}

}  // namespace

Simulation::Simulation(std::shared_ptr<const Scene> scene, int threads)
    : impl_(std::make_unique<Impl>(std::move(scene), threads)) {}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::use_device(DeviceEngine& engine) { impl_->engine = &engine; }

const std::string& Simulation::device_failure() const { return impl_->device_failure; }

void Simulation::advance(std::int64_t steps, StageObserver* observer) {
  const std::int64_t last = std::min(impl_->state.step + steps, most_steps_of(*impl_->scene));
  if (impl_->status.kind == RunStatus::Kind::running) {
    impl_->advance_to(last, observer);
    if (impl_->has_ended()) {
      impl_->status.kind = RunStatus::Kind::finished;
    }
  }
}

Sample Simulation::take_sample() {
  Sample sample = impl_->look_at_run(
      [&](const Sampler::Run& run) { return impl_->sampler.take(run, impl_->workspace.shared.workers); });
  sample.peak = impl_->peak.peak();
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
  impl_->make_frame(index, frame);
  return frame;
}

const FieldFrame& Simulation::last_good_frame() const { return impl_->last_good; }

void Simulation::checkpoint(const ByteSink& sink) const {
  ByteWriter writer(sink);
  writer.put(kCheckpointFormat);
  put_state(writer, impl_->state);
  impl_->visit_beside_state([&writer](const auto& field) { writer.put(field); });
}

// In place: the largest states do not fit into memory twice.
bool Simulation::restore(ByteSource checkpoint) {
  impl_->on_device.reset();
  ByteReader reader(std::move(checkpoint));
  std::uint64_t format = 0;
  reader.take(format);
  impl_->scene = impl_->unbroken;
  auto shape = shape_of(impl_->state);
  for (const std::size_t of_particles : {0, 1, 7}) shape[of_particles] = impl_->unbroken->particle_count();
  if (format == kCheckpointFormat) {
    // Lists of contacts hold derived data too.
    impl_->state.contacts.assign(impl_->scene->bands.size(), ContactLists());
    impl_->state.thickening_step.clear();
    impl_->state.contact_tiles.clear();
    take_state(reader, impl_->state);
    impl_->visit_beside_state([&reader](auto& field) { reader.take(field); });
    impl_->status = {};
    for (const std::size_t of_particles : {0, 1, 7}) shape[of_particles] += impl_->state.breaks.size();
    if (reader.sound() && reader.at_end() && shape_of(impl_->state) == shape && impl_->break_again()) {
      return true;
    }
  }
  impl_->start_over();
  return false;
}

bool Simulation::has_ended() const { return impl_->has_ended(); }
RunStatus Simulation::status() const { return impl_->status; }
std::int64_t Simulation::step() const { return impl_->state.step; }
double Simulation::time() const { return impl_->state.time; }
double Simulation::strain() const { return crush_strain_of(*impl_->scene, impl_->state); }

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
