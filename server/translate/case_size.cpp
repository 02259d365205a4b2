#include "translate/case_size.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "cellcrush/v1/field.pb.h"
#include "translate/loads_places.h"
#include "translate/problems.h"

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
      const v1::FieldRules& rules = field->options().GetExtension(v1::rules);
      if (!field->is_repeated() || !rules.has_maximum()) continue;
      const int size = message.GetReflection()->FieldSize(message, field);
      if (size <= rules.maximum()) continue;
      *problems_.Add() = to_proto(invalid_field(path + "." + field->name(), std::to_string(size), "are too many.",
                                                "Give at most " + std::to_string(std::lround(rules.maximum())) + "."));
    }
  }

  // The points of all time functions together.
  void check_points(const v1::Case& submitted) {
    const v1::Frame& frame = submitted.lattice().frame();
    std::int64_t points = 0;
    for (const auto& load : frame.loads()) points += load.force_n_or_n_mm().points_size();
    for (const auto& motion : frame.motions()) points += motion.displacement_mm_or_rad().points_size();
    for (const auto& wall : rigid_walls_of(submitted)) points += wall.displacement_mm().points_size();
    for (const auto& load : frame.distributed_loads())
      points += load.x_n_per_mm().points_size() + load.y_n_per_mm().points_size();
    if (points <= kMostPoints) return;
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
  lists.check("lattice.frame", submitted.lattice().frame());
  lists.check("loading", submitted.loading());
  lists.check("lattice.inclusions", submitted.lattice().inclusions());
  lists.check_points(submitted);
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
