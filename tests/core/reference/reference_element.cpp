#include "core/reference/reference_element.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cellcrush::reference {
namespace {

/// Area and modulus of an element of the length l, which may be squashed (E5c).
struct SquashedBar {
  double area;
  double modulus;
};

SquashedBar squash(const ElementRule& rule, const ElementData& data, double length) {
  const double undeformed_area = data.depth * data.thickness;
  const double area = rule.constant_area ? undeformed_area : undeformed_area * data.undeformed_length / length;
  const double bound = 0.95 * data.undeformed_length;
  if (length >= bound) {
    return {area, data.material.modulus};
  }
  const double four_gyration_squared = 4.0 * data.thickness * data.thickness / 12.0;
  const double shortening = std::pow(length / bound, rule.constant_area ? 1.0 : 2.0);
  return {area, data.material.modulus * shortening * (1.0 + four_gyration_squared / (bound * bound)) /
                    (1.0 + four_gyration_squared / (length * length))};
}

/// Sums over the fibres of an element after a step. Moments are over A h, MPa.
struct Response {
  std::vector<Fibre> fibres;
  double axial = 0.0;           // N / A
  double moment_start = 0.0;    // m_1 / (A h)
  double moment_end = 0.0;      // m_2 / (A h)
  double plastic_work = 0.0;    // over the volume
  std::vector<double> moments;  // M_i / (A h) of the sections
};

/// One step of one element.
class Step {
 public:
  Step(const ElementRule& rule, const ElementData& data, const ElementEnds& ends, ElementHistory& history)
      : rule_(rule), history_(history), material_(data.material), thickness_(data.thickness) {
    const Vector span = ends.end - ends.start;
    length_ = span.norm();
    axis_ = span / length_;
    const double turn = std::atan2(cross(history.axis, axis_), history.axis.dot(axis_));  // Eq. 9, E3
    const double mean_length = 0.5 * (history.length + length_);                          // E5
    membrane_ = (length_ - history.length) / mean_length;                                 // Eq. 15, E5
    bend_start_ = (ends.turn_start - turn) / mean_length;                                 // Eq. 14, E4
    bend_end_ = (ends.turn_end - turn) / mean_length;                                     // Eq. 14, E4
    const SquashedBar bar = squash(rule, data, length_);
    area_ = bar.area;
    material_.modulus = bar.modulus;
  }

  ElementForces advance() {
    const Response response = rule_.force_based ? respond_in_balance() : respond(linear_curvatures());
    history_.axis = axis_;
    history_.length = length_;
    history_.fibres = response.fibres;
    history_.moment_start = response.moment_start;
    history_.moment_end = response.moment_end;
    const double moment_start = area_ * thickness_ * response.moment_start;  // Eq. 28, E7
    const double moment_end = area_ * thickness_ * response.moment_end;
    const double shear = -(moment_start + moment_end) / length_;                              // Eq. 31, E7
    const Vector force_on_end = area_ * response.axial * axis_ + shear * turned_left(axis_);  // Eq. 32, E7
    return {force_on_end, moment_start, moment_end, area_ * length_ * response.plastic_work};
  }

 private:
  /// Curvatures of the displacement-based element (Eq. 27).
  [[nodiscard]] std::vector<double> linear_curvatures() const {
    std::vector<double> curvatures;
    for (const auto& [s, weight] : rule_.sections) {
      curvatures.push_back((4.0 - 6.0 * s) * bend_start_ + (2.0 - 6.0 * s) * bend_end_);
    }
    return curvatures;
  }

  /// All fibres under given curvatures, from their histories at the start of the step.
  [[nodiscard]] Response respond(const std::vector<double>& curvatures) const {
    Response sum;
    sum.fibres = history_.fibres;
    for (std::size_t i = 0; i < rule_.sections.size(); ++i) {
      const auto [s, section_weight] = rule_.sections[i];
      double moment = 0.0;
      for (std::size_t j = 0; j < rule_.points.size(); ++j) {
        const auto [offset, point_weight] = rule_.points[j];
        Fibre& fibre = sum.fibres[i * rule_.points.size() + j];
        const double strain = membrane_ + offset * thickness_ * curvatures[i];  // E5
        const double plastic_strain = return_fibre(material_, strain, fibre);
        const double weight = section_weight * point_weight;
        moment += point_weight * offset * fibre.stress;                        // Eq. 28
        sum.axial += weight * fibre.stress;                                    // Eq. 28, E7
        sum.moment_start += weight * (4.0 - 6.0 * s) * offset * fibre.stress;  // Eq. 28, E7
        sum.moment_end += weight * (2.0 - 6.0 * s) * offset * fibre.stress;    // Eq. 28, E7
        sum.plastic_work += weight * fibre.stress * plastic_strain;            // E10
      }
      sum.moments.push_back(moment);
    }
    return sum;
  }

  /// The moment M(s) between two end moments (E5b).
  static double line(double s, double start, double end) { return (1.0 - s) * start - s * end; }

  /// Curvature over moment / (A h) of an elastic section: 1 / (E I) = 12 / (E A h^2).
  [[nodiscard]] double elastic_flexibility() const { return 12.0 / (material_.modulus * thickness_); }

  [[nodiscard]] bool is_rounding(double moment) const {
    return std::abs(moment) <= rule_.no_moment * material_.yield_stress;
  }

  /// Curvatures with which the moments M_i + dM_i lie on a line and the ends turn by the given angles over l_m (E5b). A
  /// yielded section that unloads becomes elastic, and the curvatures are found again.
  std::vector<double> balanced_curvatures(double moment_start, double moment_end, double bend_start, double bend_end) {
    std::vector<double> curvatures(rule_.sections.size());
    for (bool unloads = true; unloads;) {
      Eigen::Matrix2d flexibility = Eigen::Matrix2d::Zero();
      Eigen::Vector2d bends(bend_start, bend_end);
      for (std::size_t i = 0; i < rule_.sections.size(); ++i) {
        const auto [s, weight] = rule_.sections[i];
        const Eigen::Vector2d shape(1.0 - s, -s);                          // N_i
        const double f = elastic_flexibility() * history_.flexibility[i];  // f_i = 1 / (E I t_i)
        flexibility += weight * f * shape * shape.transpose();             // sum W_i f_i N_i N_i^T
        bends -= weight * f * history_.shortfall[i] * shape;               // turned by u_i
      }
      const Eigen::Vector2d increment = flexibility.inverse() * bends;  // dm_1, dm_2
      unloads = false;
      for (std::size_t i = 0; i < rule_.sections.size(); ++i) {
        const double s = rule_.sections[i].position;
        const double f = elastic_flexibility() * history_.flexibility[i];
        curvatures[i] = f * (line(s, increment[0], increment[1]) + history_.shortfall[i]);
        const double moment = line(s, moment_start, moment_end) - history_.shortfall[i];
        if (history_.flexibility[i] > 1.0 && !is_rounding(moment) && curvatures[i] * moment < 0.0) {
          history_.flexibility[i] = 1.0;
          unloads = true;
        }
      }
    }
    return curvatures;
  }

  /// Flexibility of a section, 1 / t_i, from what its moment gained in the step: 1 to 100.
  [[nodiscard]] double shown_flexibility(double elastic, double gained) const {
    const double shown = elastic / gained;
    if (!(shown > 0.0 && shown < 100.0)) {
      return 100.0;
    }
    return shown < 1.0 + rule_.no_softening ? 1.0 : shown;
  }

  /// Brings the sections' histories to a response. Returns whether all are in balance to 2 % of M_p = sigma_y A h / 4.
  bool remember_sections(const std::vector<double>& moments_before, const std::vector<double>& curvatures,
                         const Response& response) {
    double worst = 0.0;
    for (std::size_t i = 0; i < rule_.sections.size(); ++i) {
      const double elastic = curvatures[i] / elastic_flexibility();
      if (!is_rounding(elastic)) {
        history_.flexibility[i] = shown_flexibility(elastic, response.moments[i] - moments_before[i]);
      }
      const double line_moment = line(rule_.sections[i].position, response.moment_start, response.moment_end);
      const double shortfall = line_moment - response.moments[i];  // u_i
      history_.shortfall[i] = is_rounding(shortfall) ? 0.0 : shortfall;
      worst = std::max(worst, std::abs(shortfall));
    }
    return worst <= 0.02 * material_.yield_stress / 4.0;
  }

  /// The force-based element (E5b): at most four passes.
  Response respond_in_balance() {
    bool at_rest = true;
    for (std::size_t i = 0; i < rule_.sections.size(); ++i) {
      at_rest = at_rest && history_.flexibility[i] == 1.0 && history_.shortfall[i] == 0.0;
    }
    std::vector<double> curvatures =
        at_rest ? linear_curvatures()
                : balanced_curvatures(history_.moment_start, history_.moment_end, bend_start_, bend_end_);
    Response response = respond(curvatures);
    if (at_rest && response.plastic_work == 0.0) {
      return response;  // the linear curvatures of an elastic element have linear moments
    }
    std::vector<double> moments_before;
    for (std::size_t i = 0; i < rule_.sections.size(); ++i) {
      const double on_line = line(rule_.sections[i].position, history_.moment_start, history_.moment_end);
      moments_before.push_back(on_line - history_.shortfall[i]);
    }
    for (int pass = 1; !remember_sections(moments_before, curvatures, response) && pass < 4; ++pass) {
      const auto moved = balanced_curvatures(response.moment_start, response.moment_end, 0.0, 0.0);
      for (std::size_t i = 0; i < moved.size(); ++i) {
        curvatures[i] += moved[i];
      }
      response = respond(curvatures);
    }
    return response;
  }

  const ElementRule& rule_;
  ElementHistory& history_;
  Material material_;  // with the modulus of the squashed element
  double thickness_;
  Vector axis_;
  double length_;
  double membrane_;
  double bend_start_;  // theta_1 / l_m
  double bend_end_;    // theta_2 / l_m
  double area_;
};

}  // namespace

ElementHistory undeformed(const ElementRule& rule, const Vector& start, const Vector& end) {
  const Vector span = end - start;
  ElementHistory history;
  history.length = span.norm();
  history.axis = span / span.norm();
  history.fibres.resize(rule.sections.size() * rule.points.size());
  history.flexibility.assign(rule.sections.size(), 1.0);
  history.shortfall.assign(rule.sections.size(), 0.0);
  return history;
}

ElementForces advance_element(const ElementRule& rule, const ElementData& data, const ElementEnds& ends,
                              ElementHistory& history) {
  return Step(rule, data, ends, history).advance();
}

double elastic_energy(const ElementRule& rule, const ElementData& data, const ElementHistory& history) {
  const SquashedBar bar = squash(rule, data, history.length);
  double energy = 0.0;
  for (std::size_t f = 0; f < history.fibres.size(); ++f) {
    const double weight = rule.sections[f / rule.points.size()].weight * rule.points[f % rule.points.size()].weight;
    const double stress = history.fibres[f].stress;
    energy += weight * bar.area * history.length * stress * stress / (2.0 * bar.modulus);  // E10
  }
  return energy;
}

}  // namespace cellcrush::reference
