#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "cellcrush/v1/case.pb.h"

namespace cellcrush::store {

/// Size, bytes, above which the walls of a lattice, and other contents that rows share, are kept once.
inline constexpr std::size_t kLargeContent = 4096;

/// Takes the walls of a large lattice (the member of Lattice.kind) out of a case, as the bytes of a Lattice. Nothing if
/// they are small: the case then keeps them.
std::optional<std::string> take_lattice_out(v1::Case& submitted);

/// Puts them back. False if the bytes are no Lattice.
bool put_lattice_back(const std::string& bytes, v1::Case& submitted);

}  // namespace cellcrush::store
