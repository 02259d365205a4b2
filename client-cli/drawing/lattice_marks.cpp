#include "drawing/lattice_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace cellcrush::drawing {
namespace {

constexpr std::size_t kMostPlaces = 1000;  // of a kind

struct Words {
  const char* one;
  const char* many;
};

/// One for each kind.
const Words& words_of(v1::LatticeMarks::Kind kind) {
  static const std::map<v1::LatticeMarks::Kind, Words> kWords = {
      {v1::LatticeMarks::LOOSE_END, {"loose end", "loose ends"}},
      {v1::LatticeMarks::ISLAND, {"part is joined to nothing else", "parts are joined to nothing else"}},
      {v1::LatticeMarks::DUPLICATE, {"wall was drawn twice", "walls were drawn twice"}},
      {v1::LatticeMarks::COVERED, {"wall lies partly on another", "walls lie partly on others"}},
      {v1::LatticeMarks::CROSSING, {"crossing of walls", "crossings of walls"}},
      {v1::LatticeMarks::BOND,
       {"pair of walls face to face: bonded into one of both thicknesses",
        "pairs of walls face to face: bonded into one of both thicknesses"}},
      {v1::LatticeMarks::OVERLAP, {"overlap of walls before loading", "overlaps of walls before loading"}},
      {v1::LatticeMarks::SLOWEST_WALL, {"wall sets the time step", "walls set the time step"}},
      {v1::LatticeMarks::RIGID_LINK, {"rigid link", "rigid links"}},
  };
  static const Words kUnknown = {"place", "places"};
  const auto found = kWords.find(kind);
  return found == kWords.end() ? kUnknown : found->second;
}

}  // namespace

std::vector<DrawnPlace> find_loose_ends(const Net& net) {
  std::vector<int> walls(net.joints.size(), 0);
  for (const auto& [start, end] : net.walls) {
    ++walls[start];
    ++walls[end];
  }
  std::vector<DrawnPlace> loose;
  for (std::size_t joint = 0; joint < net.joints.size(); ++joint) {
    if (walls[joint] == 1) loose.push_back(net.joints[joint]);
  }
  return loose;
}

std::vector<DrawnPlace> find_islands(const Net& net) {
  std::vector<int> parent(net.joints.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root_of = [&](int joint) {
    while (parent[joint] != joint) joint = parent[joint] = parent[parent[joint]];
    return joint;
  };
  for (const auto& [start, end] : net.walls) {
    const int one = root_of(start);
    const int other = root_of(end);
    parent[std::max(one, other)] = std::min(one, other);
  }
  std::map<int, int> walls;
  for (const auto& [start, end] : net.walls) ++walls[root_of(start)];
  const auto largest = std::ranges::max_element(walls, {}, [](const auto& part) { return part.second; });
  std::vector<DrawnPlace> islands;
  for (const auto& [root, count] : walls) {
    if (root != largest->first) islands.push_back(net.joints[root]);
  }
  return islands;
}

void add_marks(v1::LatticeMarks::Kind kind, const std::vector<DrawnPlace>& places,
               google::protobuf::RepeatedPtrField<v1::LatticeMarks>& marks) {
  if (places.empty()) return;
  v1::LatticeMarks& of_kind = *marks.Add();
  const Words& words = words_of(kind);
  of_kind.set_kind(kind);
  of_kind.set_words(fmt::format("{} {}", places.size(), places.size() == 1 ? words.one : words.many));
  of_kind.set_count(static_cast<int>(places.size()));
  for (std::size_t i = 0; i < std::min(places.size(), kMostPlaces); ++i) {
    of_kind.add_places_mm(places[i].x);
    of_kind.add_places_mm(places[i].y);
  }
}

std::string marks_text(const v1::LatticeMarks& marks) {
  constexpr int kShown = 5;
  std::string text = marks.words() + ", at ";
  const int shown = std::min(marks.count(), kShown);
  for (int i = 0; i < shown; ++i) {
    text += fmt::format("{}({:.6g}, {:.6g})", i == 0 ? "" : ", ", marks.places_mm(2 * i), marks.places_mm(2 * i + 1));
  }
  text += " mm";
  return marks.count() > kShown ? text + fmt::format(" and {} more", marks.count() - kShown) : text;
}

}  // namespace cellcrush::drawing
