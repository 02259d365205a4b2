// Cost of the solver on blocks of Type I's hexagons, from a state that is crushed to 30 % strain.
//   solver_bench                              all
//   solver_bench --benchmark_filter=Contact   how contact grows with the lattice
#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <string>

#include "cellcrush/state.h"
#include "contact/contact_forces.h"
#include "contact/find_contacts.h"
#include "scenes/frames.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct Crushed {
  std::shared_ptr<const Scene> scene;
  State state;
};

Crushed crush(int columns, int rows) {
  SceneSpec spec = scenes::hexagon_block(columns, rows);
  spec.loading.end_strain = 0.3;
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  simulation.advance(scene->schedule.step_count);
  return {scene, simulation.state()};
}

/// Seconds of contact work in as many steps as one list of candidates lasts: one search, and the forces of each step.
double time_contact(const Crushed& crushed, State& state) {
  constexpr int kStepsPerSearch = 14;
  const Clock::time_point start = Clock::now();
  search_contacts(*crushed.scene, state);
  for (int i = 0; i < kStepsPerSearch; ++i) {
    evaluate_contact_forces(*crushed.scene, state);
  }
  return seconds_since(start);
}

// Both sizes are timed in turn within one run; the counter `ratio` is what four times the cells cost. Four times across the
// crush keeps the crushed share; twice either way makes it larger, which the candidates a particle show.
void ContactOfFourTimesTheCells(benchmark::State& bench) {
  const Crushed small = crush(37, 21);
  const Crushed large = crush(37 * static_cast<int>(bench.range(0)), 21 * static_cast<int>(bench.range(1)));
  State small_state = small.state;
  State large_state = large.state;
  double small_seconds = 0.0;
  double large_seconds = 0.0;
  for (auto _ : bench) {
    for (int i = 0; i < 4; ++i) {
      small_seconds += time_contact(small, small_state);
    }
    large_seconds += time_contact(large, large_state);
  }
  const auto particles = [](const Crushed& crushed) { return static_cast<double>(crushed.scene->particle_count()); };
  bench.counters["ratio"] = 4.0 * large_seconds / small_seconds;
  bench.counters["candidates_a_particle_small"] = static_cast<double>(small_state.candidates.size()) / particles(small);
  bench.counters["candidates_a_particle_large"] = static_cast<double>(large_state.candidates.size()) / particles(large);
}
BENCHMARK(ContactOfFourTimesTheCells)->Args({1, 4})->Args({2, 2})->Unit(benchmark::kMillisecond)->Iterations(100);

class StageClock : public StageObserver {
 public:
  void begin(Stage stage) override {
    const Clock::time_point now = Clock::now();
    close(now);
    current_ = static_cast<int>(stage);
    since_ = now;
  }
  void end_step() override {
    close(Clock::now());
    current_ = -1;
  }
  [[nodiscard]] double seconds(Stage stage) const { return seconds_[static_cast<int>(stage)]; }

 private:
  void close(Clock::time_point now) {
    if (current_ >= 0) {
      seconds_[current_] += std::chrono::duration<double>(now - since_).count();
    }
  }

  std::array<double, kStageCount> seconds_{};
  int current_ = -1;
  Clock::time_point since_;
};

// Nanoseconds an element-step, by stage.
void Step(benchmark::State& bench) {
  const Crushed crushed = crush(static_cast<int>(bench.range(0)), static_cast<int>(bench.range(1)));
  State state = crushed.state;
  StageClock clock;
  for (auto _ : bench) {
    advance_step(*crushed.scene, state, &clock);
  }
  const double element_steps =
      static_cast<double>(crushed.scene->element_count()) * static_cast<double>(bench.iterations());
  const std::pair<const char*, Stage> stages[] = {{"integrate_motion_ns", Stage::integrate_motion},
                                                  {"internal_forces_ns", Stage::evaluate_internal_forces},
                                                  {"find_contacts_ns", Stage::find_contacts},
                                                  {"contact_forces_ns", Stage::evaluate_contact_forces},
                                                  {"plate_forces_ns", Stage::evaluate_plate_forces}};
  double total = 0.0;
  for (const auto& [name, stage] : stages) {
    const double nanoseconds = 1e9 * clock.seconds(stage) / element_steps;
    bench.counters[name] = nanoseconds;
    total += nanoseconds;
  }
  bench.counters["element_step_ns"] = total;
}
BENCHMARK(Step)->Args({20, 7})->Args({74, 21})->Unit(benchmark::kMicrosecond)->Iterations(1000);

}  // namespace
}  // namespace cellcrush
