#include "slurm/attempt_run.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "error.h"
#include "pause.h"
#include "slurm/attempt_exit.h"
#include "slurm/small_file.h"
#include "store/lattice_file.h"

namespace cellcrush::slurm {
namespace {

constexpr std::chrono::milliseconds kBetweenPasses{500};
constexpr std::chrono::milliseconds kBetweenBeats{5'000};

}  // namespace

void AttemptRun::run(const store::JobFolder& folder) {
  const auto order = read_message<worker::Order>(folder.order(), kOrder);
  if (!order) throw ServiceError(ServiceError::Kind::data_loss, folder.order().string() + " is damaged.");
  worker::Order whole = *order;
  store::read_lattice_of(folder, whole);
  mirror_.emplace(folder, shared_.files(), size_of(folder.reports()));
  jobs::WorkerEvents events;
  events.started = [](int) {};
  events.watched = [] { return false; };
  events.reported = [this](const worker::Report& report) {
    if (report.has_begun()) first_step_ = report.begun().step();
  };
  jobs::WorkerExit exit;
  {
    const std::jthread beside([this](const std::stop_token& worker_ended) { accompany(worker_ended); });
    const std::jthread watch([this](const std::stop_token& worker_ended) { watch_lease(worker_ended); });
    const jobs::Interruptions interruptions{leave_.get_token(), suspend_.get_token(), cancel_.get_token()};
    exit = workers_.run(folder, *order, events, interruptions);
  }
  if (is_abandoned_) return;
  hand_over(last_word_of(exit));
}

void AttemptRun::accompany(const std::stop_token& worker_ended) {
  std::string trouble;
  do {
    if (end_.load() != Ended::REASON_UNSPECIFIED) leave_.request_stop();
    try {
      if (!keep_contact()) return;
      trouble.clear();
    } catch (const std::exception& error) {
      if (std::exchange(trouble, error.what()) != error.what()) spdlog::warn("trying again: {}", error.what());
    }
  } while (pause_unless_stopped(worker_ended, kBetweenPasses));
}

// Time in which Slurm had suspended the task does not count: it then makes contact first.
void AttemptRun::watch_lease(const std::stop_token& worker_ended) {
  auto contact = last_contact_.load();
  auto before = Clock::now();
  Clock::duration silence{};
  while (pause_unless_stopped(worker_ended, kBetweenPasses)) {
    const auto now = Clock::now();
    silence += std::min<Clock::duration>(now - std::exchange(before, now), 2 * kBetweenPasses);
    if (const auto newest = last_contact_.load(); newest != contact) {
      contact = newest;
      silence = {};
    }
    if (silence <= lease_) continue;
    is_lease_lost_ = true;
    leave_.request_stop();
    return;
  }
}

// False once the attempt is no longer this task's.
bool AttemptRun::keep_contact() {
  const auto request = shared_.requested();
  obey(request);
  if (request == Request::ABANDON) return false;
  if (Clock::now() - last_beat_ > kBetweenBeats) {
    shared_.beat(++beats_);
    last_beat_ = Clock::now();
  }
  last_contact_ = Clock::now();
  mirror_->pass();
  return true;
}

void AttemptRun::obey(Request::Kind request) {
  switch (request) {
    case Request::SUSPEND: suspend_.request_stop(); break;
    case Request::CANCEL: cancel_.request_stop(); break;
    case Request::ABANDON:
      is_abandoned_ = true;
      cancel_.request_stop();
      break;
    default: break;
  }
}

Ended AttemptRun::last_word_of(const jobs::WorkerExit& exit) const {
  Ended out;
  out.set_kind(ended_kind(exit.kind));
  out.set_code(exit.code);
  out.set_out_of_memory(exit.out_of_memory);
  out.set_message(exit.detail);
  if (exit.final) *out.mutable_final() = *exit.final;
  if (exit.kind == jobs::WorkerExit::Kind::not_started)
    out.set_message("no worker could be started: " + std::generic_category().message(exit.code) + ".");
  // SIGTERM may reach the worker before this task has passed it on.
  const auto reason = end_.load();
  const bool has_left = exit.final && exit.final->has_suspended_step() && exit.final->shortage() == 0;
  const bool is_told = reason != Ended::REASON_UNSPECIFIED || is_lease_lost_;
  if (out.kind() == Ended::EXITED && has_left && is_told) out.set_kind(Ended::LEFT);
  if (out.kind() != Ended::LEFT) return out;
  out.set_reason(reason != Ended::REASON_UNSPECIFIED ? reason : Ended::LEASE);
  out.set_advanced(exit.final && exit.final->suspended_step() > first_step_);
  return out;
}

void AttemptRun::hand_over(const Ended& ended) {
  std::string trouble;
  while (true) {
    try {
      if (shared_.requested() == Request::ABANDON) return;
      mirror_->pass();
      shared_.end(ended);
      return;
    } catch (const std::exception& error) {
      if (std::exchange(trouble, error.what()) != error.what()) spdlog::warn("trying again: {}", error.what());
    }
    // A shared folder that is full for long is waited for: the job's results are here only.
    try {
      shared_.beat(++beats_);
    } catch (const std::exception&) {
      // As above.
    }
    std::this_thread::sleep_for(kBetweenPasses);
  }
}

}  // namespace cellcrush::slurm
