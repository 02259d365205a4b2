#include "jobs/sweep_points.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "columns/result_columns.h"
#include "columns/swept_fields.h"
#include "error.h"
#include "jobs/case_field.h"

namespace cellcrush::jobs {
namespace {

const char* const kFewer = "Use at most 100000 in one sweep; more can be split among several sweeps.";
constexpr int kMostFields = 32;
constexpr std::size_t kLongestField = 256;

void check_fields(const std::vector<std::string>& fields, const std::string& subject) {
  if (fields.size() > kMostFields)
    throw InvalidField(subject, "vary " + std::to_string(fields.size()) + " fields.", "Vary at most 32.");
  for (const auto& field : fields) {
    if (field.size() > kLongestField)
      throw InvalidField(subject, "name a field of " + std::to_string(field.size()) + " bytes.", "Use at most 256.");
  }
}

std::string axis_field(int axis) { return "sweep.axes[" + std::to_string(axis) + "]"; }

// `at(step, steps)` gives the value after `step` of `steps` steps.
std::vector<double> spaced(const v1::SweepAxis::Range& range, const std::string& name,
                           const std::function<double(double, double)>& at) {
  if (!std::isfinite(range.first()) || !std::isfinite(range.last()))
    throw InvalidField(name, "has a non-finite end.", "Use two finite ends.");
  if (range.count() < 2)
    throw InvalidField(name + ".count", "is " + std::to_string(range.count()) + ".", "Use at least 2.");
  if (static_cast<std::size_t>(range.count()) > kMostPoints)
    throw InvalidField(name + ".count", "is " + std::to_string(range.count()) + ".", kFewer);
  std::vector<double> out;
  out.reserve(static_cast<std::size_t>(range.count()));
  for (int i = 0; i < range.count(); ++i) out.push_back(at(static_cast<double>(i), range.count() - 1.0));
  // Reproduces both ends exactly.
  out.front() = range.first();
  out.back() = range.last();
  return out;
}

std::vector<double> values_of(const v1::SweepAxis& axis, const std::string& name) {
  switch (axis.values_case()) {
    case v1::SweepAxis::kList:
      if (axis.list().values().empty()) throw InvalidField(name + ".list", "has no values.", "Give at least one.");
      return {axis.list().values().begin(), axis.list().values().end()};
    case v1::SweepAxis::kLinear: {
      const auto& range = axis.linear();
      // Dividing last keeps whole numbers whole, as counts and seeds must be.
      return spaced(range, name + ".linear", [&](double step, double steps) {
        return range.first() + step * (range.last() - range.first()) / steps;
      });
    }
    case v1::SweepAxis::kLogarithmic: {
      const auto& range = axis.logarithmic();
      if (!(range.first() > 0.0) || !(range.last() > 0.0))
        throw InvalidField(name + ".logarithmic", "has an end that is not positive.", "Use two positive ends.");
      return spaced(range, name + ".logarithmic", [&](double step, double steps) {
        return range.first() * std::pow(range.last() / range.first(), step / steps);
      });
    }
    case v1::SweepAxis::kSeedCount: {
      if (axis.seed_count() < 1 || static_cast<std::size_t>(axis.seed_count()) > kMostPoints)
        throw InvalidField(name + ".seed_count", "is " + std::to_string(axis.seed_count()) + ".", "Use 1 to 100000.");
      std::vector<double> out;
      for (int seed = 1; seed <= axis.seed_count(); ++seed) out.push_back(seed);
      return out;
    }
    case v1::SweepAxis::VALUES_NOT_SET: break;
  }
  throw InvalidField(name, "has no values.", "Set list, linear, logarithmic or seed_count.");
}

using Points = std::vector<std::vector<double>>;

void check_axis(const v1::Sweep& sweep, int i, std::set<std::string>& seen) {
  const auto& axis = sweep.axes(i);
  if (axis.field().empty()) throw InvalidField(axis_field(i) + ".field", "is missing.", "Name a field of the case.");
  if (!seen.insert(axis.field()).second)
    throw InvalidField(axis_field(i) + ".field", "is " + axis.field() + ", which an earlier axis already varies.",
                       "Put all its values on one axis.");
  if (axis.values_case() == v1::SweepAxis::kSeedCount && axis.field() != kSeedField)
    throw InvalidField(axis_field(i) + ".seed_count", "counts seeds, but the field is " + axis.field() + ".",
                       std::string("Use it for ") + kSeedField + ". Give other fields a list or a range of values.");
  if (i == 0 && axis.with_previous())
    throw InvalidField(axis_field(i) + ".with_previous", "is true, but no axis is before this one.",
                       "Set it for the second axis of the two that advance together.");
}

// Appends the value of every step of an axis to the values of the axes with which it advances.
void append(Points& steps, const std::vector<double>& values, const std::string& name) {
  if (values.size() != steps.size()) {
    throw InvalidField(name,
                       "has " + std::to_string(values.size()) +
                           " values; the axis before it, with which it advances, has " + std::to_string(steps.size()) +
                           ".",
                       "Give both as many values, or leave out with_previous to combine them.");
  }
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i].push_back(values[i]);
}

// Equal steps of an axis would be the same jobs twice.
void check_distinct(const Points& points, const std::vector<std::string>& fields, const std::string& axis) {
  const auto found = find_repeated(points);
  if (found.count == 0) return;
  std::string values;
  for (std::size_t i = 0; i < fields.size(); ++i)
    values += (i == 0 ? "" : ", ") + fields[i] + " = " + text_of(points[found.second][i]);
  throw InvalidField(axis,
                     "has " + values + " twice, at the places " + std::to_string(found.first + 1) + " and " +
                         std::to_string(found.second + 1) + ".",
                     "Give each value once; equal cases have equal results.");
}

Points combinations(const Points& points, const Points& steps) {
  if (steps.size() * points.size() > kMostPoints) {
    throw InvalidField("sweep.axes", "have " + std::to_string(steps.size() * points.size()) + " combinations or more.",
                       kFewer);
  }
  Points out;
  out.reserve(points.size() * steps.size());
  for (const auto& point : points) {
    for (const auto& step : steps) {
      out.push_back(point);
      out.back().insert(out.back().end(), step.begin(), step.end());
    }
  }
  return out;
}

Points grid(const v1::Sweep& sweep) {
  Points points = {{}};
  std::set<std::string> seen;
  for (int i = 0; i < sweep.axes_size();) {
    check_axis(sweep, i, seen);
    const std::string name = axis_field(i);
    std::vector<std::string> fields = {sweep.axes(i).field()};
    Points steps;
    for (const double value : values_of(sweep.axes(i), axis_field(i))) steps.push_back({value});
    for (++i; i < sweep.axes_size() && sweep.axes(i).with_previous(); ++i) {
      check_axis(sweep, i, seen);
      append(steps, values_of(sweep.axes(i), axis_field(i)), axis_field(i));
      fields.push_back(sweep.axes(i).field());
    }
    check_distinct(steps, fields, name);
    points = combinations(points, steps);
  }
  return points;
}

std::vector<std::vector<double>> listed(const v1::Sweep& sweep, const std::vector<std::string>& fields) {
  if (static_cast<std::size_t>(sweep.points_size()) > kMostPoints)
    throw InvalidField("sweep.points", "are " + std::to_string(sweep.points_size()) + ".", kFewer);
  std::vector<std::vector<double>> out;
  for (int i = 0; i < sweep.points_size(); ++i) {
    const auto& given = sweep.points(i).fields();
    auto& values = out.emplace_back();
    for (const auto& field : fields) {
      if (const auto found = given.find(field); found != given.end()) values.push_back(found->second);
    }
    if (values.empty() || values.size() != fields.size() || given.size() != fields.size()) {
      throw InvalidField("sweep.points[" + std::to_string(i) + "].fields", "differ from those of the first point.",
                         "Give every point values for the same fields, at least one.");
    }
  }
  return out;
}

}  // namespace

std::int64_t most_points(const v1::Sweep& sweep) {
  constexpr auto kMost = static_cast<std::int64_t>(kMostPoints);
  std::int64_t out = std::clamp<std::int64_t>(sweep.points_size(), 1, kMost);
  for (const auto& axis : sweep.axes()) {
    if (!axis.with_previous()) out = std::min(out * std::clamp<std::int64_t>(count_values(axis), 1, kMost), kMost);
  }
  return out;
}

RepeatedPoints find_repeated(const std::vector<std::vector<double>>& points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i) {
    // A number that is not finite is refused with its field.
    if (std::ranges::all_of(points[i], [](double value) { return std::isfinite(value); })) order.push_back(i);
  }
  std::ranges::stable_sort(order, {}, [&points](std::size_t i) -> const std::vector<double>& { return points[i]; });
  RepeatedPoints out;
  std::size_t original = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (points[order[i]] != points[order[original]]) {
      original = i;
    } else if (out.count++ == 0 || order[i] < out.second) {
      out.first = order[original];
      out.second = order[i];
    }
  }
  return out;
}

SweepPoints expand(const v1::Sweep& sweep) {
  if (sweep.axes().empty() && sweep.points().empty())
    throw InvalidField("sweep.axes", "are missing.", "Give axes with the fields to vary, or points.");
  if (!sweep.axes().empty() && !sweep.points().empty())
    throw InvalidField("sweep.points", "are given together with axes.", "Give axes or points, not both.");
  SweepPoints out;
  out.fields = swept_fields(sweep);
  check_fields(out.fields, sweep.points().empty() ? "sweep.axes" : "sweep.points");
  out.values = sweep.points().empty() ? grid(sweep) : listed(sweep, out.fields);
  return out;
}

}  // namespace cellcrush::jobs
