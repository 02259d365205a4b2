#include "slurm/attempt_follower.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <stop_token>
#include <system_error>
#include <utility>

#include "jobs/outcome.h"
#include "slurm/attempt_exit.h"
#include "store/durable_file.h"

namespace cellcrush::slurm {
namespace {

using ExitKind = jobs::WorkerExit::Kind;

// A task that squeue has not listed for so many answers is looked for by its claim.
constexpr std::uint64_t kMissedAnswers = 3;
constexpr std::chrono::milliseconds kBetweenLooksAtWaiting{10'000};
// For an answer of Slurm on which a decision waits.
constexpr std::chrono::milliseconds kBetweenQuestions{5'000};
constexpr std::int64_t kEndOfLog = 4096;  // bytes

std::uint64_t limit_of(const Attempt& attempt) {
  return attempt.most_bytes() == 0 ? std::numeric_limits<std::uint64_t>::max() : attempt.most_bytes();
}

}  // namespace

AttemptFollower::AttemptFollower(const Parts& parts, const store::JobFolder& job,
                                 std::shared_ptr<Submission> submission)
    : parts_(parts),
      job_(job),
      submission_(std::move(submission)),
      folder_(parts.options.folder, submission_->state().attempt.id()),
      mirror_(folder_.files(), job, size_of(job.reports()), limit_of(submission_->state().attempt)),
      feed_(job, parts.events) {}

jobs::WorkerExit AttemptFollower::follow() {
  const auto wake = [this] {
    {
      const std::lock_guard lock(wake_mutex_);
      is_woken_ = true;
    }
    wake_.notify_all();
  };
  const std::stop_callback on_stop(parts_.interruptions.stop, wake);
  const std::stop_callback on_suspend(parts_.interruptions.suspend, wake);
  const std::stop_callback on_cancel(parts_.interruptions.cancel, wake);
  feed_.read(false);
  final_before_ = feed_.last_word();
  feed_.forget_last_word();
  while (true) {
    if (auto exit = look()) return *std::move(exit);
    wait();
  }
}

void AttemptFollower::wait() {
  std::unique_lock lock(wake_mutex_);
  auto interval = parts_.events.watched() ? parts_.options.times.look / 2 : parts_.options.times.look;
  // A task that waits for long in Slurm is looked at rarely.
  const bool has_waited = Clock::now() - opened_ > 2 * parts_.options.times.unanswered;
  if (!has_begun_ && has_waited && !answers_when_missed_ && submission_->state().stage == Submission::Stage::answered)
    interval = kBetweenLooksAtWaiting;
  wake_.wait_for(lock, interval, [this] { return is_woken_; });
  is_woken_ = false;
}

std::optional<jobs::WorkerExit> AttemptFollower::look() {
  // A daemon that was held up for long, as by a file system that did not answer, has missed signs of life.
  if (Clock::now() - std::exchange(last_look_, Clock::now()) > parts_.options.times.silent / 2)
    last_sign_ = Clock::now();
  const bool is_read = read_folder();
  if (feed_.read(true) == jobs::ReportFeed::Reading::broken) {
    close(true);
    return jobs::WorkerExit{.kind = ExitKind::broken};
  }
  if (!too_large_.empty()) {
    const std::string name = slurm_name(submission_->state().attempt);
    close(true);
    return jobs::WorkerExit{.kind = ExitKind::gone, .detail = name + " wrote too much: " + too_large_};
  }
  if (!has_begun_ && claim_ && !claim_->withdrawn()) {
    parts_.events.started(static_cast<int>(claim_->process()));
    has_begun_ = true;
    last_sign_ = Clock::now();
  }
  look_for_number();
  show_place();
  if (parts_.interruptions.stop.stop_requested()) {
    // Gathered attempts were not handed to Slurm; the next daemon submits them.
    static_cast<void>(submission_->withdraw());
    return jobs::WorkerExit{.kind = ExitKind::left};
  }
  if (last_word_ && is_read) return is_complete(*last_word_) ? exit_of_ended(*last_word_) : exit_of_incomplete();
  if (last_word_) return std::nullopt;
  if (auto exit = forward_requests()) return exit;
  if (!is_read) return std::nullopt;
  return has_begun_ ? look_at_begun() : look_at_waiting();
}

bool AttemptFollower::read_folder() {
  try {
    folder_.look_again();
    // Read before the files, so that everything written before the end is copied.
    if (!last_word_) last_word_ = folder_.find_ended();
    mirror_.pass();
    if (last_word_ && !ended_) ended_ = Clock::now();
    if (!has_begun_) claim_ = folder_.find_claim();
    if (const auto beat = folder_.last_beat(); beat != beat_) {
      beat_ = beat;
      last_sign_ = Clock::now();
    }
    trouble_.clear();
    return true;
  } catch (const ServiceError& error) {
    // The work in the cluster is not lost, whatever the disks are short of at the moment.
    error.kind() == ServiceError::Kind::exhausted ? void(too_large_ = error.what()) : note_trouble(error);
    return false;
  }
}

// A network file system may show the last word before what it speaks of.
bool AttemptFollower::is_complete(const Ended& ended) const {
  if (!ended.has_final()) return true;
  const bool was_here = final_before_ && final_before_->SerializeAsString() == ended.final().SerializeAsString();
  if (!feed_.last_word() && !was_here) return false;
  return !ended.final().has_summary() || store::is_own_file(job_.result());
}

std::optional<worker::Final> AttemptFollower::final_report() const {
  if (feed_.last_word() || !final_before_) return feed_.last_word();
  // A job with another attempt was not at its end before.
  const bool ends_job = jobs::is_last_word(jobs::WorkerExit{.final = final_before_}) && final_before_->shortage() == 0;
  return ends_job ? final_before_ : std::nullopt;
}

void AttemptFollower::note_trouble(const ServiceError& error) {
  if (std::exchange(trouble_, error.what()) != error.what())
    spdlog::warn("jobs/{}: {} The daemon tries again.", job_.root().filename().string(), error.what());
}

std::optional<ClusterView::Seen> AttemptFollower::seen_task(const Attempt& attempt) {
  return parts_.view.find(attempt.slurm_job(), task_index(attempt), kJobPrefix + attempt.batch());
}

void AttemptFollower::ask_slurm(std::chrono::milliseconds interval) {
  if (asked_slurm_ && Clock::now() - *asked_slurm_ < interval) return;
  asked_slurm_ = Clock::now();
  parts_.view.refresh(submission_->state().attempt.slurm_job());
}

// What the last word speaks of does not come.
std::optional<jobs::WorkerExit> AttemptFollower::exit_of_incomplete() {
  if (Clock::now() - *ended_ < 2 * parts_.options.times.lease) return std::nullopt;
  const auto attempt = submission_->state().attempt;
  close(false);
  return jobs::WorkerExit{.kind = ExitKind::gone,
                          .detail = slurm_name(attempt) + " ended, but its files are not in the shared folder."};
}

std::optional<jobs::WorkerExit> AttemptFollower::exit_of_ended(const Ended& ended) {
  auto out = exit_of_last_word(ended, submission_->state().attempt, claim_ ? claim_->host() : "");
  if (ended.kind() == Ended::LEFT && ended.reason() == Ended::TERMINATED && !ends_job(ended)) {
    // Preempted, or cancelled by somebody: Slurm says which, as soon as the task is over.
    const auto attempt = submission_->state().attempt;
    const auto seen = seen_task(attempt);
    const auto meaning = seen ? meaning_of(seen->report.state) : Meaning::unknown;
    const bool is_open = meaning == Meaning::unknown || meaning == Meaning::runs || meaning == Meaning::waits;
    if (is_open && Clock::now() - *ended_ < parts_.options.times.unanswered) {
      ask_slurm(kBetweenQuestions);
      return std::nullopt;
    }
    if (meaning == Meaning::cancelled) {
      const std::string reason = seen->report.reason.empty() ? "" : " (" + seen->report.reason + ")";
      out = {.kind = ExitKind::withdrawn, .detail = slurm_name(attempt) + " was cancelled in Slurm" + reason + "."};
    }
  }
  close(false);
  return out;
}

void AttemptFollower::show_place() {
  const auto state = submission_->state();
  std::string place;
  // Only what Slurm has taken has a place: that also says that the cluster takes jobs.
  if (state.stage == Submission::Stage::answered) {
    place = slurm_name(state.attempt);
    if (const auto seen = seen_task(state.attempt)) {
      place += ", " + seen->report.state;
      if (!seen->report.reason.empty()) place += " (" + seen->report.reason + ")";
      if (!seen->report.node.empty()) place += " on " + seen->report.node;
    }
  }
  if (!trouble_.empty() && !place.empty()) place += "; " + trouble_;
  if (std::exchange(place_, place) != place && parts_.events.placed) parts_.events.placed(place);
}

std::optional<jobs::WorkerExit> AttemptFollower::forward_requests() {
  const bool cancel = parts_.interruptions.cancel.stop_requested();
  const bool suspend = parts_.interruptions.suspend.stop_requested();
  if (!cancel && !suspend) return std::nullopt;
  const ExitKind kind = cancel ? ExitKind::cancelled : ExitKind::suspended;
  if (!has_begun_) {
    // A task that begins meanwhile is asked at the next look.
    if (!withdraw()) return std::nullopt;
    close(true);
    return jobs::WorkerExit{.kind = kind};
  }
  const auto wanted = cancel ? Request::CANCEL : Request::SUSPEND;
  if (request_ != wanted) {
    asked_ = Clock::now();
    try {
      folder_.request(wanted);
      request_ = wanted;
    } catch (const ServiceError& error) {
      note_trouble(error);
      return std::nullopt;
    }
  }
  if (Clock::now() - *asked_ < parts_.options.times.leave) return std::nullopt;
  close(true);
  return jobs::WorkerExit{.kind = kind};
}

std::optional<jobs::WorkerExit> AttemptFollower::look_at_waiting() {
  auto state = submission_->state();
  switch (state.stage) {
    case Submission::Stage::gathered:
    case Submission::Stage::taken: last_sign_ = Clock::now(); return std::nullopt;
    case Submission::Stage::refused:
    case Submission::Stage::lost: return not_submitted(state);
    case Submission::Stage::answered: break;
  }
  const auto& attempt = state.attempt;
  const auto seen = seen_task(attempt);
  const auto answers = parts_.view.answer_count();
  const auto meaning = seen ? meaning_of(seen->report.state) : Meaning::unknown;
  const bool is_over = seen && meaning != Meaning::waits && meaning != Meaning::runs && meaning != Meaning::unknown;
  if ((seen && seen->answer == answers) || unlisted_since_ == 0) {
    unlisted_since_ = answers + 1;
    answers_when_missed_.reset();
    last_sign_ = Clock::now();
  }
  const bool is_missed =
      answers >= unlisted_since_ + kMissedAnswers && Clock::now() - last_sign_ >= parts_.options.times.unanswered;
  if (!is_over && !is_missed) return std::nullopt;
  if (!is_over) {
    // The accounting may know it.
    if (!answers_when_missed_) answers_when_missed_ = answers;
    ask_slurm(kBetweenQuestions);
    if (answers < *answers_when_missed_ + 2) return std::nullopt;
  }
  // A task may have begun just now: the claim decides.
  if (!withdraw()) return std::nullopt;
  const std::string log = last_line_of_log(attempt);
  close(true);
  if (!is_over) {
    spdlog::warn("{} is no longer known to Slurm, and had not begun.", slurm_name(attempt));
    return jobs::WorkerExit{.kind = ExitKind::displaced,
                            .detail = slurm_name(attempt) + " is no longer known to Slurm."};
  }
  auto out = exit_by_meaning(meaning, final_report(),
                             slurm_name(attempt) + " ended before the crush began: " + seen->report.state + "." + log);
  // It may have ended for another attempt of its task, which is then charged with that.
  if (attempt.shares() > 1 && out.kind == ExitKind::gone) out.kind = ExitKind::displaced;
  return out;
}

// Slurm may have taken a submission whose answer was lost. It is looked for by its name, and given up by its claim.
void AttemptFollower::look_for_number() {
  auto state = submission_->state();
  if (state.stage != Submission::Stage::lost) return;
  const auto job = parts_.view.find_job(kJobPrefix + state.attempt.batch());
  if (!job) return ask_slurm(kBetweenQuestions);
  state.stage = Submission::Stage::answered;
  state.attempt.set_slurm_job(*job);
  try {
    submission_->keep(job_, state);
  } catch (const ServiceError& error) {
    // The next daemon looks for it again.
    spdlog::warn("The number of {} cannot be kept: {}", slurm_name(state.attempt), error.what());
  }
}

std::optional<jobs::WorkerExit> AttemptFollower::not_submitted(const Submission::State& state) {
  if (state.stage == Submission::Stage::lost) {
    // An answer that was asked for before sbatch ended, or at the same time, says nothing.
    const auto answers = parts_.view.answer_count();
    if (!answers_when_lost_) answers_when_lost_ = answers;
    const bool is_looked_for = answers >= *answers_when_lost_ + 2;
    if (!is_looked_for || Clock::now() - last_sign_ < parts_.options.times.unanswered) return std::nullopt;
  }
  if (!withdraw()) return std::nullopt;
  // A task that turns up later computes nothing.
  close(false);
  return jobs::WorkerExit{
      .kind = ExitKind::not_started,
      .trouble = state.trouble ? state.trouble : Trouble{Shortage::cluster, "Slurm took no job. " + state.why}};
}

std::optional<jobs::WorkerExit> AttemptFollower::look_at_begun() {
  if (Clock::now() - last_sign_ < parts_.options.times.silent) return std::nullopt;
  feed_.report_stall();
  return exit_of_silent(submission_->state());
}

std::optional<jobs::WorkerExit> AttemptFollower::exit_of_silent(const Submission::State& state) {
  const auto& attempt = state.attempt;
  ask_slurm(parts_.options.times.squeue);
  const auto seen = seen_task(attempt);
  const auto meaning = seen ? meaning_of(seen->report.state) : Meaning::unknown;
  const auto silence = Clock::now() - last_sign_;
  if (meaning == Meaning::unknown || meaning == Meaning::runs || meaning == Meaning::waits) {
    // Slurm shows it alive or does not know. After twice its lease, its task has stopped by itself.
    const bool is_listed = seen && seen->answer + kMissedAnswers >= parts_.view.answer_count();
    const bool is_alive = meaning == Meaning::runs && is_listed && parts_.view.trouble().empty();
    if (is_alive || silence < 2 * parts_.options.times.lease) return std::nullopt;
    close(true);
    const auto seconds = std::to_string(2 * parts_.options.times.lease.count() / 1000);
    return jobs::WorkerExit{.kind = ExitKind::displaced,
                            .detail = slurm_name(attempt) + " gave no sign of life for " + seconds + " s."};
  }
  // A node that Slurm cannot reach may compute all the same, until its task has lost the lease.
  if (meaning == Meaning::displaced && seen->report.state == "NODE_FAIL" &&
      silence < parts_.options.times.lease * 5 / 4)
    return std::nullopt;
  const std::string log = last_line_of_log(attempt);
  const std::string where = seen->report.node.empty() ? "" : " on " + seen->report.node;
  const std::string reason = seen->report.reason.empty() ? "" : " (" + seen->report.reason + ")";
  close(false);
  return exit_by_meaning(
      meaning, final_report(),
      slurm_name(attempt) + where + " ended without a last word: " + seen->report.state + reason + "." + log);
}

bool AttemptFollower::withdraw() {
  if (submission_->withdraw()) return true;
  try {
    Claim claim;
    claim.set_withdrawn(true);
    if (folder_.claim(claim) || !folder_.exists()) return true;
    const auto found = folder_.find_claim();
    return found && found->withdrawn();
  } catch (const ServiceError& error) {
    spdlog::warn("jobs/{}: {} The daemon tries again.", job_.root().filename().string(), error.what());
    return false;
  }
}

void AttemptFollower::close(bool ends_task) {
  const auto attempt = submission_->state().attempt;
  try {
    if (has_begun_ && folder_.exists()) folder_.request(Request::ABANDON);
  } catch (const ServiceError&) {
    // A folder that is gone says the same.
  }
  // A shared task continues with its other attempts.
  if (ends_task && attempt.slurm_job() != 0 && attempt.shares() <= 1)
    static_cast<void>(parts_.commands.scancel(attempt.slurm_job(), task_index(attempt)));
  submission_->close(job_);
  folder_.remove();
  parts_.closed(attempt, has_begun_);
}

std::string AttemptFollower::last_line_of_log(const Attempt& attempt) const {
  try {
    const store::InputFile file(Batcher::batch_folder(parts_.options, attempt.batch()) /
                                ("task-" + std::to_string(attempt.task()) + ".log"));
    const std::string log = file.read(std::max<std::int64_t>(0, file.size() - kEndOfLog), kEndOfLog);
    auto end = log.find_last_not_of(" \n\r\t");
    if (end == std::string::npos) return "";
    const auto begin = log.find_last_of('\n', end);
    return " Its log ends with: " + log.substr(begin == std::string::npos ? 0 : begin + 1, end - begin);
  } catch (const ServiceError&) {
    return "";
  }
}

}  // namespace cellcrush::slurm
