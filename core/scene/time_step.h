#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// Share of the stable step that a chosen step takes.
inline constexpr double kStepFraction = 0.9;

/// The step of a run in s: the one that is asked for, or kStepFraction of the stable step, or the time in which the plate
/// moves by a twentieth of the thinnest wall, if that is less: walls approach each other by up to 1.7 times that in a step,
/// and a contact is born as deep.
double time_step_of(const SceneSpec& spec, const Scene& scene);

/// Penalty stiffness in N/mm,
///   k = stiffness_factor m_min / tau^2,  tau = min(dt_crit, 0.1 h / V),
/// with which a free particle at plate speed V sinks into the thinnest wall h by a fifth of it at most (stiffness_factor 0.25).
/// It follows from mesh and speed and not from the step, so that refining the step converges to one solution; only a given
/// step that is too long for it bounds it. Frames have no plate speed.
double penalty_stiffness(const SceneSpec& spec, const Scene& scene);

/// How far beyond touch contact candidates are collected, mm: a share of the shortest element.
double contact_skin(const Scene& scene);

}  // namespace cellcrush
