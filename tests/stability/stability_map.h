#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cellcrush/simulation.h"
#include "chart/canvas.h"

namespace cellcrush::stability {

/// How a crush at fixed numerics goes.
enum class Outcome {
  stable,
  drifting,  ///< the ledger open, or energy made by contacts, by more than 1 % of the work done
  lost       ///< ended by the solver's check
};
std::string name_of(Outcome outcome);

/// Numerics of one crush of a small specimen. `penalty` is k dt_crit^2 / m of the lightest particle.
struct Point {
  double speed = 0.0;  ///< m/s
  double penalty = 0.0;
  double step = 0.0;  ///< dt / dt_crit of the undeformed mesh
};

struct Result {
  Point point;
  bool is_chosen = false;  ///< the point is the solver's own choice, not one of the grid
  Outcome outcome = Outcome::stable;
  RunStatus::Kind status = RunStatus::Kind::finished;
  double energy_error = 0.0;    ///< greatest |residual| over the work done
  double contact_energy = 0.0;  ///< greatest energy that contacts had made, over the work done
  double deepest_penetration = 0.0;
  double end_strain = 0.0;
};

/// The grid: every speed with every penalty and every step.
struct Grid {
  std::vector<double> speeds = {25.0, 50.0, 100.0, 200.0, 400.0};
  std::vector<double> penalties = {0.01, 0.03, 0.12, 0.3, 1.0, 3.0};
  std::vector<double> steps = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.98, 1.02, 1.1};
};

/// Crushes a specimen of 12 x 6 cells to 60 % strain with the given numerics. `lattice` is "hexagon", "square" or
/// "triangle".
Result crush(const std::string& lattice, const Point& point);

/// All crushes of a grid, speed by speed, penalty by penalty, step by step; `told` hears of each.
std::vector<Result> crush_all(const std::string& lattice, const Grid& grid,
                              const std::function<void(const Result&)>& told);

/// The crushes with what the solver chooses by itself, one a speed.
std::vector<Result> crush_defaults(const std::string& lattice, const Grid& grid,
                                   const std::function<void(const Result&)>& told);

/// A line of names and a line a result.
std::string as_csv(const std::vector<Result>& results);

/// The bytes of a picture of a grid: a panel a speed, steps across, penalties up, the energy error in each cell, and a
/// ring where the solver's own choice lies. REQUIRES: `results` are those of the grid, `defaults` one a speed.
std::string draw_map(client::PictureFormat format, const Grid& grid, const std::vector<Result>& results,
                     const std::vector<Result>& defaults, const std::string& title);

}  // namespace cellcrush::stability
