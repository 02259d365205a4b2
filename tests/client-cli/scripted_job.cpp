#include "scripted_job.h"

#include "synthetic_crush.h"

namespace cellcrush::client::testing {

v1::Job make_job(v1::Job::State state) {
  v1::Job job;
  job.set_name("jobs/test");
  job.set_state(state);
  job.mutable_case_()->set_title("Type I of the tests");
  job.mutable_case_()->mutable_loading()->set_speed_m_per_s(100.0);
  job.mutable_case_()->mutable_loading()->set_end_strain(0.8);
  job.mutable_case_()->mutable_lattice()->mutable_hexagon()->set_columns(74);
  job.mutable_case_()->mutable_lattice()->mutable_hexagon()->set_rows(21);
  job.mutable_words()->set_plates(true);
  job.mutable_words()->set_lattice("hexagons, 74 x 21 cells");
  job.mutable_words()->set_loading("crushed along X at 100 m/s to strain 0.8");
  if (state == v1::Job::FAILED) {
    job.set_cause(v1::Job::SOLVER_DIVERGED);
    job.set_cause_message("particle 12 left the scene at step 340");
    job.set_remedy("lower numerics.time_step_s");
  }
  if (state == v1::Job::SUCCEEDED) {
    v1::Summary& summary = *job.mutable_summary();
    summary.set_plateau_window_low(0.2);
    summary.set_plateau_window_high(0.4);
    summary.set_plateau_stress_impact_mpa(3.412);
    summary.set_plateau_stress_support_mpa(0.4471);
    summary.set_densification_strain(0.76);
    summary.set_energy_error_relative(0.0123);
    summary.set_deepest_penetration(0.121);
    summary.set_step_count(20504);
    summary.set_solver_seconds(45.3);
    summary.mutable_stage_times()->set_evaluate_internal_forces_s(30.0);
    summary.mutable_stage_times()->set_find_contacts_s(10.0);
    summary.set_crush_mode(v1::Summary::CRUSH_MODE_I);
    summary.set_crush_mode_words("layer by layer (I)");
    summary.set_crush_mode_strain(0.11);
    summary.set_shock_error_relative(-0.0123);
    summary.mutable_front()->set_strain_behind(0.905);
    summary.mutable_front()->set_stress_ahead_mpa(0.391);
    summary.mutable_front()->set_solid_fraction_behind(1.07);
    summary.mutable_front()->set_wall_fraction_behind(1.02);
    summary.mutable_front()->set_shock_mpa(3.431);
    summary.mutable_front()->set_shock_error_relative(0.0056);
    summary.mutable_ledger()->set_work_external_mj(20000.0);
    summary.mutable_ledger()->set_plastic_mj(17800.0);
    summary.mutable_ledger()->set_contact_damping_mj(2200.0);
    summary.mutable_theory()->set_shock_mpa(3.37);
    summary.mutable_theory()->set_gibson_ashby_mpa(0.301);
    summary.mutable_theory()->set_densification_strain(0.86);
    job.mutable_start_time()->set_seconds(1000);
    job.mutable_end_time()->set_seconds(1047);
  }
  return job;
}

std::vector<v1::JobEvent> make_events(int samples, v1::Job::State state) {
  std::vector<v1::JobEvent> events(1);
  events.back().set_sequence(1);
  *events.back().mutable_state() = make_job(v1::Job::RUNNING);
  const auto history = synthetic_samples(samples, 0.8);
  for (int i = 0; i < samples; ++i) {
    v1::JobEvent& sample = events.emplace_back();
    sample.set_sequence(i + 2);
    *sample.mutable_sample() = history[static_cast<std::size_t>(i)];
    v1::JobEvent& progress = events.emplace_back();
    progress.set_sequence(i + 2);
    progress.mutable_progress()->set_fraction(static_cast<double>(i + 1) / samples);
    progress.mutable_progress()->set_strain(sample.sample().strain());
    progress.mutable_progress()->set_stress_impact_mpa(sample.sample().stress_impact_mpa());
    progress.mutable_progress()->set_stress_support_mpa(sample.sample().stress_support_mpa());
    progress.mutable_progress()->set_steps_per_second(431.0);
    progress.mutable_progress()->set_seconds_left(0.05 * (samples - i - 1));
    if (sample.sample().strain() > 0.2) progress.mutable_progress()->set_plateau_so_far_mpa(3.39);
  }
  v1::JobEvent& end = events.emplace_back();
  end.set_sequence(samples + 2);
  *end.mutable_state() = make_job(state);
  return events;
}

}  // namespace cellcrush::client::testing
