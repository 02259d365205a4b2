#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cellcrush/problem.h"
#include "cellcrush/sample.h"
#include "cellcrush/scene_spec.h"
#include "cellcrush/stage.h"

namespace cellcrush {

struct Scene;
struct State;

/// What building a scene gave: a scene, or all problems of the spec.
struct SceneResult {
  std::shared_ptr<const Scene> scene;  ///< null when there are problems
  Problems problems;
};

/// Checks a spec and builds its scene. Never throws on a user's input; reports every problem at once. `between_stages`
/// is called between the stages of the building, of which each takes about a second for the largest mesh; what it
/// throws is passed on.
SceneResult build_scene(
    const SceneSpec& spec, const std::function<void()>& between_stages = [] {});

/// The spec with every default that depends on other fields filled in (vertical walls, what its fidelity says, time
/// step).
/// REQUIRES: `scene` was built from `spec`.
SceneSpec complete_spec(const SceneSpec& spec, const Scene& scene);

/// What a scene is and what running it takes. Units: mm, tonne, s, MPa.
struct SceneFacts {
  std::int64_t particle_count = 0;
  std::int64_t element_count = 0;
  double mass = 0.0;              ///< tonne, of all walls
  double relative_density = 0.0;  ///< mass over that of the solid envelope
  double length = 0.0;            ///< envelope along the crush
  double width = 0.0;             ///< envelope across it
  double stable_step = 0.0;
  double time_step = 0.0;
  std::int64_t step_count = 0;
  std::int64_t sample_interval = 0;  ///< steps
  std::int64_t frame_interval = 0;   ///< steps
  std::int64_t memory_bytes = 0;     ///< of scene and state
  Theory theory;
  std::vector<std::string> modelled;  ///< what is modelled and what is left out, a sentence each
};
SceneFacts facts_of(const Scene& scene);

/// What does not change over a run, in the units of the solver.
struct MeshView {
  std::vector<int> element_nodes;  ///< start0 end0 start1 end1 ... of E elements
  std::vector<float> thickness;    ///< mm, of E elements
  double length = 0.0;             ///< envelope along the crush, mm
  double width = 0.0;
  double impact_plate = 0.0;  ///< the plates' faces before loading, along the crush, mm
  double support_plate = 0.0;
  bool along_y = false;
};
MeshView mesh_of(const Scene& scene);

/// What to make of the samples of a run.
Summary summarize(const Scene& scene, std::span<const Sample> samples);

/// Why a run stopped.
struct RunStatus {
  enum class Kind {
    running,
    finished,
    diverged,        ///< a motion or a force is no longer finite
    large_rotation,  ///< a particle turned by more in a step than the kinematics are made for
    energy_balance,  ///< the ledger is open
    contact_energy   ///< contacts have made energy
  };
  Kind kind = Kind::running;
  std::string message;  ///< what happened, where and when; empty while running or finished
  std::string remedy;   ///< what to do about it
};

/// A run of a scene. Not thread-safe; one thread at a time.
class Simulation {
 public:
  /// Steps run on so many threads; the results have the same bits for any number of them. REQUIRES: threads >= 1.
  explicit Simulation(std::shared_ptr<const Scene> scene, int threads = 1);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Advances by at most `steps` and no further than the last step; nothing happens once status() is not `running`.
  void advance(std::int64_t steps, StageObserver* observer = nullptr);

  /// Scalars now; closes the interval over which stresses are means. Checks the run: after it status() may have
  /// changed, and a sample that fails the check is no result.
  Sample take_sample();

  /// Fields now; `index` is copied into the frame.
  FieldFrame take_frame(int index) const;

  /// Fields of the newest sample that was kept for the case that the run fails: it passed the check, and lies at most a
  /// hundredth of the run's steps before the newest that did. The undeformed state before there is one. Its index is 0.
  [[nodiscard]] const FieldFrame& last_good_frame() const;

  /// All that the run needs to go on from here, for the same build on the same kind of processor: whatever is done
  /// after restore() has the same bits as if the run had not been left.
  [[nodiscard]] std::string checkpoint() const;

  /// Goes on from a checkpoint of a run of an equal scene that had not stopped. False, and nothing has happened, when
  /// the bytes are none.
  bool restore(std::string_view checkpoint);

  /// Calls visit(first byte, bytes) for the arrays that most steps go over. They stay where they are until steps make
  /// lists of contacts longer, or until restore().
  void visit_arrays(const std::function<void(const void*, std::size_t)>& visit) const;

  [[nodiscard]] RunStatus status() const;
  [[nodiscard]] std::int64_t step() const;
  [[nodiscard]] double time() const;
  [[nodiscard]] double strain() const;
  [[nodiscard]] const Scene& scene() const;
  [[nodiscard]] const State& state() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cellcrush
