#pragma once

#include "cellcrush/scene_spec.h"
#include "cellcrush/v1/case.pb.h"

namespace cellcrush::translate {

/// The case of a spec, with every field that the spec sets. Nodes of a frame are named by index: "0", "1", ...
v1::Case to_case(const SceneSpec& spec);

v1::Numerics::Fidelity to_proto(NumericsSpec::Fidelity fidelity);

}  // namespace cellcrush::translate
