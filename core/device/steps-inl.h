#pragma once

// The order of the phases of a step, for every kind of device.

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>

// clang-format off
#include "device/crush-inl.h"  // first: with the names that the laws use
// clang-format on

#include "device/contact_phases-inl.h"
#include "device/motion_phases-inl.h"
#include "device/search_phases-inl.h"

namespace cellcrush::HWY_NAMESPACE {

/// The kinds of walls: formulation, law and section rule. An index into them chooses the kernel.
using WallKinds = std::tuple<EvaluateWalls<true, PerfectlyPlastic, RuleFactors<4, 6, float>>,
                             EvaluateWalls<true, PerfectlyPlastic, RuleFactors<4, 6, double>>,
                             EvaluateWalls<false, PerfectlyPlastic, RuleFactors<2, 6, float>>,
                             EvaluateWalls<false, PerfectlyPlastic, RuleFactors<2, 6, double>>,
                             EvaluateWalls<true, MixedHardening, RuleFactors<4, 6, double>>,
                             EvaluateWalls<false, MixedHardening, RuleFactors<2, 6, float>>,
                             EvaluateWalls<false, MixedHardening, RuleFactors<2, 6, double>>>;

/// Calls visit(kind) for the kind of an index, which is that of a crush.
template <class Visit>
void visit_kind_of_walls(int index, const Visit& visit) {
  [&]<std::size_t... Kinds>(std::index_sequence<Kinds...>) {
    ((static_cast<int>(Kinds) == index ? visit(std::tuple_element_t<Kinds, WallKinds>()) : void()), ...);
  }
  (std::make_index_sequence<std::tuple_size_v<WallKinds>>());
}

/// Calls run.phase(Phase(), step) and run.walls() for the phases of a step, each of which begins when the one before
/// has ended.
template <class Run>
void run_step(Run& run, std::size_t step) {
  run.phase(MoveParticles(), step);
  run.walls();
  run.phase(SumJoints(), step);
  run.phase(AddMotion(), step);
  run.phase(ClearGrid(), step);
  run.phase(FileSegments(), step);
  run.phase(FindCandidates(), step);
  run.phase(EvaluateContacts(), step);
  run.phase(RubContacts(), step);
  run.phase(AddForces(), step);
  run.phase(AddPlates(), step);
}

}  // namespace cellcrush::HWY_NAMESPACE
