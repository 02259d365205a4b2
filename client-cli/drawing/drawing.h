#pragma once

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace cellcrush::drawing {

/// A drawing that cannot be read or joined. The message says what is wrong, where, and what to do.
class DrawingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws DrawingError.
[[noreturn]] void refuse(const std::string& message);

/// Most lines of a drawing.
inline constexpr std::size_t kMostLines = 400'000;

/// A place in a drawing.
struct DrawnPlace {
  double x = 0.0;
  double y = 0.0;
  bool operator==(const DrawnPlace&) const = default;
};

inline double distance(const DrawnPlace& one, const DrawnPlace& other) {
  return std::hypot(one.x - other.x, one.y - other.y);
}

/// A line of a drawing, straight or an arc of a circle, in the units of the file.
struct DrawnWall {
  DrawnPlace start;
  DrawnPlace end;
  double rise = 0.0;                ///< of the arc over its chord, to the left of start to end
  std::optional<double> thickness;  ///< in the file's units; none: the file does not say
  std::string name;                 ///< of the line in the file, for messages: "line 12"
};

/// What a file has of walls.
struct Drawing {
  std::vector<DrawnWall> walls;
  std::optional<double> mm_per_unit;  ///< none: the file does not say
  std::vector<std::string> left_out;  ///< what is drawn, but no wall: "3 TEXT"

  /// Throws DrawingError if there are more than kMostLines.
  void add(DrawnWall wall);
};

/// The arc of a circle counterclockwise from one angle to another (rad), in walls of at most a quarter of a turn.
/// Throws DrawingError for an angle that is not finite.
std::vector<DrawnWall> walls_of_arc(const DrawnPlace& centre, double radius, double from, double to,
                                    const std::string& name);

// Readers, one a format. `text` is the file's content, `file` its name for messages. Throw DrawingError with file, line
// and what is expected.

Drawing read_csv_drawing(const std::string& text, const std::string& file);
/// Nodes in one file, walls between them in another.
Drawing read_csv_drawing(const std::string& nodes, const std::string& nodes_file, const std::string& edges,
                         const std::string& edges_file);
Drawing read_json_drawing(const std::string& text, const std::string& file);
Drawing read_dxf_drawing(const std::string& text, const std::string& file);
Drawing read_svg_drawing(const std::string& text, const std::string& file);
Drawing read_abaqus_drawing(const std::string& text, const std::string& file);
Drawing read_gmsh_drawing(const std::string& text, const std::string& file);

/// A file by its name and content.
struct NamedText {
  std::string name;
  std::string text;
};

/// Whether a file of this name may be a drawing, by its ending. Not so for .json, which may also be a case.
bool names_drawing(const std::string& file);

/// Reads one file by the ending of its name: .csv, .json, .dxf, .svg, .inp, .msh; or two .csv of nodes and edges.
/// Throws DrawingError for any other, and what the readers throw.
Drawing read_drawing(const std::vector<NamedText>& files);

}  // namespace cellcrush::drawing
