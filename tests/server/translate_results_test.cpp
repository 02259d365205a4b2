// Samples and summaries on their way to the wire.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "translate/results.h"

namespace cellcrush {
namespace {

TEST(TranslateResults, ASummaryKeepsAbsentValuesAbsent) {
  Summary summary;
  summary.plateau_stress_impact = 3.5;
  const auto out = translate::to_proto(summary, Sample(), {1.5}, v1::Case());
  EXPECT_EQ(out.plateau_stress_impact_mpa(), 3.5);
  EXPECT_FALSE(out.has_densification_strain());
  EXPECT_FALSE(out.has_plateau_stress_support_mpa());
  EXPECT_FALSE(out.has_front());
  EXPECT_FALSE(out.has_quasi_static());
  EXPECT_FALSE(out.has_crush_mode_strain());
  EXPECT_FALSE(out.has_shock_error_relative());
  EXPECT_EQ(out.crush_mode(), v1::Summary::CRUSH_MODE_NONE);
  EXPECT_EQ(out.solver_seconds(), 1.5);
}

// Each number gets the number of the field of its name, in the unit of the field. Two terms of the ledger have none.
auto numberer_of(const google::protobuf::Descriptor& message) {
  return [&message](const char* name, auto& number, double scale) {
    const auto* field = message.FindFieldByName(name);
    const std::string_view of = name;
    ASSERT_EQ(field == nullptr, of == "energy_initial_mj" || of == "energy_mass_damping_mj") << name;
    if (field != nullptr) number = static_cast<std::remove_reference_t<decltype(number)>>(field->number() / scale);
  };
}

// How many fields are numbers, each equal to its own number.
int count_numbered(const google::protobuf::Message& message) {
  int count = 0;
  for (int i = 0; i < message.GetDescriptor()->field_count(); ++i) {
    const auto* field = message.GetDescriptor()->field(i);
    const auto& reflection = *message.GetReflection();
    if (field->is_repeated() || field->message_type() != nullptr) continue;
    const bool is_count = field->cpp_type() == google::protobuf::FieldDescriptor::CPPTYPE_INT64;
    const double value =
        is_count ? static_cast<double>(reflection.GetInt64(message, field)) : reflection.GetDouble(message, field);
    EXPECT_NEAR(value, field->number(), 1e-12) << field->name();
    ++count;
  }
  return count;
}

TEST(TranslateResults, EveryFieldOfASampleGoesOver) {
  Sample sample;
  visit_columns(sample, numberer_of(*v1::Sample::descriptor()));
  sample.energies.mass_damping = 12.0 - 16.0;  // energy_damping_mj less energy_contact_damping_mj
  visit_columns_of_front(sample.front.emplace(), numberer_of(*v1::Front::descriptor()));
  const auto out = translate::to_proto(sample, {});
  EXPECT_GE(count_numbered(out), 20);
  EXPECT_GE(count_numbered(out.front()), 7);
  sample.front.reset();
  EXPECT_FALSE(translate::to_proto(sample, {}).has_front());
}

TEST(TranslateResults, ASummaryCarriesFrontModeSteadinessAndLedger) {
  Summary summary;
  summary.plateau_stress_impact = 2.0;
  summary.theory.shock = 2.2;
  summary.crush_mode = CrushMode::v;
  summary.crush_mode_strain = 0.12;
  summary.other_rise = LastingRise{RiseKind::second_collapse, 0.71};
  summary.front = FrontSummary{{0.0, 0.9, 0.1, 1e5, 2e3, 1.1, 1.05}, 0.4, 1.9, 0.75};
  summary.quasi_static = QuasiStatic{0.01, 0.02, 0.003};
  Sample last;
  last.energies.external = 10.0;
  last.energies.mass_damping = 1.0;
  last.energies.contact_damping = 2.0;
  last.energies.residual = -0.5;
  const auto out = translate::to_proto(summary, last, {1.5, {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}}, v1::Case());
  EXPECT_EQ(out.crush_mode(), v1::Summary::CRUSH_MODE_V);
  EXPECT_EQ(out.crush_mode_strain(), 0.12);
  EXPECT_EQ(out.other_rise(), v1::Summary::OTHER_RISE_SECOND_COLLAPSE);
  EXPECT_EQ(out.other_rise_strain(), 0.71);
  EXPECT_NEAR(out.shock_error_relative(), 0.1, 1e-12);
  EXPECT_NEAR(out.front().shock_error_relative(), -0.05, 1e-12);
  EXPECT_EQ(out.front().velocity_behind_m_per_s(), 100.0);
  EXPECT_EQ(out.front().stress_ahead_mpa(), 0.4);
  EXPECT_EQ(out.front().window_share(), 0.75);
  EXPECT_EQ(out.quasi_static().plate_difference_greatest(), 0.02);
  EXPECT_EQ(out.ledger().contact_damping_mj(), 2.0);
  EXPECT_EQ(out.ledger().mass_damping_mj(), 1.0);
  EXPECT_EQ(out.ledger().residual_mj(), -0.5);
  EXPECT_EQ(out.stage_times().integrate_motion_s(), 1.0);
  EXPECT_EQ(out.stage_times().evaluate_internal_forces_s(), 2.0);
  EXPECT_EQ(out.stage_times().find_contacts_s(), 3.0);
  EXPECT_EQ(out.stage_times().evaluate_contact_forces_s(), 4.0);
  EXPECT_EQ(out.stage_times().evaluate_plate_forces_s(), 5.0);
  EXPECT_EQ(out.stage_times().evaluate_loads_s(), 6.0);
}

}  // namespace
}  // namespace cellcrush
