#pragma once

#include <google/protobuf/message.h>

#include <string>
#include <vector>

namespace cellcrush::client {

/// What the work that was put in became: a number of a sample or of a ledger that has the option `term` (field.proto).
struct EnergyTerm {
  std::string label;
  int place = 0;  ///< in charts; 0 in a ledger
  const google::protobuf::FieldDescriptor* field = nullptr;
  const google::protobuf::FieldDescriptor* without = nullptr;  ///< part of `field` that is a term of its own, or null

  /// mJ.
  [[nodiscard]] double value(const google::protobuf::Message& message) const;
};

/// The terms of a message by their places; without places, in the order of its fields.
std::vector<EnergyTerm> energy_terms_of(const google::protobuf::Descriptor& message);

}  // namespace cellcrush::client
