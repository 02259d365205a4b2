#include "worker/run_job.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

#include "cellcrush/sample_bytes.h"
#include "cellcrush/simd.h"
#include "error.h"
#include "store/case_hash.h"
#include "translate/case_to_spec.h"
#include "translate/results.h"
#include "version.h"
#include "worker/checkpoint_file.h"
#include "worker/processor_time.h"
#include "worker/run_output.h"
#include "worker/stage_timer.h"

namespace cellcrush::worker {
namespace {

using Clock = ProgressMeter::Clock;

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

Checkpoint::Origin origin_of(const Order& order) {
  Checkpoint::Origin out;
  out.set_solver_revision(kSolverRevision);
  out.set_simd_target(simd_target());
  out.set_case_hash(store::hash_of(order.case_()));
  return out;
}

// One run: what is advanced, and where its output goes.
class Run {
 public:
  Run(const JobFolder& folder, const Order& order, ReportLog& log, const StopAsked& stop_asked)
      : folder_(folder),
        order_(order),
        log_(log),
        stop_asked_(stop_asked),
        origin_(origin_of(order)),
        scene_(build(order.case_())),
        facts_(facts_of(*scene_)),
        simulation_(scene_, order.threads()) {}

  Final to_the_end() {
    const auto found = find_checkpoint(folder_, origin_);
    const bool resumes = found.checkpoint && restore(*found.checkpoint);
    if (!resumes) begin_anew();
    say_begun(found.refused);
    output_->put_mesh();
    if (!resumes) output_->put_frame(simulation_.take_frame(0));
    last_checkpoint_ = Clock::now();
    while (simulation_.step() < facts_.step_count && wish_ != StopWish::cancel) {
      advance_to_next_output();
      if (failed()) break;
      if (wish_ == StopWish::suspend) return suspend();
    }
    return complete();
  }

 private:
  bool restore(const Checkpoint& checkpoint) {
    auto samples = samples_of(checkpoint.samples());
    if (!samples || !simulation_.restore(checkpoint.simulation())) return false;
    output_.emplace(folder_, log_, order_.case_(), *scene_);
    if (!output_->restore(*std::move(samples), checkpoint.frame_count(), checkpoint.step())) return false;
    earlier_seconds_ = checkpoint.processor_seconds();
    std::array<double, kStageCount> stages{};
    std::copy_n(checkpoint.stage_seconds().begin(), std::min(kStageCount, checkpoint.stage_seconds_size()),
                stages.begin());
    stage_timer_.set_earlier(stages);
    return true;
  }

  // What an earlier worker said is said again with the same bits, or the job is another.
  void begin_anew() {
    ReportLogReader reader(folder_.reports());
    Report report;
    while (reader.read(report) == ReportLogReader::Read::message) {
      if (!report.has_begun() || report.begun().origin().SerializeAsString() == origin_.SerializeAsString()) continue;
      throw ServiceError(ServiceError::Kind::failed_precondition,
                         "The job was begun by solver " + report.begun().origin().solver_revision() + " with " +
                             report.begun().origin().simd_target() + ", and cannot be gone on with by " +
                             origin_.solver_revision() + " with " + origin_.simd_target() + ".");
    }
    simulation_ = Simulation(scene_, order_.threads());
    output_.emplace(folder_, log_, order_.case_(), *scene_);
  }

  void say_begun(const std::vector<std::string>& refused) {
    Report report;
    auto& begun = *report.mutable_begun();
    begun.set_process(getpid());
    begun.set_step(simulation_.step());
    *begun.mutable_origin() = origin_;
    for (const auto& reason : refused) begun.add_refused_checkpoints(reason);
    log_.append(report);
  }

  // Advances in pieces of about 50 ms, so that progress is told and a wish is heard in time, then takes what is due.
  void advance_to_next_output() {
    const std::int64_t next =
        std::min({next_multiple(facts_.sample_interval), next_multiple(facts_.frame_interval), facts_.step_count});
    while (simulation_.step() < next) {
      const std::int64_t before = simulation_.step();
      const auto start = Clock::now();
      simulation_.advance(std::min(piece_, next - before), &stage_timer_);
      const auto now = Clock::now();
      if (simulation_.step() == before) {
        put_out_sample();
        if (simulation_.status().kind == RunStatus::Kind::running)
          throw std::logic_error("the solver does not advance");
        return;
      }
      piece_ = now - start < std::chrono::milliseconds(25) ? 2 * piece_ : std::max<std::int64_t>(1, piece_ / 2);
      piece_ = std::min(piece_, facts_.step_count);
      output_->put_progress(simulation_.step(), simulation_.strain(), now);
      wish_ = stop_asked_();
      if (wish_ != StopWish::none) {
        if (wish_ == StopWish::cancel) acknowledge_cancel();
        break;
      }
      // At an output's step it waits for the output.
      if (simulation_.step() < next) checkpoint_regularly(now);
    }
    const bool last = wish_ == StopWish::cancel || simulation_.step() == facts_.step_count;
    if (last || simulation_.step() % facts_.sample_interval == 0) put_out_sample();
    if (failed()) return;
    if (last || simulation_.step() % facts_.frame_interval == 0)
      output_->put_frame(simulation_.take_frame(output_->frame_count()));
    if (!last && wish_ == StopWish::none) checkpoint_regularly(Clock::now());
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
    if (!failed()) output_->put_sample(std::move(sample));
  }

  void acknowledge_cancel() {
    Report report;
    report.mutable_stopping();
    log_.append(report);
  }

  void checkpoint_regularly(Clock::time_point now) {
    if (std::chrono::duration<double>(now - last_checkpoint_).count() < order_.checkpoint_interval_s()) return;
    try {
      checkpoint();
    } catch (const ServiceError& error) {
      // The one before is still there, and there may be room again the next time.
      if (error.kind() != ServiceError::Kind::storage_full) throw;
    }
    last_checkpoint_ = Clock::now();
  }

  void checkpoint() {
    log_.synchronize();
    Checkpoint out;
    *out.mutable_origin() = origin_;
    out.set_step(simulation_.step());
    out.set_simulation(simulation_.checkpoint());
    out.set_samples(bytes_of(output_->samples()));
    out.set_frame_count(output_->frame_count());
    out.set_processor_seconds(seconds_used());
    for (const double seconds : stage_timer_.seconds()) out.add_stage_seconds(seconds);
    write_checkpoint(folder_, out);
  }

  [[nodiscard]] double seconds_used() const { return earlier_seconds_ + processor_seconds(CLOCK_PROCESS_CPUTIME_ID); }

  Final suspend() {
    if (simulation_.step() == facts_.step_count) return complete();
    checkpoint();
    Final out;
    out.set_suspended_step(simulation_.step());
    return out;
  }

  // The frame that the solver kept from before its failure.
  void put_out_last_good_frame() {
    FieldFrame frame = simulation_.last_good_frame();
    if (frame.time <= output_->last_frame_time()) return;
    frame.index = output_->frame_count();
    output_->put_frame(frame);
  }

  // Closes the result, of a run that failed with what was computed before.
  Final complete() {
    const RunStatus status = simulation_.status();
    const bool whole = !failed() && simulation_.step() == facts_.step_count;
    if (failed()) put_out_last_good_frame();
    Final out = failure(translate::cause_of(status.kind), status.message, status.remedy);
    out.set_cancelled(!whole && !failed());
    const auto& samples = output_->samples();
    *out.mutable_summary() =
        translate::to_proto(summarize(*scene_, samples), samples.empty() ? Sample{} : samples.back(),
                            {seconds_used(), stage_timer_.seconds()});
    output_->finish({order_.case_(), kSolverRevision, simd_target(), order_.threads(), facts_.time_step,
                     facts_.modelled, whole, status.message},
                    out.summary());
    return out;
  }

  const JobFolder& folder_;
  const Order& order_;
  ReportLog& log_;
  const StopAsked& stop_asked_;
  Checkpoint::Origin origin_;
  std::shared_ptr<const Scene> scene_;
  SceneFacts facts_;
  Simulation simulation_;
  StageTimer stage_timer_;
  std::optional<RunOutput> output_;
  double earlier_seconds_ = 0.0;  ///< processor time before the checkpoint that the run goes on from
  Clock::time_point last_checkpoint_;
  std::int64_t piece_ = 16;
  StopWish wish_ = StopWish::none;
};

Final failure_of(const ServiceError& error) {
  switch (error.kind()) {
    case ServiceError::Kind::storage_full:
      return failure(v1::DISK_FULL, error.what(), "Make room in the data folder and submit the case again.");
    case ServiceError::Kind::failed_precondition:
      return failure(v1::WORKER_LOST, error.what(), "Submit the case again.");
    default:
      return failure(v1::WORKER_CRASHED, error.what(), "Look into the daemon's log, then submit the case again.");
  }
}

Final end_of(const JobFolder& folder, const Order& order, ReportLog& log, const StopAsked& stop_asked) {
  try {
    return Run(folder, order, log, stop_asked).to_the_end();
  } catch (const ServiceError& error) {
    return failure_of(error);
  } catch (const std::bad_alloc&) {
    return failure(v1::OUT_OF_MEMORY, "There was not enough memory for the run.",
                   "Take fewer cells or elements_per_wall, or a machine with more memory.");
  } catch (const std::exception& error) {
    return failure(v1::WORKER_CRASHED, std::string("The worker stopped: ") + error.what() + ".",
                   "Submit the case again; if it happens again, report the case.");
  }
}

}  // namespace

bool run_job(const JobFolder& folder, const Order& order, const StopAsked& stop_asked) {
  try {
    ReportLog log(folder.reports());
    Report report;
    *report.mutable_final() = end_of(folder, order, log, stop_asked);
    // What is not a result is made again from the checkpoint.
    std::error_code ignored;
    std::filesystem::remove(folder.partial_result(), ignored);
    log.append(report);
    log.synchronize();
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace cellcrush::worker
