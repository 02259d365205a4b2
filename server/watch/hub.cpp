#include "watch/hub.h"

#include <algorithm>
#include <utility>

#include "error.h"
#include "store/resource_name.h"

namespace cellcrush::watch {

RecentEvents::Answers& RecentEvents::answers_of(std::int64_t job, std::uint64_t stamp) {
  if (!answers_.contains(job) && answers_.size() >= kMostJobs) {
    answers_.erase(std::min_element(answers_.begin(), answers_.end(), [](const auto& one, const auto& other) {
      return one.second.turn < other.second.turn;
    }));
  }
  Answers& out = answers_[job];
  out.turn = ++turn_;
  if (std::exchange(out.stamp, std::max(out.stamp, stamp)) < stamp) out.events.clear();
  return out;
}

std::vector<RecentEvents::Event> RecentEvents::after(store::JournalReader& journal, std::int64_t job,
                                                     std::int64_t after, std::uint64_t stamp) {
  {
    const MutexLock lock(mutex_);
    const auto& known = answers_of(job, stamp).events;
    if (const auto found = known.find(after); found != known.end()) return found->second;
    ++reads_;
  }
  // Without the lock, as a result may be large.
  std::vector<Event> out;
  std::size_t bytes = 0;
  for (auto& event : journal.events(job, after, kAtOnce)) {
    bytes += event.ByteSizeLong();
    out.push_back(std::make_shared<const v1::JobEvent>(std::move(event)));
  }
  if (out.empty() && !journal.has_job(job))
    throw ServiceError(ServiceError::Kind::not_found, "There is no " + store::name_of(job) + ".");
  const MutexLock lock(mutex_);
  Answers& answers = answers_of(job, stamp);
  if (stamp < answers.stamp || bytes > kMostBytes) return out;
  answers.events.emplace(after, out);
  // That of the watcher that lags most goes first.
  if (answers.events.size() > kMostAnswers) answers.events.erase(answers.events.begin());
  return out;
}

std::int64_t RecentEvents::reads() const {
  const MutexLock lock(mutex_);
  return reads_;
}

void Channel::publish(v1::Mesh mesh) {
  const MutexLock lock(mutex_);
  newest_.mesh = std::make_shared<const v1::Mesh>(std::move(mesh));
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
