#pragma once

#include "cellcrush/problem.h"
#include "cellcrush/scene_spec.h"
#include "cellcrush/v1/case.pb.h"

namespace cellcrush::translate {

/// A case as the solver's spec, and what could not be carried over. The spec is usable for finding further problems
/// even when there are some: what could not be carried over has its default.
struct CaseReading {
  SceneSpec spec;
  Problems problems;
};

/// Mechanical: a field that is left out takes the spec's default or stays missing, and no physics is judged here.
/// Problems are those of the wire alone: unknown enum numbers, an over-long title, names of nodes that do not exist,
/// fields that the spec has no place for.
CaseReading to_spec(const v1::Case& in);

/// The frame's part of it; problems are appended.
FrameLattice to_spec(const v1::Frame& in, Problems& problems);

/// A material whose fields' paths begin with `path`.
MaterialSpec to_spec(const v1::Material& in, const std::string& path, Problems& problems);

}  // namespace cellcrush::translate
