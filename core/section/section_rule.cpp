#include "section/section_rule.h"

#include "section/quadrature.h"

namespace cellcrush {

SectionRule make_section_rule(int axial_points, int depth_points) {
  const Quadrature along = gauss_rule(axial_points);
  const Quadrature through = lobatto_rule(depth_points);
  const Eigen::Index count = static_cast<Eigen::Index>(axial_points) * depth_points;
  SectionRule rule{axial_points, depth_points, Eigen::ArrayXd(count), Eigen::ArrayXd(count), Eigen::ArrayXd(count)};
  Eigen::Index fibre = 0;
  for (std::size_t i = 0; i < along.points.size(); ++i) {
    const double s = 0.5 * (1.0 + along.points[i]);
    for (std::size_t j = 0; j < through.points.size(); ++j) {
      const double offset = 0.5 * through.points[j];
      rule.start_factor[fibre] = (4.0 - 6.0 * s) * offset;
      rule.end_factor[fibre] = (2.0 - 6.0 * s) * offset;
      rule.weight[fibre] = 0.25 * along.weights[i] * through.weights[j];
      ++fibre;
    }
  }
  return rule;
}

}  // namespace cellcrush
