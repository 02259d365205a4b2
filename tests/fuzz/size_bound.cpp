#include "fuzz/size_bound.h"

#include <cstdio>
#include <cstdlib>

#include "error.h"
#include "jobs/case_field.h"
#include "jobs/sweep_points.h"

namespace cellcrush::fuzz {
namespace {

constexpr double kMostByDefault = 32.0;  // elements per wall: REFERENCE of squares and triangles

template <class Lattice>
double cells_of(const Lattice& lattice) {
  return static_cast<double>(lattice.columns()) * lattice.rows();
}

double elements_of(const v1::Case& given) {
  const double per_wall = given.has_elements_per_wall() ? given.elements_per_wall() : kMostByDefault;
  const v1::Lattice& lattice = given.lattice();
  double out =
      3.0 * per_wall * (cells_of(lattice.hexagon()) + cells_of(lattice.square()) + cells_of(lattice.triangle()));
  for (const auto& beam : lattice.frame().beams()) out += beam.has_elements() ? beam.elements() : per_wall;
  return out;
}

}  // namespace

bool is_large(const v1::Case& given, double most_elements) { return elements_of(given) > most_elements; }

bool is_large(const v1::Sweep& given, double most_elements) {
  try {
    const auto points = jobs::expand(given);
    double elements = 0.0;
    for (const auto& values : points.values) {
      v1::Case of_point = given.case_();
      for (std::size_t i = 0; i < points.fields.size(); ++i)
        jobs::set_case_field(of_point, points.fields[i], values[i]);
      // A case costs something however small it is.
      elements += 200.0 + elements_of(of_point);
      if (elements > most_elements) return true;
    }
  } catch (const InvalidField&) {
    // What is refused costs nothing.
  }
  return false;
}

void require_complete(const google::protobuf::RepeatedPtrField<v1::Problem>& problems) {
  for (const v1::Problem& problem : problems) {
    if (!problem.field().empty() && !problem.message().empty() && !problem.remedy().empty()) continue;
    std::fprintf(stderr, "a refusal without field, message or remedy: %s\n", problem.ShortDebugString().c_str());
    std::abort();
  }
}

}  // namespace cellcrush::fuzz
