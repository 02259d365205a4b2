#include "translate/case_size.h"

#include <cstdint>
#include <string>
#include <utility>

#include "translate/problems.h"

namespace cellcrush::translate {
namespace {

constexpr int kLongestList = 200'000;
constexpr int kLongestShortList = 10'000;
constexpr int kMostRigidWalls = 1'000;  // each of which looks at every ball

// Collects the lists that are too long.
class ListChecker {
 public:
  void check(const std::string& field, int size, int longest) {
    if (size <= longest) return;
    *problems_.Add() = to_proto(
        invalid_field(field, std::to_string(size), "are too many.", "Give at most " + std::to_string(longest) + "."));
  }

  // The points of all time functions together.
  void check_points(const v1::Frame& frame) {
    std::int64_t points = 0;
    for (const auto& load : frame.loads()) points += load.force_n_or_n_mm().points_size();
    for (const auto& motion : frame.motions()) points += motion.displacement_mm_or_rad().points_size();
    for (const auto& wall : frame.rigid_walls()) points += wall.displacement_mm().points_size();
    for (const auto& load : frame.distributed_loads())
      points += load.x_n_per_mm().points_size() + load.y_n_per_mm().points_size();
    if (points <= kLongestList) return;
    *problems_.Add() = to_proto(invalid_field("lattice.frame", std::to_string(points),
                                              "has too many points in its time functions.", "Give at most 200000."));
  }

  google::protobuf::RepeatedPtrField<v1::Problem> take() { return std::move(problems_); }

 private:
  google::protobuf::RepeatedPtrField<v1::Problem> problems_;
};

}  // namespace

google::protobuf::RepeatedPtrField<v1::Problem> find_long_lists(const v1::Case& submitted) {
  ListChecker lists;
  const v1::Frame& frame = submitted.lattice().frame();
  lists.check("lattice.frame.nodes", frame.nodes_size(), kLongestList);
  lists.check("lattice.frame.beams", frame.beams_size(), kLongestList);
  lists.check("lattice.frame.supports", frame.supports_size(), kLongestList);
  lists.check("lattice.frame.loads", frame.loads_size(), kLongestList);
  lists.check("lattice.frame.distributed_loads", frame.distributed_loads_size(), kLongestList);
  lists.check("lattice.frame.initial_velocities", frame.initial_velocities_size(), kLongestList);
  lists.check("lattice.frame.motions", frame.motions_size(), kLongestShortList);
  lists.check("lattice.frame.watched_nodes", frame.watched_nodes_size(), kLongestShortList);
  lists.check("lattice.frame.rigid_walls", frame.rigid_walls_size(), kMostRigidWalls);
  lists.check("lattice.inclusions.rows", submitted.lattice().inclusions().rows_size(), kLongestShortList);
  lists.check_points(frame);
  return lists.take();
}

void cut_problems(google::protobuf::RepeatedPtrField<v1::Problem>& problems) {
  const int left_out = problems.size() - kMostProblems;
  if (left_out <= 0) return;
  problems.DeleteSubrange(kMostProblems, left_out);
  *problems.Add() = to_proto(invalid_field("case", "", "has " + std::to_string(left_out) + " more problems.",
                                           "Fix these first; the same call then lists the rest."));
}

}  // namespace cellcrush::translate
