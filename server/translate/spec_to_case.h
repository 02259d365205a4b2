#pragma once

#include "cellcrush/scene_spec.h"
#include "cellcrush/v1/case.pb.h"

namespace cellcrush::translate {

/// A spec as a case with every field set that the spec holds. Nodes of a frame are named by their positions: "0", "1",
/// ...
v1::Case to_case(const SceneSpec& spec);

v1::Numerics::Fidelity to_proto(NumericsSpec::Fidelity fidelity);

}  // namespace cellcrush::translate
