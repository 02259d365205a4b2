#include "worker/run_case.h"

#include <algorithm>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

#include "cellcrush/simd.h"
#include "cellcrush/simulation.h"
#include "error.h"
#include "store/durable_file.h"
#include "store/result_writer.h"
#include "translate/case_to_spec.h"
#include "translate/results.h"
#include "version.h"
#include "worker/processor_time.h"
#include "worker/progress_meter.h"
#include "worker/stage_timer.h"

namespace cellcrush::worker {
namespace {

// The daemon's end of the socket is closed.
struct NobodyListens {};

Final failure(v1::JobCause cause, std::string message, std::string remedy) {
  Final out;
  out.set_cause(cause);
  out.set_message(std::move(message));
  out.set_remedy(std::move(remedy));
  return out;
}

std::shared_ptr<const Scene> build(const v1::Case& submitted) {
  const auto reading = translate::to_spec(submitted);
  auto built = build_scene(reading.spec);
  Problems problems = reading.problems;
  problems.insert(problems.end(), built.problems.begin(), built.problems.end());
  // The daemon has checked the case, so this is an older job that this version no longer accepts.
  if (!problems.empty())
    throw std::runtime_error("the case is no longer accepted: " + problems.front().field + ": " +
                             problems.front().message);
  return built.scene;
}

// One run: what is advanced, and where its output goes.
class Run {
 public:
  Run(const Order& order, const Reporter& report, const StopAsked& stop_asked)
      : order_(order),
        report_(report),
        stop_asked_(stop_asked),
        scene_(build(order.case_())),
        facts_(facts_of(*scene_)),
        simulation_(scene_, order.threads()),
        meter_(facts_.step_count, Summary::kPlateauLow, Summary::kPlateauHigh, ProgressMeter::Clock::now()),
        mesh_(translate::to_proto(mesh_of(*scene_), facts_.particle_count)),
        partial_path_(order.result_path() + ".partial"),
        writer_(partial_path_, mesh_) {}

  Final to_the_end() {
    Report mesh;
    *mesh.mutable_mesh() = mesh_;
    send(mesh);
    put_out_frame(simulation_.take_frame(frame_count_));
    while (simulation_.step() < facts_.step_count && !stopping_) {
      advance_to_next_output();
      if (failed()) break;
    }
    return complete();
  }

 private:
  // Advances in pieces of about 50 ms, so that progress is told and a wish to stop is heard in time, then takes what is
  // due.
  void advance_to_next_output() {
    const std::int64_t next =
        std::min({next_multiple(facts_.sample_interval), next_multiple(facts_.frame_interval), facts_.step_count});
    while (simulation_.step() < next) {
      const std::int64_t before = simulation_.step();
      const auto start = ProgressMeter::Clock::now();
      simulation_.advance(std::min(piece_, next - before), &stage_timer_);
      const auto now = ProgressMeter::Clock::now();
      if (simulation_.step() == before) {
        put_out_sample();
        if (simulation_.status().kind == RunStatus::Kind::running)
          throw std::logic_error("the solver does not advance");
        return;
      }
      piece_ = now - start < std::chrono::milliseconds(25) ? 2 * piece_ : std::max<std::int64_t>(1, piece_ / 2);
      piece_ = std::min(piece_, facts_.step_count);
      put_out_progress(now);
      if (stop_asked_()) {
        acknowledge_stop();
        break;
      }
    }
    const bool last = stopping_ || simulation_.step() == facts_.step_count;
    if (last || simulation_.step() % facts_.sample_interval == 0) put_out_sample();
    if (failed()) return;
    if (last || simulation_.step() % facts_.frame_interval == 0) put_out_frame(simulation_.take_frame(frame_count_));
  }

  // Whether the solver found its own result untrue.
  [[nodiscard]] bool failed() const {
    return translate::cause_of(simulation_.status().kind) != v1::JOB_CAUSE_UNSPECIFIED;
  }

  [[nodiscard]] std::int64_t next_multiple(std::int64_t interval) const {
    return (simulation_.step() / interval + 1) * interval;
  }

  void put_out_sample() {
    Sample sample = simulation_.take_sample();
    if (failed()) return;
    samples_.push_back(std::move(sample));
    Report report;
    *report.mutable_sample() = translate::to_proto(samples_.back(), order_.case_().lattice().frame().watched_nodes());
    meter_.add(report.sample());
    writer_.add_sample(report.sample());
    send(report);
  }

  void put_out_frame(const FieldFrame& frame) {
    Report report;
    *report.mutable_frame() = translate::to_proto(frame);
    last_frame_time_ = frame.time;
    ++frame_count_;
    writer_.add_frame(report.frame());
    send(report);
  }

  void put_out_progress(ProgressMeter::Clock::time_point now) {
    if (auto progress = meter_.read(simulation_.step(), simulation_.strain(), now)) {
      Report report;
      *report.mutable_progress() = *std::move(progress);
      send(report);
    }
  }

  void acknowledge_stop() {
    stopping_ = true;
    Report report;
    report.mutable_stopping();
    send(report);
  }

  // The frame that the solver kept from before its failure.
  void put_out_last_good_frame() {
    FieldFrame frame = simulation_.last_good_frame();
    if (frame.time <= last_frame_time_) return;
    frame.index = frame_count_;
    put_out_frame(frame);
  }

  // Closes the result, of a run that failed with what was computed before.
  Final complete() {
    const RunStatus status = simulation_.status();
    const bool whole = !failed() && simulation_.step() == facts_.step_count;
    if (failed()) put_out_last_good_frame();
    Final out = failure(translate::cause_of(status.kind), status.message, status.remedy);
    out.set_cancelled(!whole && !failed());
    *out.mutable_summary() =
        translate::to_proto(summarize(*scene_, samples_), samples_.empty() ? Sample{} : samples_.back(),
                            {processor_seconds(CLOCK_PROCESS_CPUTIME_ID), stage_timer_.seconds()});
    writer_.finish({order_.case_(), kSolverRevision, simd_target(), order_.threads(), facts_.time_step, facts_.modelled,
                    whole, status.message},
                   out.summary());
    store::publish_file(partial_path_, order_.result_path());
    return out;
  }

  void send(const Report& report) {
    if (!report_(report)) throw NobodyListens();
  }

  const Order& order_;
  const Reporter& report_;
  const StopAsked& stop_asked_;
  std::shared_ptr<const Scene> scene_;
  SceneFacts facts_;
  Simulation simulation_;
  StageTimer stage_timer_;
  ProgressMeter meter_;
  v1::Mesh mesh_;
  std::filesystem::path partial_path_;
  store::ResultWriter writer_;
  std::vector<Sample> samples_;
  int frame_count_ = 0;
  double last_frame_time_ = 0.0;  ///< s
  std::int64_t piece_ = 16;
  bool stopping_ = false;  ///< asked to end before the last step
};

Final failure_of(const ServiceError& error) {
  if (error.kind() == ServiceError::Kind::storage_full)
    return failure(v1::DISK_FULL, error.what(), "Make room in the data folder and submit the case again.");
  return failure(v1::WORKER_CRASHED, error.what(), "Look into the daemon's log, then submit the case again.");
}

}  // namespace

std::optional<Final> run_case(const Order& order, const Reporter& report, const StopAsked& stop_asked) {
  std::optional<Final> out;
  try {
    out = Run(order, report, stop_asked).to_the_end();
  } catch (const NobodyListens&) {
    out.reset();
  } catch (const ServiceError& error) {
    out = failure_of(error);
  } catch (const std::bad_alloc&) {
    out = failure(v1::OUT_OF_MEMORY, "There was not enough memory for the run.",
                  "Take fewer cells or elements_per_wall, or a machine with more memory.");
  } catch (const std::exception& error) {
    out = failure(v1::WORKER_CRASHED, std::string("The worker stopped: ") + error.what() + ".",
                  "Submit the case again; if it happens again, report the case.");
  }
  // A run that did not succeed leaves nothing half-written behind.
  std::error_code ignored;
  std::filesystem::remove(order.result_path() + ".partial", ignored);
  return out;
}

}  // namespace cellcrush::worker
