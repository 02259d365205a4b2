#include "core/oracle/random_motions.h"

#include <cmath>
#include <random>

#include "core/oracle/lattice_of_scene.h"

namespace cellcrush {
namespace {

/// Random numbers that are the same everywhere.
class Draw {
 public:
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }

 private:
  std::mt19937_64 generator_{20261123};
};

/// A number that goes up and down between two bounds in random strides.
class Walk {
 public:
  Walk(double start, double low, double high, double stride)
      : value_(start), low_(low), high_(high), most_(std::abs(stride)), stride_(stride) {}

  double next(Draw& draw) {
    if (draw.between(0.0, 1.0) < 0.04) {
      stride_ = draw.between(-most_, most_);
    }
    if (value_ + stride_ < low_ || value_ + stride_ > high_) {
      stride_ = -stride_;
    }
    return value_ += stride_;
  }

 private:
  double value_;
  double low_;
  double high_;
  double most_;
  double stride_;
};

/// Displacements of a particle over the steps.
struct Path {
  std::vector<double> x = {0.0};
  std::vector<double> y = {0.0};
  std::vector<double> rotation = {0.0};
};

void follow(Scene& scene, int particle, const Path& path) {
  const auto impose = [&](Hold& hold, const std::vector<double>& values) {
    hold = {true, static_cast<int>(scene.motions.size())};
    TimeFunction motion;
    for (std::size_t n = 0; n < values.size(); ++n) {
      motion.points.emplace_back(static_cast<double>(n) * scene.schedule.time_step, values[n]);
    }
    scene.motions.push_back(motion);
  };
  impose(scene.supports[particle].x, path.x);
  impose(scene.supports[particle].y, path.y);
  impose(scene.supports[particle].rotation, path.rotation);
}

/// Paths of the nodes of a beam whose elements stretch, are squashed, bend, drift and turn many times.
std::vector<Path> paths_of(const std::vector<Vector2>& nodes, double stride, double first_stretch, int steps,
                           Draw& draw) {
  const Vector2 span = nodes.back() - nodes.front();
  const double angle = std::atan2(span.y(), span.x());
  Walk turn(0.0, -1e9, 1e9, draw.between(0.0, 0.15));
  Walk drift(0.0, -50.0, 50.0, 0.1);
  std::vector<Walk> stretches(nodes.size() - 1, Walk(1.0, 0.35, 1.25, first_stretch));
  std::vector<Walk> kinks(nodes.size() - 1, Walk(0.0, -0.3, 0.3, stride));
  std::vector<Walk> bends(nodes.size(), Walk(0.0, -0.6, 0.6, 4.0 * stride));
  std::vector<Path> paths(nodes.size());
  for (int n = 0; n < steps; ++n) {
    const double turned = turn.next(draw);
    Vector2 at = nodes.front() + Vector2(drift.next(draw), drift.next(draw));
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (k > 0) {
        const double direction = angle + turned + kinks[k - 1].next(draw);
        at += (nodes[k] - nodes[k - 1]).norm() * stretches[k - 1].next(draw) *
              Vector2(std::cos(direction), std::sin(direction));
      }
      paths[k].x.push_back(at.x() - nodes[k].x());
      paths[k].y.push_back(at.y() - nodes[k].y());
      paths[k].rotation.push_back(turned + bends[k].next(draw));
    }
  }
  return paths;
}

}  // namespace

std::vector<int> nodes_of(const Scene& scene, const std::vector<int>& wall) {
  std::vector<int> nodes = {scene.elements[wall.front()].start};
  for (const int e : wall) {
    nodes.push_back(scene.elements[e].end);
  }
  return nodes;
}

void impose_random_motions(Scene& scene, int steps) {
  Draw draw;
  scene.supports.assign(scene.particle_count(), {});
  const std::vector<std::vector<int>> walls = walls_of(scene);
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const std::vector<int> nodes = nodes_of(scene, walls[w]);
    std::vector<Vector2> positions;
    for (const int node : nodes) {
      positions.push_back(scene.position[node]);
    }
    const double stride = std::pow(10.0, draw.between(-4.5, -2.1));  // of strain; the yield strain is 1.1e-3
    const std::vector<Path> paths = paths_of(positions, stride, w % 2 == 0 ? stride : -stride, steps, draw);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      follow(scene, nodes[k], paths[k]);
    }
  }
}

}  // namespace cellcrush
