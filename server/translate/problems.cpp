#include "translate/problems.h"

#include <utility>

namespace cellcrush::translate {

v1::Problem to_proto(const Problem& problem, v1::Problem::Kind kind) {
  v1::Problem out;
  out.set_field(problem.field);
  out.set_value(problem.value);
  out.set_message(problem.message);
  out.set_remedy(problem.remedy);
  out.set_kind(kind);
  return out;
}

Problem invalid_field(std::string field, std::string value, std::string message, std::string remedy) {
  return {std::move(field), std::move(value), std::move(message), std::move(remedy)};
}

}  // namespace cellcrush::translate
