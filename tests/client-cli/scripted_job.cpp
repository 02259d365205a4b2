#include "scripted_job.h"

#include "programs/text_proto.h"
#include "synthetic_crush.h"

namespace cellcrush::client::testing {

namespace {

constexpr const char* kCaseOfJob = R"(case {
  title: "Type I of the tests"
  lattice { hexagon { columns: 74 rows: 21 } }
  loading { speed_m_per_s: 100 end_strain: 0.8 }
}
words {
  plates: true
  lattice: "hexagons, 74 x 21 cells"
  loading: "crushed along X at 100 m/s to strain 0.8"
})";

constexpr const char* kFailedJob = R"(
  cause: SOLVER_DIVERGED
  cause_message: "particle 12 left the scene at step 340"
  remedy: "lower numerics.time_step_s"
)";

constexpr const char* kSucceededJob = R"pb(
  summary {
    plateau_window_low: 0.2
    plateau_window_high: 0.4
    plateau_stress_impact_mpa: 3.412
    plateau_stress_support_mpa: 0.4471
    densification_strain: 0.76
    energy_error_relative: 0.0123
    deepest_penetration: 0.121
    step_count: 20504
    solver_seconds: 45.3
    stage_times { evaluate_internal_forces_s: 30 find_contacts_s: 10 }
    crush_mode: CRUSH_MODE_I
    crush_mode_words: "layer by layer (I)"
    crush_mode_strain: 0.11
    shock_error_relative: -0.0123
    front {
      strain_behind: 0.905
      stress_ahead_mpa: 0.391
      solid_fraction_behind: 1.07
      wall_fraction_behind: 1.02
      shock_mpa: 3.431
      shock_error_relative: 0.0056
    }
    ledger { work_external_mj: 20000 plastic_mj: 17800 contact_damping_mj: 2200 }
    theory { shock_mpa: 3.37 gibson_ashby_mpa: 0.301 densification_strain: 0.86 }
  }
  start_time { seconds: 1000 }
  end_time { seconds: 1047 }
)pb";

}  // namespace

v1::Job make_job(v1::Job::State state) {
  const std::string end = state == v1::Job::FAILED ? kFailedJob : state == v1::Job::SUCCEEDED ? kSucceededJob : "";
  auto job = cellcrush::testing::from_text<v1::Job>(kCaseOfJob + end);
  job.set_name("jobs/test");
  job.set_state(state);
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

SweepScript make_sweep_script(const std::vector<v1::Job::State>& ends) {
  SweepScript script;
  script.sweep.set_name("sweeps/test");
  *script.sweep.mutable_case_() = make_job(v1::Job::RUNNING).case_();
  script.sweep.add_axes()->set_field("loading.speed_m_per_s");
  script.table.add_fields("loading.speed_m_per_s");
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const std::string name = "jobs/test-" + std::to_string(i + 1);
    const double speed = 50.0 * static_cast<double>(i + 1);
    const auto in_state = [&](v1::Job::State state) {
      v1::Job job = make_job(state);
      job.set_name(name);
      job.mutable_case_()->mutable_loading()->set_speed_m_per_s(speed);
      if (job.has_summary()) job.mutable_summary()->set_plateau_stress_impact_mpa(0.3 + 3e-4 * speed * speed);
      return job;
    };
    script.sweep.add_jobs(name);
    script.sweep.mutable_axes(0)->mutable_list()->add_values(speed);
    ++(*script.sweep.mutable_state_counts())[v1::Job::State_Name(ends[i])];
    const auto add = [&] {
      script.responses.emplace_back().set_job(name);
      return script.responses.back().mutable_event();
    };
    *add()->mutable_snapshot()->mutable_job() = in_state(v1::Job::PENDING);
    for (const v1::JobEvent& event : make_events(4, ends[i])) {
      v1::JobEvent& sent = *add();
      sent = event;
      if (event.has_state()) *sent.mutable_state() = in_state(event.state().state());
    }
    auto& row = *script.table.add_rows();
    row.set_job(name);
    row.add_values(speed);
    *row.mutable_result() = in_state(ends[i]);
  }
  return script;
}

}  // namespace cellcrush::client::testing
