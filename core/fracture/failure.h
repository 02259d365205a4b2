#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

// When a wall breaks (E6g). A surface of a section fails where its plastic strain in tension, as a mean over a length
// of one wall thickness, reaches the failure strain of the material; the wall then breaks at the nearer end of the
// elements that are solved together. A mesh has a hinge in one section and a neck in any of the elements of a wall,
// however long they are: the mean makes the energy of a broken wall independent of it.
//   Bending:     the strains of the sections within a thickness. A section that stands for more is taken as a hinge.
//   Stretching:  what the wall has stretched by beyond even stretching (Considere), over a thickness. The strain of the
//                middle of a section counts no further than that, and by a yield strain. In bending, the few fibres of
//                a section let its neutral axis wander by a thirteenth of the thickness: what that can stretch it by
//                is taken off.
// Plastic strains are net: shortening is taken from stretching, so that a surface that is only compressed does not
// fail, and cycles do no damage of their own. The rate and the state of stress have no influence.

/// An end of a wall (Scene::walls) that breaks off its joint.
struct FailedEnd {
  int wall = 0;
  bool at_end = false;
  double energy = 0.0;  ///< N mm, plastic work of the section that failed
};

/// Finds sections that have failed. Keeps its scratch from step to step.
class FailureSearch {
 public:
  /// REQUIRES: Scene::can_break. Its materials stay the same from then on.
  explicit FailureSearch(const Scene& scene);

  /// Follows the fibres over the newest step (State::net_strain). Finds at most one end of each chain (Scene::chain)
  /// that can part, where the strain is greatest over that at failure; by wall.
  std::vector<FailedEnd> find(const Scene& scene, State& state);

 private:
  /// Plastic strain of a section, and what it stands for.
  struct SectionStrain {
    double even = 0.0;   ///< of its middle, positive where it is stretched
    double bend = 0.0;   ///< half of the difference of its surfaces, left less right
    double place = 0.0;  ///< mm, from the start of the unit
    double from = 0.0;   ///< mm, the length that it stands for
    double to = 0.0;
  };
  /// Elements that are solved together, of which some fibres have yielded or are near it.
  struct Unit {
    int wall = 0;
    const WallBlock* block = nullptr;
    int chain = 0;
    std::size_t first_section = 0;  ///< into sections_
    std::size_t end_section = 0;
    double neck = 0.0;  ///< mm, elongation beyond even stretching
    bool broken_start = false;
    bool broken_end = false;
  };
  struct Worst {
    int chain = 0;
    double reached = 0.0;  ///< strain over that at failure
    const Unit* unit = nullptr;
    std::size_t section = 0;
  };

  void collect(const Scene& scene, State& state);
  [[nodiscard]] double beyond_even(const Scene& scene, const State& state, int element, int wall) const;
  void add_unit(const Scene& scene, const State& state, int wall, const WallBlock& block);
  [[nodiscard]] FailedEnd end_at(const Scene& scene, const State& state, const Worst& worst) const;
  [[nodiscard]] Worst worst_of(const Scene& scene, const Unit& unit) const;

  std::vector<double> even_;  ///< of each material, plastic strain up to which a wall stretches evenly
  std::vector<Unit> units_;
  std::vector<SectionStrain> sections_;
  std::vector<double> neck_;  ///< mm, of each chain: elongation beyond even stretching
};

}  // namespace cellcrush
