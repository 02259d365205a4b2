#include "validation/course.h"

#include <cstdio>

#include "measure/curve.h"

namespace cellcrush::validation {

Course find_course(std::span<const Sample> samples) {
  const Curve curve(samples, &Sample::stress_impact);
  const Sample& last = samples.back();
  const auto onset = curve.densification();
  Course course;
  course.densified = onset.has_value();
  course.densification = onset.value_or(last.strain);
  course.densification_travel = course.densification * last.travel / last.strain;
  course.plateau = curve.integral(course.densification) / course.densification;
  course.peaks = find_salient_peaks(samples, course.densification);
  return course;
}

std::string course_names() { return "crush,densification_strain,densification_travel,plateau,peak_count,peaks"; }

std::string course_row(const std::string& name, const Course& course) {
  char text[128];
  std::snprintf(text, sizeof(text), ",%s%.4f,%.2f,%.5g,%zu,", course.densified ? "" : ">", course.densification,
                course.densification_travel, course.plateau, course.peaks.size());
  std::string row = name + text;
  for (const Peak& peak : course.peaks) {
    std::snprintf(text, sizeof(text), "%s%.4f:%.5g:%.5g", &peak == course.peaks.data() ? "" : " ", peak.strain,
                  peak.stress, peak.prominence);
    row += text;
  }
  return row;
}

}  // namespace cellcrush::validation
