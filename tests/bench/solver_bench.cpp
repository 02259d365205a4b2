// Cost of the solver on blocks of Type I's hexagons, from a state that is crushed to 30 % strain.
//   solver_bench                              all
//   solver_bench --benchmark_filter=Contact   how contact grows with the lattice
#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <string>

#include "cellcrush/state.h"
#include "scenes/frames.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

using Clock = std::chrono::steady_clock;

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

/// Seconds of the contact stages in ten lives of a list of candidates, stepped on from the crushed state.
double time_contact(const Crushed& crushed) {
  constexpr int kSteps = 140;
  State state = crushed.state;
  StageClock clock;
  for (int i = 0; i < kSteps; ++i) {
    advance_step(*crushed.scene, state, &clock);
  }
  return clock.seconds(Stage::find_contacts) + clock.seconds(Stage::evaluate_contact_forces);
}

// Both sizes are timed in turn within one run; the counter `ratio` is what four times the cells cost. Four times across the
// crush keeps the crushed share; twice either way makes it larger, which the candidates a particle show. Timed in whole
// steps: contact alone, over and over on one state, is faster on small blocks, whose branches the processor learns by heart.
void ContactOfFourTimesTheCells(benchmark::State& bench) {
  const Crushed small = crush(static_cast<int>(bench.range(0)), static_cast<int>(bench.range(1)));
  const Crushed large = crush(static_cast<int>(bench.range(2)), static_cast<int>(bench.range(3)));
  double small_seconds = 0.0;
  double large_seconds = 0.0;
  for (auto _ : bench) {
    for (int i = 0; i < 4; ++i) {
      small_seconds += time_contact(small);
    }
    large_seconds += time_contact(large);
  }
  const auto candidates_a_particle = [](const Crushed& crushed) {
    return static_cast<double>(crushed.state.candidate_count) / static_cast<double>(crushed.scene->particle_count());
  };
  bench.counters["ratio"] = 4.0 * large_seconds / small_seconds;
  bench.counters["candidates_a_particle_small"] = candidates_a_particle(small);
  bench.counters["candidates_a_particle_large"] = candidates_a_particle(large);
}
BENCHMARK(ContactOfFourTimesTheCells)
    ->ArgNames({"columns", "rows", "large_columns", "large_rows"})
    ->Args({20, 10, 40, 20})
    ->Args({37, 21, 37, 84})
    ->Args({37, 21, 74, 42})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(10);

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
