#include "core/reference/plane_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace cellcrush::reference {
namespace {

constexpr int kPoints = 4;  // of an element: nodes, and places of its stresses
constexpr double kDensity = 1.0;
constexpr int kForces = 2000;  // that are returned, means over as many spans

struct Vector {
  double x = 0.0;
  double y = 0.0;
};

Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y}; }
Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y}; }
Vector operator*(double s, Vector a) { return {s * a.x, s * a.y}; }
double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }
double cross(Vector a, Vector b) { return a.x * b.y - a.y * b.x; }

struct Stress {
  double xx = 0.0;
  double yy = 0.0;
  double zz = 0.0;
  double xy = 0.0;
  double plastic = 0.0;  // accumulated strain
};

struct Quad {
  std::array<int, kPoints> nodes{};
  std::array<Stress, kPoints> stresses{};
};

/// What a node at the end of an arc follows.
struct Clamp {
  Vector motion;
  bool is_held = false;
  bool is_read = false;  // of the first arc, and stands still
};

struct Surface {
  std::vector<int> nodes;                    // of the outer side, one after the other
  std::vector<std::array<int, 2>> segments;  // the body on their right
};

/// Derivatives of the shape functions at the points of stress, on the current shape.
struct Gradients {
  double x[kPoints][kPoints];
  double y[kPoints][kPoints];
  double mean_x[kPoints];
  double mean_y[kPoints];
  double area[kPoints];
};

class Solid {
 public:
  Solid(const std::vector<SolidArc>& arcs, const SolidMetal& metal, const SolidRun& run)
      : run_(run),
        shear_(metal.youngs_modulus / (2.0 * (1.0 + metal.poissons_ratio))),
        bulk_(metal.youngs_modulus / (3.0 * (1.0 - 2.0 * metal.poissons_ratio))),
        metal_(metal) {
    for (const SolidArc& arc : arcs) add_arc(arc);
    velocity_.resize(place_.size());
    force_.resize(place_.size());
    pushed_.resize(place_.size());
    rubbed_.assign(place_.size(), 0.0);
    mass_.assign(place_.size(), 0.0);
    for (const Quad& quad : quads_) {
      for (const int node : quad.nodes) mass_[node] += 0.25 * kDensity * area_of(quad);
    }
  }

  std::vector<SolidForce> advance() {
    double travel = 0.0;
    for (const Clamp& clamp : clamps_) travel = std::max(travel, std::hypot(clamp.motion.x, clamp.motion.y));
    const double wave_speed = std::sqrt((bulk_ + 4.0 / 3.0 * shear_) / kDensity);
    const double duration = travel / (run_.speed * wave_speed);
    const auto steps = static_cast<long>(duration / (0.375 * size_ / wave_speed));
    step_ = duration / static_cast<double>(steps);
    const long span = std::max(1L, steps / kForces);
    std::vector<SolidForce> forces;
    SolidForce mean;
    double share = 0.0;
    for (long i = 1; i <= steps; ++i) {
      std::ranges::fill(force_, Vector());
      std::ranges::fill(pushed_, Vector());
      touch();
      for (Quad& quad : quads_) deform(quad);
      for (std::size_t node = 0; node < clamps_.size(); ++node) {
        if (!clamps_[node].is_read) continue;
        mean.x += (force_[node].x - pushed_[node].x) / static_cast<double>(span);
        mean.y += (force_[node].y - pushed_[node].y) / static_cast<double>(span);
      }
      mean.share += share / static_cast<double>(span);
      if (i % span == 0) {
        forces.push_back(mean);
        mean = {};
      }
      const double rate = std::min(1.0, 50.0 * static_cast<double>(i) / static_cast<double>(steps)) / duration;
      move(rate);
      share += rate * step_;
    }
    return forces;
  }

 private:
  void add_arc(const SolidArc& arc) {
    constexpr double kRight = std::numbers::pi / 180.0;
    const double mean = 0.5 * (arc.inner + arc.outer);
    size_ = (arc.outer - arc.inner) / run_.across;
    const double angle = kRight * (arc.last.angle - arc.first.angle);
    const int along = static_cast<int>(std::lround(angle * mean / size_));
    const int first = static_cast<int>(place_.size());
    const auto number = [&](int i, int j) { return first + i * (run_.across + 1) + j; };
    Surface surface;
    for (int i = 0; i <= along; ++i) {
      const double at = kRight * arc.first.angle + angle * i / along;
      for (int j = 0; j <= run_.across; ++j) {
        const double radius = arc.inner + size_ * j;
        place_.push_back({arc.centre_x + radius * std::cos(at), arc.centre_y + radius * std::sin(at)});
        clamps_.push_back(i == 0       ? clamp_of(arc.first, first == 0)
                          : i == along ? clamp_of(arc.last, first == 0)
                                       : Clamp());
      }
      surface.nodes.push_back(number(i, run_.across));
      if (i > 0) surface.segments.push_back({number(i, run_.across), number(i - 1, run_.across)});
    }
    surfaces_.push_back(surface);
    for (int i = 0; i < along; ++i) {
      for (int j = 0; j < run_.across; ++j) {
        quads_.push_back({{number(i, j), number(i, j + 1), number(i + 1, j + 1), number(i + 1, j)}, {}});
      }
    }
  }

  [[nodiscard]] static Clamp clamp_of(const SolidEnd& end, bool is_of_first) {
    return {{end.motion_x, end.motion_y}, true, is_of_first && end.motion_x == 0.0 && end.motion_y == 0.0};
  }

  [[nodiscard]] double area_of(const Quad& quad) const {
    double area = 0.0;
    for (int k = 0; k < kPoints; ++k) {
      area += 0.5 * cross(place_[quad.nodes[k]], place_[quad.nodes[(k + 1) % kPoints]]);
    }
    return area;
  }

  [[nodiscard]] Gradients gradients_of(const Quad& quad) const {
    constexpr double kAt = 0.57735026918962576;
    constexpr double kX[kPoints] = {-1.0, 1.0, 1.0, -1.0};
    constexpr double kY[kPoints] = {-1.0, -1.0, 1.0, 1.0};
    Gradients of{};
    double area = 0.0;
    for (int q = 0; q < kPoints; ++q) {
      double by_x[kPoints];
      double by_y[kPoints];
      Vector along_x;
      Vector along_y;
      for (int k = 0; k < kPoints; ++k) {
        by_x[k] = 0.25 * kX[k] * (1.0 + kY[k] * kAt * kY[q]);
        by_y[k] = 0.25 * kY[k] * (1.0 + kX[k] * kAt * kX[q]);
        along_x = along_x + by_x[k] * place_[quad.nodes[k]];
        along_y = along_y + by_y[k] * place_[quad.nodes[k]];
      }
      of.area[q] = cross(along_x, along_y);
      for (int k = 0; k < kPoints; ++k) {
        of.x[q][k] = (along_y.y * by_x[k] - along_x.y * by_y[k]) / of.area[q];
        of.y[q][k] = (along_x.x * by_y[k] - along_y.x * by_x[k]) / of.area[q];
        of.mean_x[k] += of.x[q][k] * of.area[q];
        of.mean_y[k] += of.y[q][k] * of.area[q];
      }
      area += of.area[q];
    }
    for (int k = 0; k < kPoints; ++k) {
      of.mean_x[k] /= area;
      of.mean_y[k] /= area;
    }
    return of;
  }

  /// Stresses and nodal forces of an element; its volume strain is that of the whole element.
  void deform(Quad& quad) {
    const Gradients of = gradients_of(quad);
    for (int q = 0; q < kPoints; ++q) {
      double xx = 0.0;
      double yy = 0.0;
      double xy = 0.0;
      double yx = 0.0;
      double volume = 0.0;
      for (int k = 0; k < kPoints; ++k) {
        const Vector& v = velocity_[quad.nodes[k]];
        xx += of.x[q][k] * v.x;
        xy += of.y[q][k] * v.x;
        yx += of.x[q][k] * v.y;
        yy += of.y[q][k] * v.y;
        volume += of.mean_x[k] * v.x + of.mean_y[k] * v.y;
      }
      Stress& stress = quad.stresses[q];
      turn(0.5 * (yx - xy) * step_, stress);
      // Without its volume part, the strain of a point is its own.
      const double own = (xx + yy) / 3.0;
      flow({(xx - own) * step_, (yy - own) * step_, -own * step_, 0.5 * (xy + yx) * step_, 0.0}, volume * step_,
           stress);
      const double pressure = (stress.xx + stress.yy + stress.zz) / 3.0;
      for (int k = 0; k < kPoints; ++k) {
        Vector& force = force_[quad.nodes[k]];
        force.x +=
            of.area[q] * (of.x[q][k] * (stress.xx - pressure) + of.y[q][k] * stress.xy + of.mean_x[k] * pressure);
        force.y +=
            of.area[q] * (of.x[q][k] * stress.xy + of.y[q][k] * (stress.yy - pressure) + of.mean_y[k] * pressure);
      }
    }
  }

  static void turn(double angle, Stress& stress) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const auto [xx, yy, zz, xy, plastic] = stress;
    stress.xx = c * c * xx - 2.0 * c * s * xy + s * s * yy;
    stress.yy = s * s * xx + 2.0 * c * s * xy + c * c * yy;
    stress.xy = c * s * (xx - yy) + (c * c - s * s) * xy;
  }

  /// `shape`: strain increment without its volume part.
  void flow(const Stress& shape, double volume, Stress& stress) const {
    const double before = (stress.xx + stress.yy + stress.zz) / 3.0;
    Stress trial = {stress.xx - before + 2.0 * shear_ * shape.xx, stress.yy - before + 2.0 * shear_ * shape.yy,
                    stress.zz - before + 2.0 * shear_ * shape.zz, stress.xy + 2.0 * shear_ * shape.xy, stress.plastic};
    const double mises =
        std::sqrt(1.5 * (trial.xx * trial.xx + trial.yy * trial.yy + trial.zz * trial.zz + 2.0 * trial.xy * trial.xy));
    const double beyond = mises - metal_.yield_stress - metal_.hardening_modulus * stress.plastic;
    double share = 1.0;
    if (beyond > 0.0) {
      const double plastic = beyond / (3.0 * shear_ + metal_.hardening_modulus);
      trial.plastic += plastic;
      share = 1.0 - 3.0 * shear_ * plastic / mises;
    }
    const double pressure = before + bulk_ * volume;
    stress = {share * trial.xx + pressure, share * trial.yy + pressure, share * trial.zz + pressure, share * trial.xy,
              trial.plastic};
  }

  /// Half of the pressure by the nodes of either surface on the segments of the other.
  void touch() {
    for (std::size_t of = 0; surfaces_.size() > 1 && of < surfaces_.size(); ++of) {
      for (const int node : surfaces_[of].nodes) touch(node, surfaces_[1 - of]);
    }
  }

  void touch(int node, const Surface& on) {
    const double far = 6.0 * size_;
    double nearest = 2.0 * size_;
    const std::array<int, 2>* pressed = nullptr;
    for (const auto& segment : on.segments) {
      const Vector offset = place_[node] - place_[segment[0]];
      if (std::abs(offset.x) > far || std::abs(offset.y) > far) continue;
      const Vector along = place_[segment[1]] - place_[segment[0]];
      const double share = std::clamp(dot(offset, along) / dot(along, along), 0.0, 1.0);
      const Vector apart = offset - share * along;
      const double distance = std::sqrt(dot(apart, apart));
      if (distance < nearest) {
        nearest = distance;
        pressed = &segment;
      }
    }
    if (pressed == nullptr) {
      rubbed_[node] = 0.0;
      return;
    }
    const auto& [start, end] = *pressed;
    const Vector along = place_[end] - place_[start];
    const double share = std::clamp(dot(place_[node] - place_[start], along) / dot(along, along), 0.0, 1.0);
    const Vector tangent = (1.0 / std::sqrt(dot(along, along))) * along;
    const Vector normal = {-tangent.y, tangent.x};
    const double depth = -dot(place_[node] - place_[start] - share * along, normal);
    if (depth <= 0.0) {
      rubbed_[node] = 0.0;
      return;
    }
    const double stiffness = 0.5 * metal_.youngs_modulus * size_;
    const Vector slip = velocity_[node] - ((1.0 - share) * velocity_[start] + share * velocity_[end]);
    const double limit = run_.friction * stiffness * depth;
    rubbed_[node] = std::clamp(rubbed_[node] - stiffness * step_ * dot(slip, tangent), -limit, limit);
    const Vector force = stiffness * depth * normal + rubbed_[node] * tangent;
    pushed_[node] = pushed_[node] + force;
    pushed_[start] = pushed_[start] - (1.0 - share) * force;
    pushed_[end] = pushed_[end] - share * force;
  }

  /// `rate`: of the motion of the clamps, 1/s.
  void move(double rate) {
    // A fiftieth of the critical damping of the slowest mode: contacts that close would ring on.
    const double damping = 0.0006 * std::sqrt(metal_.youngs_modulus / kDensity) * step_;
    for (std::size_t i = 0; i < place_.size(); ++i) {
      const auto next = [&](double velocity, double force) {
        return ((1.0 - damping) * velocity + step_ * force / mass_[i]) / (1.0 + damping);
      };
      const Clamp& clamp = clamps_[i];
      velocity_[i].x = clamp.is_held ? rate * clamp.motion.x : next(velocity_[i].x, pushed_[i].x - force_[i].x);
      velocity_[i].y = clamp.is_held ? rate * clamp.motion.y : next(velocity_[i].y, pushed_[i].y - force_[i].y);
      place_[i] = place_[i] + step_ * velocity_[i];
    }
  }

  SolidRun run_;
  double shear_;
  double bulk_;
  SolidMetal metal_;
  double size_ = 0.0;  // mm, of elements
  double step_ = 0.0;
  std::vector<Vector> place_;
  std::vector<Vector> velocity_;
  std::vector<Vector> force_;   // of the elements, against the motion
  std::vector<Vector> pushed_;  // of contacts
  std::vector<double> rubbed_;  // friction along the segment
  std::vector<double> mass_;
  std::vector<Clamp> clamps_;  // of all nodes
  std::vector<Quad> quads_;
  std::vector<Surface> surfaces_;
};

}  // namespace

std::vector<SolidForce> move_arcs(const std::vector<SolidArc>& arcs, const SolidMetal& metal, const SolidRun& run) {
  return Solid(arcs, metal, run).advance();
}

}  // namespace cellcrush::reference
