#include "access/sessions.h"

#include <algorithm>

#include "error.h"

namespace cellcrush::access {
namespace {

constexpr std::size_t kMostEntries = 1000;

}  // namespace

void Sessions::serve_at(const std::string& url) {
  const MutexLock lock(mutex_);
  url_ = url;
}

Sessions::Link Sessions::make_link(const Caller& caller, const std::string& page) {
  const MutexLock lock(mutex_);
  if (url_.empty()) {
    throw ServiceError(
        ServiceError::Kind::failed_precondition,
        "This daemon serves no web page. Start it with --http HOST:PORT; its log says why it serves none "
        "by default.");
  }
  const auto end = now_() + kCodeLasts;
  return {url_ + "/sign-in?" + (page.empty() ? "" : "page=" + page + "&") + "code=" + add(codes_, caller, end), end};
}

std::optional<std::string> Sessions::redeem(const std::string& code) {
  const MutexLock lock(mutex_);
  const auto found = find_live(codes_, code);
  if (found == codes_.end()) return std::nullopt;
  const Caller caller = found->second.caller;
  codes_.erase(found);
  return add(sessions_, caller, now_() + kSessionLasts);
}

std::optional<Caller> Sessions::find(const std::string& session) {
  const MutexLock lock(mutex_);
  const auto found = find_live(sessions_, session);
  return found == sessions_.end() ? std::nullopt : std::optional(found->second.caller);
}

void Sessions::end_all() {
  const MutexLock lock(mutex_);
  codes_.clear();
  sessions_.clear();
}

std::string Sessions::add(Entries& entries, const Caller& caller, Clock::time_point end) {
  if (entries.size() >= kMostEntries) {
    entries.erase(std::ranges::min_element(entries, {}, [](const auto& entry) { return entry.second.end; }));
  }
  std::string word = random_word();
  entries[hash_of_word(word)] = {caller, end};
  return word;
}

Sessions::Entries::iterator Sessions::find_live(Entries& entries, const std::string& word) {
  const auto found = entries.find(hash_of_word(word));
  return found != entries.end() && found->second.end > now_() ? found : entries.end();
}

}  // namespace cellcrush::access
