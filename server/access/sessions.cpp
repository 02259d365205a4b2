#include "access/sessions.h"

#include <cstddef>
#include <utility>

#include "error.h"

namespace cellcrush::access {
namespace {

constexpr std::ptrdiff_t kMostOfCaller = 100;

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
  return {url_ + "/sign-in?" + (page.empty() ? "" : "page=" + page + "&") + "code=" + add(codes_, {caller, end}), end};
}

std::optional<std::string> Sessions::redeem(const std::string& code, std::optional<uid_t> user) {
  const MutexLock lock(mutex_);
  const auto found = find_live(codes_, code);
  if (found == codes_.end()) return std::nullopt;
  const Caller caller = found->second.caller;
  codes_.erase(found);
  return add(sessions_, {caller, now_() + kSessionLasts, user});
}

std::optional<Caller> Sessions::find(const std::string& session, std::optional<uid_t> user) {
  const MutexLock lock(mutex_);
  const auto found = find_live(sessions_, session);
  const bool is_own = found != sessions_.end() && found->second.user == user;
  return is_own ? std::optional(found->second.caller) : std::nullopt;
}

void Sessions::end_all() {
  const MutexLock lock(mutex_);
  codes_.clear();
  sessions_.clear();
}

std::string Sessions::add(Entries& entries, Entry entry) {
  auto oldest = entries.end();
  std::ptrdiff_t count = 0;
  for (auto each = entries.begin(); each != entries.end(); ++each) {
    if (each->second.caller.name != entry.caller.name) continue;
    ++count;
    if (oldest == entries.end() || each->second.end < oldest->second.end) oldest = each;
  }
  if (count >= kMostOfCaller) entries.erase(oldest);
  std::string word = random_word();
  entries[hash_of_word(word)] = std::move(entry);
  return word;
}

Sessions::Entries::iterator Sessions::find_live(Entries& entries, const std::string& word) {
  const auto found = entries.find(hash_of_word(word));
  return found != entries.end() && found->second.end > now_() ? found : entries.end();
}

}  // namespace cellcrush::access
