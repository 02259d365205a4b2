#include "translate/check_case.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "cellcrush/device.h"
#include "cellcrush/run_memory.h"
#include "cellcrush/simulation.h"
#include "cellcrush/spec_checker.h"
#include "cellcrush/v1/field.pb.h"
#include "translate/case_to_spec.h"
#include "translate/loads_places.h"
#include "translate/materials.h"
#include "translate/plateau_differences.h"
#include "translate/results.h"
#include "translate/spec_to_case.h"
#include "translate/worker_memory.h"

namespace cellcrush::translate {
namespace {

constexpr int kMostPoints = 200'000;

// Collects the lists that are too long.
class ListChecker {
 public:
  // The lists of a message at `path`, by their maximum in field.proto.
  void check(const std::string& path, const google::protobuf::Message& message) {
    for (int i = 0; i < message.GetDescriptor()->field_count(); ++i) {
      const auto* field = message.GetDescriptor()->field(i);
      const int size = field->is_repeated() ? message.GetReflection()->FieldSize(message, field) : 0;
      if (size == 0) continue;
      const v1::FieldRules& rules = field->options().GetExtension(v1::rules);
      if (!rules.has_maximum() || size <= rules.maximum()) continue;
      *problems_.Add() = to_proto(Problem{path + "." + field->name(), std::to_string(size), "are too many.",
                                          "Give at most " + std::to_string(std::lround(rules.maximum())) + "."});
    }
  }

  // The points of all time functions together.
  void check_points(const v1::Case& submitted) {
    const v1::Frame& frame = submitted.lattice().frame();
    std::int64_t points = 0;
    for (const auto& load : frame.loads()) points += load.force_n_or_n_mm().points_size();
    for (const auto& motion : frame.motions()) points += motion.displacement_mm_or_rad().points_size();
    for (const auto& grip : submitted.loading().grips())
      points += grip.displacement_x_mm().points_size() + grip.displacement_y_mm().points_size();
    for (const auto& wall : rigid_walls_of(submitted)) {
      for (const auto* function :
           {&wall.displacement_mm(), &wall.velocity_m_per_s(), &wall.force_n(), &wall.pressure_mpa()})
        points += function->points_size();
    }
    for (const auto& load : frame.distributed_loads())
      points += load.x_n_per_mm().points_size() + load.y_n_per_mm().points_size();
    if (points <= kMostPoints) return;
    *problems_.Add() = to_proto(Problem{"lattice.frame", std::to_string(points),
                                        "has too many points in its time functions.", "Give at most 200000."});
  }

  google::protobuf::RepeatedPtrField<v1::Problem> take() { return std::move(problems_); }

 private:
  google::protobuf::RepeatedPtrField<v1::Problem> problems_;
};

std::int64_t divide_up(std::int64_t value, std::int64_t by) { return by > 0 ? (value + by - 1) / by : 0; }

void describe(const SceneFacts& facts, v1::CheckCaseResponse& out) {
  constexpr double kGramsPerTonne = 1e6;
  out.set_particle_count(facts.particle_count);
  out.set_element_count(facts.element_count);
  out.set_mass_g(facts.mass * kGramsPerTonne);
  out.set_relative_density(facts.relative_density);
  out.set_length_mm(facts.length);
  out.set_width_mm(facts.width);
  if (facts.valid_to_strain) out.set_valid_to_strain(*facts.valid_to_strain);
  out.set_stable_step_s(facts.stable_step);
  out.set_time_step_s(facts.time_step);
  out.set_step_count(facts.step_count);
  *out.mutable_theory() = to_proto(facts.theory);
  for (const auto& sentence : facts.modelled) out.add_modelled(sentence);
}

// A frame's nodes keep their names from the case.
void restore_names(const v1::Frame& submitted, v1::Frame& completed) {
  const auto rename = [&submitted](std::string& id) { id = submitted.nodes(std::stoi(id)).id(); };
  for (auto& node : *completed.mutable_nodes()) rename(*node.mutable_id());
  for (auto& beam : *completed.mutable_beams()) {
    rename(*beam.mutable_start());
    rename(*beam.mutable_end());
  }
  for (auto& support : *completed.mutable_supports()) rename(*support.mutable_node());
  for (auto& load : *completed.mutable_loads()) rename(*load.mutable_node());
  for (auto& motion : *completed.mutable_motions()) rename(*motion.mutable_node());
  for (auto& watched : *completed.mutable_watched_nodes()) rename(watched);
  for (auto& velocity : *completed.mutable_initial_velocities()) rename(*velocity.mutable_node());
}

// A network keeps the form in which it was given.
void restore_lists(const v1::Lattice::Network& submitted, v1::Lattice::Network& completed) {
  if (!submitted.has_compact()) return;
  completed.clear_joints_mm();
  completed.clear_walls();
  completed.clear_thicknesses_mm();
  completed.clear_rises_mm();
  *completed.mutable_compact() = submitted.compact();
}

// A case as the solver reads it.
struct Built {
  SceneSpec spec;
  std::shared_ptr<const Scene> scene;  // null if there are problems
};

Built build(const v1::Case& submitted, google::protobuf::RepeatedPtrField<v1::Problem>& found,
            const std::function<void()>& between_stages) {
  found = find_long_lists(submitted);
  if (!found.empty()) return {};
  auto reading = to_spec(submitted);
  between_stages();
  auto built = build_scene(reading.spec, between_stages);
  name_as_given(submitted, built.problems);
  for (const Problems* problems : {&reading.problems, &built.problems}) {
    for (const auto& problem : *problems) *found.Add() = to_proto(problem);
  }
  cut_problems(found);
  return {reading.spec, found.empty() ? built.scene : nullptr};
}

}  // namespace

v1::Problem to_proto(const Problem& problem, v1::Problem::Kind kind) {
  v1::Problem out;
  out.set_field(problem.field);
  out.set_value(problem.value);
  out.set_message(problem.message);
  out.set_remedy(problem.remedy);
  out.set_kind(kind);
  return out;
}

google::protobuf::RepeatedPtrField<v1::Problem> find_long_lists(const v1::Case& submitted) {
  ListChecker lists;
  lists.check("lattice.frame", submitted.lattice().frame());
  lists.check("lattice.network", submitted.lattice().network());
  lists.check("lattice.network.compact", submitted.lattice().network().compact());
  lists.check("lattice.grading", submitted.lattice().grading());
  lists.check("lattice.outline", submitted.lattice().outline());
  lists.check("loading", submitted.loading());
  lists.check("lattice.inclusions", submitted.lattice().inclusions());
  lists.check_points(submitted);
  return lists.take();
}

void cut_problems(google::protobuf::RepeatedPtrField<v1::Problem>& problems) {
  const int left_out = problems.size() - kMostProblems;
  if (left_out <= 0) return;
  problems.DeleteSubrange(kMostProblems, left_out);
  *problems.Add() = to_proto(Problem{"case", "", "has " + std::to_string(left_out) + " more problems.",
                                     "Fix these first; the same call then lists the rest."});
}

CaseCheck check_case(const v1::Case& submitted, const std::function<void()>& between_stages) {
  CaseCheck out;
  const auto [spec, scene] = build(submitted, *out.response.mutable_problems(), between_stages);
  if (!scene) return out;
  for (const auto& note : notes_on_named(submitted, find_implausible(spec))) {
    *out.response.add_notes() = to_proto(note, v1::Problem::IMPLAUSIBLE);
  }
  for (const auto& note : find_costly_walls(spec, *scene)) {
    *out.response.add_notes() = to_proto(note, v1::Problem::IMPLAUSIBLE);
  }
  out.response.set_small_specimen(describe_small_specimen(spec));
  out.meshes->know(spec, *scene);
  out.reference_steps = out.meshes->check(spec).reference_steps;
  const auto facts = facts_of(*scene);
  out.response.set_default_mesh(describe_default_mesh(spec, facts.relative_density));
  describe(facts, out.response);
  add_moduli(spec, *out.response.mutable_theory());
  *out.response.mutable_completed_case() = to_case(complete_spec(spec, *scene));
  if (submitted.lattice().has_frame()) {
    restore_names(submitted.lattice().frame(),
                  *out.response.mutable_completed_case()->mutable_lattice()->mutable_frame());
  }
  v1::Case& completed = *out.response.mutable_completed_case();
  if (submitted.lattice().has_network())
    restore_lists(submitted.lattice().network(), *completed.mutable_lattice()->mutable_network());
  restore_ids(submitted, completed);
  out.wall_count = facts.wall_count;
  out.sample_count = divide_up(facts.step_count, facts.sample_interval);
  out.frame_count = divide_up(facts.step_count, facts.frame_interval) + 1;
  out.checkpoint_bytes = checkpoint_of_run(spec, *scene);
  out.why_not_on_device = why_not_on_device(*scene);
  out.response.set_predicted_memory_bytes(
      memory_of_worker(spec, {memory_of_run(spec, *scene), facts.element_count, out.sample_count}));
  return out;
}

std::int64_t predicted_memory(const v1::Case& submitted) {
  return check_case(submitted).response.predicted_memory_bytes();
}

}  // namespace cellcrush::translate
