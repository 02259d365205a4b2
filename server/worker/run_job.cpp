#include "worker/run_job.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

#include "cellcrush/run_memory.h"
#include "cellcrush/scene.h"
#include "error.h"
#include "store/lattice_file.h"
#include "store/own_folder.h"
#include "translate/case_to_spec.h"
#include "translate/results.h"
#include "translate/worker_memory.h"
#include "worker/checkpoint_file.h"
#include "worker/device_of_run.h"
#include "worker/give_up.h"
#include "worker/large_pages.h"
#include "worker/memory_limit.h"
#include "worker/run_output.h"
#include "worker/stage_timer.h"
#include "worker/worker_main.h"

namespace cellcrush::worker {
namespace {

using Clock = ProgressMeter::Clock;

Final failure(v1::Job::Cause cause, std::string message, std::string remedy) {
  Final out;
  out.set_cause(cause);
  out.set_message(std::move(message));
  out.set_remedy(std::move(remedy));
  return out;
}

// The files of earlier workers cannot be continued; holds the reason.
struct CannotContinue {
  std::string why;
};

// 0: none.
std::int64_t memory_limit_of(const Order& order, const Scene& scene) {
  if (order.memory_factor() <= 0.0) return 0;
  const SceneSpec spec = translate::to_spec(order.case_()).spec;
  const auto predicted = translate::memory_of_worker(
      spec, {memory_of_run(spec, scene), static_cast<std::int64_t>(scene.element_count()), spec.output.sample_count});
  const auto limit =
      translate::memory_limit(predicted, order.threads(), order.memory_factor(), order.most_memory_bytes());
  // The limit has room for stacks of the usual size. They count whole, however little of them is used.
  constexpr rlim_t kUsual = 8U << 20U;
  rlimit stack{};
  getrlimit(RLIMIT_STACK, &stack);
  const rlim_t beyond = stack.rlim_cur == RLIM_INFINITY ? 0 : std::max(stack.rlim_cur, kUsual) - kUsual;
  return limit + order.threads() * static_cast<std::int64_t>(beyond);
}

// One run: the simulation, and the destination of its output.
class Run {
 public:
  Run(const store::JobFolder& folder, const Order& order, store::ReportLog& log, const RequestedStop& requested_stop)
      : folder_(folder),
        order_(order),
        log_(log),
        requested_stop_(requested_stop),
        origin_(origin_of(order)),
        scene_(scene_of(order)),
        device_(order.device(), *scene_),
        // The driver of a device reserves far more than it uses.
        memory_limit_(device_.advances() ? 0 : memory_limit_of(order, *scene_), [this] { end_for_memory(); }),
        facts_(facts_of(*scene_)),
        simulation_(scene_, order.threads()) {
    device_.advance(simulation_);
  }

  Final to_the_end() {
    const auto found = find_checkpoint(folder_, origin_);
    const bool resumes = found.checkpoint && restore(found);
    if (!resumes) start_at_step_0();
    use_large_pages(simulation_);
    say_begun(found.refused);
    output_->put_mesh();
    if (!resumes) output_->put_frame(simulation_.take_frame(0));
    last_checkpoint_ = Clock::now();
    while (!simulation_.has_ended() && !ends_early()) {
      advance_to_next_output();
      if (failed()) break;
      if (request_ == StopRequest::suspend) return suspend();
    }
    return complete();
  }

 private:
  // On whichever thread ran out of memory: no report is being written meanwhile.
  [[noreturn]] void end_for_memory() {
    Report report;
    *report.mutable_final() = out_of_memory();
    log_.append(report);
    log_.synchronize();
    _exit(kReported);
  }

  bool restore(const FoundCheckpoint& found) {
    const Checkpoint& checkpoint = *found.checkpoint;
    output_.emplace(folder_, log_, order_, scene_);
    if (!output_->restore(checkpoint) || !simulation_.restore(found.simulation)) return false;
    const auto earlier = run_time_of(checkpoint);
    earlier_seconds_ = earlier.processor;
    stage_timer_.set_earlier(earlier.stages);
    earlier_clock_seconds_ = checkpoint.clock_seconds();
    return true;
  }

  // Repeated reports must have the same bits; otherwise this is a different job.
  void start_at_step_0() {
    if (const auto other = find_other_origin(folder_, origin_)) {
      throw CannotContinue{"Restarted from step 0: the job was started by solver " + other->solver_revision() +
                           " with " + other->simd_target() + ", but this is solver " + origin_.solver_revision() +
                           " with " + origin_.simd_target() + "."};
    }
    output_.emplace(folder_, log_, order_, scene_);
  }

  void say_begun(const std::vector<std::string>& refused) {
    Report report;
    auto& begun = *report.mutable_begun();
    begun.set_process(getpid());
    begun.set_step(simulation_.step());
    begun.set_threads(order_.threads());
    begun.set_epoch(order_.epoch());
    *begun.mutable_origin() = origin_;
    for (const auto& reason : refused) begun.add_refused_checkpoints(reason);
    log_.append(report);
  }

  // Advances in pieces of about 50 ms, so that progress is reported and requests are noticed in time. Then takes what
  // is due.
  void advance_to_next_output() {
    const std::int64_t next =
        std::min({next_multiple(facts_.sample_interval), next_multiple(facts_.frame_interval), facts_.most_steps});
    while (simulation_.step() < next && !simulation_.has_ended()) {
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
      piece_ = std::min(piece_, facts_.most_steps);
      output_->put_progress(simulation_.step(), simulation_.strain(), now);
      request_ = requested_stop_();
      if (request_ == StopRequest::cancel) acknowledge_cancel();
      time_is_up_ =
          request_ == StopRequest::none && order_.time_limit_s() > 0.0 && clock_seconds() >= order_.time_limit_s();
      if (request_ != StopRequest::none || time_is_up_) break;
      // At a step with output it waits for that output.
      if (simulation_.step() < next) checkpoint_regularly(now);
    }
    // At the time limit it ends with its existing samples: one more would be at another step if this worker were lost
    // now.
    const bool last = request_ == StopRequest::cancel || simulation_.has_ended();
    if (last || simulation_.step() % facts_.sample_interval == 0) put_out_sample();
    if (failed()) return;
    if (last || simulation_.step() % facts_.frame_interval == 0)
      output_->put_frame(simulation_.take_frame(output_->frame_count()));
    if (!last && !time_is_up_ && request_ == StopRequest::none) checkpoint_regularly(Clock::now());
  }

  // Whether the solver declared its own result untrue.
  [[nodiscard]] bool failed() const {
    return translate::cause_of(simulation_.status().kind) != v1::Job::JOB_CAUSE_UNSPECIFIED;
  }

  // Whether the run ends now and keeps its results so far.
  [[nodiscard]] bool ends_early() const { return request_ == StopRequest::cancel || time_is_up_; }

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
      // The previous checkpoint is still there, and the next attempt may find room.
      if (error.shortage() == Shortage::none) throw;
    }
    last_checkpoint_ = Clock::now();
  }

  void checkpoint() {
    log_.synchronize();
    Checkpoint out;
    *out.mutable_origin() = origin_;
    out.set_step(simulation_.step());
    out.set_sample_count(output_->sample_count());
    out.set_frame_count(output_->frame_count());
    out.set_processor_seconds(seconds_used());
    for (const double seconds : stage_timer_.seconds()) out.add_stage_seconds(seconds);
    out.set_clock_seconds(clock_seconds());
    write_checkpoint(folder_, out, [this](const ByteSink& sink) { simulation_.checkpoint(sink); });
  }

  [[nodiscard]] double seconds_used() const { return earlier_seconds_ + processor_seconds(CLOCK_PROCESS_CPUTIME_ID); }

  // Of all workers of the job.
  [[nodiscard]] double clock_seconds() const {
    return earlier_clock_seconds_ + std::chrono::duration<double>(Clock::now() - begin_).count();
  }

  Final suspend() {
    if (simulation_.has_ended()) return complete();
    checkpoint();
    Final out;
    out.set_suspended_step(simulation_.step());
    return out;
  }

  // The last frame from before the solver's failure.
  void put_out_last_good_frame() {
    FieldFrame frame = simulation_.last_good_frame();
    if (frame.time <= output_->last_frame_time()) return;
    frame.index = output_->frame_count();
    output_->put_frame(frame);
  }

  // Closes the result; a failed run keeps everything computed before.
  Final complete() {
    const RunStatus status = simulation_.status();
    const bool whole = !failed() && simulation_.has_ended();
    if (failed()) put_out_last_good_frame();
    Final out = failure(translate::cause_of(status.kind), status.message, status.remedy);
    if (!whole && !failed()) {
      if (request_ == StopRequest::cancel) {
        out.set_cancelled(true);
      } else {
        out = out_of_time();
      }
    }
    *out.mutable_summary() = output_->finish(out, {seconds_used(), stage_timer_.seconds()}, device_.words(simulation_));
    out.set_device_use(static_cast<Final::DeviceUse>(device_.use(simulation_)));
    return out;
  }

  [[nodiscard]] Final out_of_time() const {
    const double share = static_cast<double>(simulation_.step()) / static_cast<double>(facts_.step_count);
    const double needed = std::ceil(1.3 * order_.time_limit_s() / share);
    const std::string smaller = "with a lower fidelity or a lower end_strain.";
    return failure(
        v1::Job::TIME_LIMIT,
        fmt::format("The job reached its time limit of {:.4g} s at step {} of {} ({:.3g} %).", order_.time_limit_s(),
                    simulation_.step(), facts_.step_count, 100.0 * share),
        order_.limit_is_daemons()
            ? fmt::format(
                  "Start the daemon with --max-job-time {0:.0f} or more (cellcrush run: --time-limit {0:.0f}s), "
                  "or submit the case {1}",
                  needed, smaller)
            : fmt::format("Submit the case with time_limit_s {:.0f} or more, {}", needed, smaller));
  }

  Clock::time_point begin_ = Clock::now();
  const store::JobFolder& folder_;
  const Order& order_;
  store::ReportLog& log_;
  const RequestedStop& requested_stop_;
  Checkpoint::Origin origin_;
  std::shared_ptr<const Scene> scene_;
  DeviceOfRun device_;
  MemoryLimit memory_limit_;
  SceneFacts facts_;
  Simulation simulation_;
  StageTimer stage_timer_;
  std::optional<RunOutput> output_;
  double earlier_seconds_ = 0.0;        ///< before the checkpoint from which the run resumes
  double earlier_clock_seconds_ = 0.0;  ///< wall-clock time before it
  Clock::time_point last_checkpoint_;
  std::int64_t piece_ = 16;
  StopRequest request_ = StopRequest::none;
  bool time_is_up_ = false;
};

Final failure_of(const ServiceError& error) {
  return failure(v1::Job::WORKER_CRASHED, error.what(), "Check the daemon's log, then submit the case again.");
}

// Another worker resumes from the newest checkpoint, or restarts, with the same bits.
Final left_for(const ServiceError& error, const store::JobFolder& folder, const Order& order) {
  const auto found = find_checkpoint(folder, origin_of(order));
  Final out;
  out.set_suspended_step(found.checkpoint ? found.checkpoint->step() : 0);
  out.set_shortage(static_cast<int>(error.shortage()));
  out.set_message(error.what());
  return out;
}

Final end_of(const store::JobFolder& folder, Order& order, store::ReportLog& log, const RequestedStop& requested_stop) {
  try {
    store::read_lattice_of(folder, order);
  } catch (const ServiceError& error) {
    if (error.kind() != ServiceError::Kind::data_loss) throw;
    return failure(v1::Job::STORE_CORRUPT, error.what(), "Submit the case again.");
  }
  if (order.has_given_up()) return give_up(folder, order, log, requested_stop, order.given_up());
  Final loss;
  try {
    return Run(folder, order, log, requested_stop).to_the_end();
  } catch (const CannotContinue& reason) {
    Final out;
    out.set_begin_again(reason.why);
    return out;
  } catch (const ServiceError& error) {
    if (error.shortage() != Shortage::none) return left_for(error, folder, order);
    loss = failure_of(error);
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  } catch (const std::exception& error) {
    loss = failure(v1::Job::WORKER_CRASHED, std::string("The worker stopped: ") + error.what() + ".",
                   "Submit the case again. If the failure repeats, report it together with the case.");
  }
  return give_up(folder, order, log, requested_stop, std::move(loss));
}

}  // namespace

void run_job(const store::JobFolder& folder, Order order, const RequestedStop& requested_stop) {
  store::ReportLog log(folder.reports());
  Report report;
  *report.mutable_final() = end_of(folder, order, log, requested_stop);
  // An incomplete result is rebuilt from the reports.
  static_cast<void>(store::remove_own(folder.partial_result()));
  log.append(report);
  log.synchronize();
}

}  // namespace cellcrush::worker
