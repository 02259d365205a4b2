#include "watch/hub.h"

#include <algorithm>
#include <utility>

#include "error.h"
#include "store/job_state.h"
#include "store/resource_name.h"
#include "translate/case_words.h"

namespace cellcrush::watch {

namespace {

RecentEvents::Event entry_of(v1::JobEvent event) {
  RecentEvents::Entry out{.sequence = event.sequence(), .is_sample = event.has_sample()};
  if (event.has_state()) {
    out.begins_again = event.state().begun_again_sequence() == event.sequence();
    out.is_last = store::is_terminal(event.state().state());
  }
  translate::add_words(event);
  event.SerializeToString(&out.bytes);
  return std::make_shared<const RecentEvents::Entry>(std::move(out));
}

}  // namespace

std::shared_ptr<RecentEvents::Window> RecentEvents::window_of(std::int64_t job) {
  const MutexLock lock(mutex_);
  if (!windows_.contains(job) && windows_.size() >= kMostJobs) {
    windows_.erase(std::ranges::min_element(windows_, {}, [](const auto& entry) { return entry.second->turn.load(); }));
  }
  auto& out = windows_[job];
  if (!out) out = std::make_shared<Window>();
  out->turn = ++turn_;
  return out;
}

bool RecentEvents::ends_with(std::int64_t job, std::int64_t after, std::uint64_t stamp) {
  const auto window = window_of(job);
  const MutexLock lock(window->mutex);
  return after == window->last && window->end_stamp && *window->end_stamp >= stamp;
}

void RecentEvents::forget(std::int64_t job) {
  const MutexLock lock(mutex_);
  windows_.erase(job);
}

std::vector<RecentEvents::Event> RecentEvents::read(store::JournalReader& journal, std::int64_t job,
                                                    std::int64_t after) {
  ++reads_;
  std::vector<Event> out;
  for (auto& event : journal.events(job, after, kAtOnce)) out.push_back(entry_of(std::move(event)));
  if (out.empty() && !journal.has_job(job))
    throw ServiceError(ServiceError::Kind::not_found, "There is no " + store::name_of(job) + ".");
  return out;
}

std::vector<RecentEvents::Event> RecentEvents::after(store::JournalReader& journal, std::int64_t job,
                                                     std::int64_t after, std::uint64_t stamp) {
  const auto window = window_of(job);
  // Others who are at the same event wait for what the first of them reads.
  MutexLock lock(window->mutex);
  if (after < window->before) {
    lock.unlock();
    return read(journal, job, after);
  }
  if (after < window->last) {
    const auto first = std::ranges::partition_point(window->events,
                                                    [after](const Event& event) { return event->sequence <= after; });
    return {first, first + std::min<std::ptrdiff_t>(kAtOnce, window->events.end() - first)};
  }
  const auto begin_behind = [&window](std::int64_t event) CELLCRUSH_REQUIRES(window->mutex) {
    window->events.clear();
    window->bytes = 0;
    window->before = window->last = event;
    window->end_stamp.reset();
  };
  if (after > window->last) begin_behind(after);
  if (window->end_stamp && *window->end_stamp >= stamp) return {};
  auto out = read(journal, job, after);
  if (out.empty()) {
    window->end_stamp = stamp;
    return out;
  }
  // When a job begins again, its samples no longer count.
  if (std::ranges::any_of(out, [](const Event& event) { return event->begins_again; })) begin_behind(after);
  window->last = out.back()->sequence;
  for (const Event& event : out) window->bytes += event->bytes.size();
  window->events.insert(window->events.end(), out.begin(), out.end());
  while (window->bytes > kMostBytes) {
    window->before = window->events.front()->sequence;
    window->bytes -= window->events.front()->bytes.size();
    window->events.pop_front();
  }
  return out;
}

void Channel::publish(v1::Mesh mesh) {
  const MutexLock lock(mutex_);
  newest_.mesh = std::make_shared<const PublishedMesh>(std::move(mesh));
  for (const auto& [id, watcher] : watchers_) watcher.wake();
}

void Channel::publish(v1::Progress progress) {
  const MutexLock lock(mutex_);
  newest_.progress = std::make_shared<const v1::Progress>(std::move(progress));
  ++newest_.progress_count;
  for (const auto& [id, watcher] : watchers_) watcher.wake();
}

void Channel::publish(v1::FieldFrame frame) {
  const MutexLock lock(mutex_);
  if (newest_.frame && frame.index() <= newest_.frame->index()) return;
  newest_.frame = std::make_shared<const PublishedFrame>(std::move(frame), newest_.mesh);
  ++newest_.frame_count;
  for (const auto& [id, watcher] : watchers_) {
    if (watcher.frames) watcher.wake();
  }
}

void Channel::set_place(std::string place) {
  const MutexLock lock(mutex_);
  newest_.place = std::move(place);
}

void Channel::forget() {
  const MutexLock lock(mutex_);
  newest_.mesh.reset();
  newest_.progress.reset();
  newest_.frame.reset();
}

void Channel::announce(std::uint64_t stamp) {
  const MutexLock lock(mutex_);
  stamp_ = std::max(stamp_, stamp);
  for (const auto& [id, watcher] : watchers_) watcher.wake();
}

std::uint64_t Channel::stamp() const {
  const MutexLock lock(mutex_);
  return stamp_;
}

Channel::Newest Channel::newest() const {
  const MutexLock lock(mutex_);
  return newest_;
}

bool Channel::is_watched() const {
  const MutexLock lock(mutex_);
  return !watchers_.empty();
}

std::uint64_t Channel::subscribe(Wake wake, bool frames) {
  const MutexLock lock(mutex_);
  watchers_.emplace(next_id_, Watcher{std::move(wake), frames});
  return next_id_++;
}

void Channel::unsubscribe(std::uint64_t id) {
  const MutexLock lock(mutex_);
  watchers_.erase(id);
}

std::shared_ptr<Channel> Hub::open(std::int64_t job) {
  const MutexLock lock(mutex_);
  if (auto channel = channels_[job].lock()) return channel;
  // Only when the map has doubled, so that opening many channels stays cheap.
  if (channels_.size() > 2 * kept_ + 64) {
    std::erase_if(channels_, [](const auto& entry) { return entry.second.expired(); });
    kept_ = channels_.size();
  }
  auto channel = std::make_shared<Channel>(stamp_);
  channels_[job] = channel;
  return channel;
}

std::shared_ptr<Channel> Hub::find(std::int64_t job) {
  const MutexLock lock(mutex_);
  const auto found = channels_.find(job);
  return found == channels_.end() ? nullptr : found->second.lock();
}

std::vector<std::pair<std::int64_t, std::shared_ptr<Channel>>> Hub::channels() {
  const MutexLock lock(mutex_);
  std::vector<std::pair<std::int64_t, std::shared_ptr<Channel>>> out;
  for (const auto& [job, channel] : channels_) {
    if (auto held = channel.lock()) out.emplace_back(job, std::move(held));
  }
  return out;
}

void Hub::announce(std::int64_t job) {
  // Counted before the channel is looked up: one that is opened meanwhile begins with this stamp.
  const std::uint64_t stamp = ++stamp_;
  if (const auto channel = find(job)) channel->announce(stamp);
  const MutexLock lock(watchers_mutex_);
  for (const auto& [id, wake] : watchers_) wake();
}

std::uint64_t Hub::subscribe(Channel::Wake wake) {
  const MutexLock lock(watchers_mutex_);
  watchers_.emplace(next_id_, std::move(wake));
  return next_id_++;
}

void Hub::unsubscribe(std::uint64_t id) {
  const MutexLock lock(watchers_mutex_);
  watchers_.erase(id);
}

}  // namespace cellcrush::watch
