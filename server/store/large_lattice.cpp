#include "store/large_lattice.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

namespace cellcrush::store {

std::optional<std::string> take_lattice_out(v1::Case& submitted) {
  if (submitted.lattice().ByteSizeLong() <= kLargeContent) return std::nullopt;
  v1::Lattice& lattice = *submitted.mutable_lattice();
  const auto* kinds = v1::Lattice::descriptor()->FindOneofByName("kind");
  const auto* kind = lattice.GetReflection()->GetOneofFieldDescriptor(lattice, kinds);
  if (kind == nullptr || lattice.GetReflection()->GetMessage(lattice, kind).ByteSizeLong() <= kLargeContent)
    return std::nullopt;
  v1::Lattice walls;
  lattice.GetReflection()->SwapFields(&lattice, &walls, {kind});
  return walls.SerializeAsString();
}

bool put_lattice_back(const std::string& bytes, v1::Case& submitted) {
  return submitted.mutable_lattice()->MergeFromString(bytes);
}

}  // namespace cellcrush::store
