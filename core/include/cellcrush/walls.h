#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "cellcrush/tuning.h"
#include "cellcrush/vector.h"

namespace cellcrush {

// What a mesh consists of: elements, walls and the blocks that they are computed in, rigid bodies, pins.

/// A beam element: its nodes and its rectangular section.
struct Element {
  int start = 0;
  int end = 0;
  double thickness = 0.0;  ///< h, mm
  int material = 0;        ///< into Scene::materials
};

constexpr bool share_a_node(const Element& a, const Element& b) {
  return a.start == b.start || a.start == b.end || a.end == b.start || a.end == b.end;
}

/// Walls with the same number of elements, side by side. Element j of wall w of the block has the index first_element +
/// j * walls + w. The particle at its end, if inside the wall, has the index first_inner + j * walls + w. The history
/// of elements is stored in the same order, so that one loop computes the walls of a block side by side.
struct WallBlock {
  int first_wall = 0;  ///< into the arrays of Walls
  int walls = 0;       ///< 1 ... kMostWallsInBlock
  int elements = 0;    ///< of each wall
  int first_element = 0;
  int first_inner = 0;

  /// Whether force-based elements are solved two by two (E5b): the particle at the end of every other element then has
  /// no rotation.
  [[nodiscard]] constexpr bool has_pairs() const { return elements % 2 == 0; }
};

/// The W walls between joints, block by block, in C chunks. All elements of a wall are alike.
struct Walls {
  std::vector<WallBlock> blocks;
  /// C + 1, into blocks: the first block of each chunk, then the end. A loop of a thread computes one chunk at a time.
  std::vector<int> chunk_offset;
  std::vector<int> first_joint;           ///< C, no joint from this one on has walls in an earlier chunk
  std::vector<int> end_joint;             ///< C, no joint before this one has walls in a later chunk
  std::vector<int> start;                 ///< W, particle
  std::vector<int> end;                   ///< W, particle
  std::vector<double> thickness;          ///< W, mm
  std::vector<double> undeformed_length;  ///< W, mm, l_0 of one element
  std::vector<int> material;              ///< W, into Scene::materials
  std::vector<double> shear;              ///< W, phi of E5i; empty if the walls do not shear

  [[nodiscard]] int chunk_count() const { return static_cast<int>(chunk_offset.size()) - 1; }
};

/// A part of the lattice with consecutive walls and particles. Its balls are those of its particles.
struct LatticeBand {
  int first_chunk = 0;  ///< of Walls
  int end_chunk = 0;
  int first_joint = 0;  ///< particles
  int end_joint = 0;
  int first_inner = 0;  ///< particles inside walls
  int end_inner = 0;

  [[nodiscard]] bool owns(int particle) const {
    return (particle >= first_joint && particle < end_joint) || (particle >= first_inner && particle < end_inner);
  }
};

/// Parts that move without deforming (E13), B of them: stiff cells, or rigid links. Their particles come first, body by
/// body. Their walls have one element each and come last; they carry no stress, but other walls can touch them.
struct RigidBodies {
  std::vector<int> offset;      ///< B + 1, into particles; empty if there are no bodies
  std::vector<Vector2> centre;  ///< B, centre of mass before loading, mm
  std::vector<double> mass;     ///< B, tonne
  std::vector<double> inertia;  ///< B, about the centre, tonne mm^2
  int first_element = 0;
  bool are_joints = false;  ///< of the size of their walls (scene/rigid_joints.h), beside stiff cells and links
  std::size_t links = 0;    ///< elements that are rigid because they are short (scene/rigid_links.h): all or none

  [[nodiscard]] std::size_t count() const { return mass.size(); }
  [[nodiscard]] int particle_count() const { return offset.empty() ? 0 : offset.back(); }
};

/// Where the joints and walls of a mesh are in the lists of the case: the nodes and beams of a frame, the joints and
/// walls of a network or of a generator. Rigid walls come last, and their joints first; walls that fill a block come
/// together (lattice/layout.h). Empty if all are in the order of the lists.
struct ListOrder {
  std::vector<int> joint;  ///< of each joint, as an index into the list
  std::vector<int> wall;   ///< of each wall, then of each rigid element

  [[nodiscard]] int listed_joint(int index) const { return joint.empty() ? index : joint[index]; }
  [[nodiscard]] int listed_wall(int index) const { return wall.empty() ? index : wall[index]; }
  [[nodiscard]] int wall_of(int listed) const {
    return wall.empty() ? listed : static_cast<int>(std::ranges::find(wall, listed) - wall.begin());
  }
  /// The same of lists of which `before` tells the order: of the two changes one after the other.
  [[nodiscard]] ListOrder after(const ListOrder& before) const {
    ListOrder both = *this;
    for (int& index : both.joint) index = before.listed_joint(index);
    for (int& index : both.wall) index = before.listed_wall(index);
    return {both.joint.empty() ? before.joint : both.joint, both.wall.empty() ? before.wall : both.wall};
  }
};

/// Joints that move alike but turn on their own, because ends of beams are pinned there (E16): a node and the joints of
/// its pinned ends. P pins.
struct Pins {
  std::vector<int> offset;  ///< P + 1, into joint; empty if there are no pins
  std::vector<int> joint;   ///< pin by pin; the node comes first

  [[nodiscard]] std::size_t count() const { return offset.empty() ? 0 : offset.size() - 1; }
  [[nodiscard]] std::span<const int> joints_of(std::size_t pin) const {
    return std::span(joint).subspan(static_cast<std::size_t>(offset[pin]),
                                    static_cast<std::size_t>(offset[pin + 1] - offset[pin]));
  }
};

}  // namespace cellcrush
