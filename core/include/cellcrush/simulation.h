#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cellcrush/byte_stream.h"
#include "cellcrush/sample.h"
#include "cellcrush/scene_spec.h"
#include "cellcrush/stage.h"

namespace cellcrush {

class DeviceEngine;
struct Scene;
struct State;

/// Result of build_scene: a scene, or all problems of the spec.
struct SceneResult {
  std::shared_ptr<const Scene> scene;  ///< null if there are problems
  Problems problems;
};

/// Checks a spec and builds its scene. Reports every problem at once; never throws on user input. `between_stages` is
/// called between the stages of building, each of which takes about a second for the largest mesh. Its exceptions are
/// passed on.
SceneResult build_scene(
    const SceneSpec& spec, const std::function<void()>& between_stages = [] {});

/// The spec with all defaults filled in that depend on other fields (vertical walls, fidelity, time step).
/// REQUIRES: `scene` was built from `spec`.
SceneSpec complete_spec(const SceneSpec& spec, const Scene& scene);

/// Properties of a scene and the cost of running it. Units: mm, tonne, s, MPa.
struct SceneFacts {
  std::int64_t particle_count = 0;
  std::int64_t element_count = 0;
  std::int64_t wall_count = 0;
  double mass = 0.0;                      ///< tonne, of all walls
  double relative_density = 0.0;          ///< mass over that of the solid envelope
  double length = 0.0;                    ///< envelope along the crush
  double width = 0.0;                     ///< envelope across it
  std::optional<double> valid_to_strain;  ///< as in Summary
  RunEnd end = RunEnd::time;
  double stable_step = 0.0;
  double time_step = 0.0;
  std::int64_t step_count = 0;       ///< planned
  std::int64_t most_steps = 0;       ///< more than planned only in quasi-static crushes
  double end_strain = 0.0;           ///< nominal, of a quasi-static crush; otherwise 0
  std::int64_t sample_interval = 0;  ///< steps
  std::int64_t frame_interval = 0;   ///< steps
  Theory theory;
  std::vector<std::string> modelled;  ///< what is modelled and what is left out, one sentence each
};
SceneFacts facts_of(const Scene& scene);

/// Geometry that stays constant during a run, in the units of the solver.
struct MeshView {
  std::vector<float> position;        ///< x0 y0 x1 y1 ... of N particles before loading, mm
  std::vector<int> element_nodes;     ///< start0 end0 start1 end1 ... of E elements
  std::vector<float> thickness;       ///< mm, of E elements
  std::vector<int> element_wall;      ///< of E elements: number of its wall, or of its beam in the list of a frame
  int rigid_elements = 0;             ///< of stiff cells or rigid links; they come last
  std::vector<int> overlap_particle;  ///< whose walls overlapped others before loading, ascending (StartOverlaps)
  double length = 0.0;                ///< envelope along the crush, mm
  double width = 0.0;
  double impact_plate = 0.0;  ///< the plates' faces before loading, along the crush, mm
  double support_plate = 0.0;
  bool along_y = false;
  double side_low = 0.0;  ///< the side walls' faces across the crush, mm; equal without any
  double side_high = 0.0;
  std::vector<int> gripped;  ///< particles that grips hold, grip by grip
};
MeshView mesh_of(const Scene& scene);

/// Computes the summary of a run from its samples.
Summary summarize(const Scene& scene, std::span<const Sample> samples);

/// Whether a run continues, or why it stopped.
struct RunStatus {
  enum class Kind {
    running,
    finished,
    diverged,        ///< a motion or a force is no longer finite
    large_rotation,  ///< a particle rotated by more in one step than the kinematics allow
    energy_balance,  ///< the energy balance has too large an error
    contact_energy,  ///< contacts have created too much energy
    wall_crossing,   ///< a wall has passed through another
    inertia,         ///< mass that the material does not have takes too much of the work
    overcompaction,  ///< walls are packed more densely than contacts can bear
    contact_lost     ///< beams of a frame moved too fast, or sank too deep into each other, for contacts to hold them
  };
  Kind kind = Kind::running;
  std::string message;  ///< what happened, where and when; empty while running or finished
  std::string remedy;   ///< what to do about it
};

/// A run of a scene. Not thread-safe: one thread at a time may call it.
class Simulation {
 public:
  /// Steps run on `threads` threads; the results have the same bits for any number of them. REQUIRES: threads >= 1.
  explicit Simulation(std::shared_ptr<const Scene> scene, int threads = 1);

  /// Has a device advance the run from now on, which changes no bit of the motion on a processor with fused
  /// multiply-add. If the device fails, the run goes on by itself from its newest state. REQUIRES: the engine outlives
  /// the simulation, and !why_not_on_device(scene()).
  void use_device(DeviceEngine& engine);

  /// What the device failed by; empty while it advances the run, or if none was asked to.
  [[nodiscard]] const std::string& device_failure() const;
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Advances by at most `steps`, never beyond the end. Does nothing unless status() is `running`.
  void advance(std::int64_t steps, StageObserver* observer = nullptr);

  /// Scalars now; ends the interval over which stresses are averaged. Checks the run: status() may change, and a sample
  /// that fails the check is not a result.
  Sample take_sample();

  /// Fields now; `index` is copied into the frame.
  FieldFrame take_frame(int index) const;

  /// Fields of the newest sample that was kept in case the run fails. That sample passed the check and is at most 1 %
  /// of the steps of the run older than the newest one that passed. Before the first such sample: the undeformed state.
  /// Its index is 0.
  [[nodiscard]] const FieldFrame& last_good_frame() const;

  /// Passes on all data needed to resume the run, for the same build on the same kind of processor; makes no copy of
  /// it. After restore(), everything has the same bits as in an uninterrupted run.
  void checkpoint(const ByteSink& sink) const;

  /// Resumes from a checkpoint of a run of an equal scene that had not stopped. Returns false if the bytes are no such
  /// checkpoint; the run is then at its start.
  bool restore(ByteSource checkpoint);

  /// Calls visit(first byte, bytes) for the arrays of the scene and of the state. Their addresses stay valid until a
  /// step enlarges the contact lists or breaks a wall, or until restore().
  void visit_arrays(const std::function<void(const void*, std::size_t)>& visit) const;

  /// Whether there is no further step: at the end strain, at the end time or at rest.
  [[nodiscard]] bool has_ended() const;

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
