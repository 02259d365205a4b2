#include "results/energy_terms.h"

#include <algorithm>

#include "cellcrush/v1/field.pb.h"

namespace cellcrush::client {

double EnergyTerm::value(const google::protobuf::Message& message) const {
  const auto& reflection = *message.GetReflection();
  const double part = without == nullptr ? 0.0 : reflection.GetDouble(message, without);
  return reflection.GetDouble(message, field) - part;
}

std::vector<EnergyTerm> energy_terms_of(const google::protobuf::Descriptor& message) {
  std::vector<EnergyTerm> terms;
  for (int i = 0; i < message.field_count(); ++i) {
    if (!message.field(i)->options().HasExtension(v1::term)) continue;
    const v1::EnergyTerm& term = message.field(i)->options().GetExtension(v1::term);
    terms.push_back({term.label(), term.place(), message.field(i), message.FindFieldByName(term.without())});
  }
  std::ranges::stable_sort(terms, {}, &EnergyTerm::place);
  return terms;
}

}  // namespace cellcrush::client
