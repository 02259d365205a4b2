#include "drawing/svg_path.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>

namespace cellcrush::drawing {
namespace {

constexpr int kChords = 16;

DrawnPlace operator+(const DrawnPlace& one, const DrawnPlace& other) { return {one.x + other.x, one.y + other.y}; }
DrawnPlace operator*(double factor, const DrawnPlace& place) { return {factor * place.x, factor * place.y}; }

/// Reads numbers, flags and letters of path data one after another.
class PathText {
 public:
  explicit PathText(std::string_view text) : rest_(text) {}

  bool is_at_end() {
    skip_blanks();
    return rest_.empty();
  }
  bool is_at_letter() { return !is_at_end() && std::isalpha(static_cast<unsigned char>(rest_.front())) != 0; }
  char letter() {
    const char letter = rest_.front();
    rest_.remove_prefix(1);
    return letter;
  }
  double number() {
    skip_blanks();
    if (!rest_.empty() && rest_.front() == '+') rest_.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc()) {
      refuse(fmt::format("\"{}\": is not what follows in a path or a list of numbers of SVG.", rest_.substr(0, 20)));
    }
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }
  /// 0 or 1, which need no blank behind.
  bool flag() {
    skip_blanks();
    return !rest_.empty() && letter() == '1';
  }

 private:
  void skip_blanks() {
    const auto next = rest_.find_first_not_of(" ,\t\r\n");
    rest_.remove_prefix(std::min(next, rest_.size()));
  }
  std::string_view rest_;
};

class PathReader {
 public:
  explicit PathReader(std::string_view data) : text_(data) {}

  std::vector<std::vector<DrawnPlace>> read() {
    char command = 'M';
    while (!text_.is_at_end()) {
      if (text_.is_at_letter()) command = text_.letter();
      obey(command);
      if (command == 'M') command = 'L';
      if (command == 'm') command = 'l';
    }
    return std::move(chains_);
  }

 private:
  DrawnPlace place(bool is_relative) {
    const double x = text_.number();
    const double y = text_.number();
    return is_relative ? DrawnPlace{at_.x + x, at_.y + y} : DrawnPlace{x, y};
  }

  void obey(char command) {
    const bool is_relative = std::islower(static_cast<unsigned char>(command)) != 0;
    DrawnPlace control = at_;  // of a smooth curve that follows
    switch (std::toupper(static_cast<unsigned char>(command))) {
      case 'M': chains_.push_back({begin_ = place(is_relative)}); break;
      case 'L': line_to(place(is_relative)); break;
      case 'H': line_to({text_.number() + (is_relative ? at_.x : 0.0), at_.y}); break;
      case 'V': line_to({at_.x, text_.number() + (is_relative ? at_.y : 0.0)}); break;
      case 'Z': line_to(begin_); break;
      case 'C': {
        const DrawnPlace first = place(is_relative);
        control = place(is_relative);
        cubic(first, control, place(is_relative));
        break;
      }
      case 'S': {
        const DrawnPlace first = mirrored('C');
        control = place(is_relative);
        cubic(first, control, place(is_relative));
        break;
      }
      case 'Q':
        control = place(is_relative);
        quadratic(control, place(is_relative));
        break;
      case 'T':
        control = mirrored('Q');
        quadratic(control, place(is_relative));
        break;
      case 'A': arc(is_relative); break;
      default: refuse(fmt::format("{}: is no command of a path of SVG.", command));
    }
    if (std::toupper(static_cast<unsigned char>(command)) == 'M') at_ = begin_;
    last_ = static_cast<char>(std::toupper(static_cast<unsigned char>(command)));
    control_ = control;
  }

  /// The mirrored control point of the curve before, if that was of the same kind.
  [[nodiscard]] DrawnPlace mirrored(char kind) const {
    const bool follows = last_ == kind || last_ == (kind == 'C' ? 'S' : 'T');
    return follows ? DrawnPlace{2.0 * at_.x - control_.x, 2.0 * at_.y - control_.y} : at_;
  }

  void line_to(const DrawnPlace& to) {
    if (chains_.empty()) chains_.push_back({at_});
    if (chains_.back().empty()) chains_.back().push_back(at_);
    if (++count_ > kMostLines) refuse(fmt::format("A path of the SVG file has more than {} lines.", kMostLines));
    chains_.back().push_back(at_ = to);
  }

  void cubic(const DrawnPlace& first, const DrawnPlace& second, const DrawnPlace& end) {
    const DrawnPlace start = at_;
    for (int i = 1; i <= kChords; ++i) {
      const double t = static_cast<double>(i) / kChords;
      const double s = 1.0 - t;
      line_to(i == kChords ? end
                           : s * s * s * start + 3.0 * s * s * t * first + 3.0 * s * t * t * second + t * t * t * end);
    }
  }

  void quadratic(const DrawnPlace& control, const DrawnPlace& end) {
    const DrawnPlace start = at_;
    for (int i = 1; i <= kChords; ++i) {
      const double t = static_cast<double>(i) / kChords;
      const double s = 1.0 - t;
      line_to(i == kChords ? end : s * s * start + 2.0 * s * t * control + t * t * end);
    }
  }

  /// SVG 2, B.2.4: from end points to the centre of the ellipse.
  void arc(bool is_relative) {
    double rx = std::abs(text_.number());
    double ry = std::abs(text_.number());
    const double turn = text_.number() * std::numbers::pi / 180.0;
    const bool is_large = text_.flag();
    const bool sweeps = text_.flag();
    const DrawnPlace start = at_;
    const DrawnPlace end = place(is_relative);
    if (rx == 0.0 || ry == 0.0 || start == end) return line_to(end);
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    const DrawnPlace half = {0.5 * (start.x - end.x), 0.5 * (start.y - end.y)};
    const DrawnPlace p = {c * half.x + s * half.y, -s * half.x + c * half.y};
    const double excess = p.x * p.x / (rx * rx) + p.y * p.y / (ry * ry);
    if (excess > 1.0) {
      rx *= std::sqrt(excess);
      ry *= std::sqrt(excess);
    }
    const double square = rx * rx * p.y * p.y + ry * ry * p.x * p.x;
    const double factor =
        (is_large == sweeps ? -1.0 : 1.0) * std::sqrt(std::max(0.0, rx * rx * ry * ry / square - 1.0));
    const DrawnPlace q = {factor * rx * p.y / ry, -factor * ry * p.x / rx};
    const DrawnPlace centre = {c * q.x - s * q.y + 0.5 * (start.x + end.x),
                               s * q.x + c * q.y + 0.5 * (start.y + end.y)};
    const double from = std::atan2((p.y - q.y) / ry, (p.x - q.x) / rx);
    double sweep = std::atan2((-p.y - q.y) / ry, (-p.x - q.x) / rx) - from;
    if (sweeps && sweep < 0.0) sweep += 2.0 * std::numbers::pi;
    if (!sweeps && sweep > 0.0) sweep -= 2.0 * std::numbers::pi;
    for (int i = 1; i <= kChords; ++i) {
      const double angle = from + sweep * i / kChords;
      const DrawnPlace on = {rx * std::cos(angle), ry * std::sin(angle)};
      line_to(i == kChords ? end : DrawnPlace{centre.x + c * on.x - s * on.y, centre.y + s * on.x + c * on.y});
    }
  }

  PathText text_;
  std::vector<std::vector<DrawnPlace>> chains_;
  DrawnPlace at_;
  DrawnPlace begin_;
  DrawnPlace control_;
  char last_ = 'M';
  std::size_t count_ = 0;  ///< of chords
};

}  // namespace

std::vector<double> svg_numbers(std::string_view text) {
  PathText rest(text);
  std::vector<double> numbers;
  while (!rest.is_at_end()) numbers.push_back(rest.number());
  return numbers;
}

std::vector<std::vector<DrawnPlace>> flatten_svg_path(std::string_view data) { return PathReader(data).read(); }

}  // namespace cellcrush::drawing
