#pragma once

#include <google/protobuf/field_mask.pb.h>
#include <google/protobuf/map.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "audit_log.h"
#include "error.h"
#include "store/journal_reader.h"
#include "store/journal_schema.h"
#include "store/page_room.h"

namespace cellcrush::rpc {

// Maximum lengths of request fields other than a case, in bytes. They far exceed any use, but keep a caller from
// occupying the daemon with a text of 4 MiB, the size limit of a message. A token of WatchSweep has up to 20 bytes for
// each job.
inline constexpr std::size_t kLongestName = 128;
inline constexpr std::size_t kLongestFilter = 4096;
inline constexpr std::size_t kLongestOrder = 128;
inline constexpr std::size_t kLongestPageToken = 128;
inline constexpr std::size_t kLongestResumeToken = 3 * 1024 * 1024;
inline constexpr std::size_t kLongestJobsToken = 128;

/// Maximum size of a request, in bytes.
inline constexpr int kLargestMessage = 4 * 1024 * 1024;

/// Maximum number of jobs that one WatchJobs watches in full.
inline constexpr int kMostWatchedJobs = 64;

/// Maximum size of a case, or of a sweep with its case and points, in bytes. A returned Job or Sweep adds the daemon's
/// own fields and must fit in 4 MiB, the default limit of a client. plan_sweep limits a sweep of many points further.
inline constexpr std::size_t kLargestCase = 4'000'000;

/// Throws InvalidField if it is larger.
void check_size(const std::string& field, std::size_t bytes, std::size_t largest);

/// Throws InvalidField if the text is longer.
void check_length(const std::string& field, const std::string& text, std::size_t longest);

/// Throws ServiceError (failed_precondition) if the caller's epoch differs from the journal's. An empty epoch always
/// passes.
void check_epoch(const store::Epoch& epoch, const std::string& given);

/// Checks the common fields of create calls: request_id (at most 128 characters) and labels (at most 64; keys of 1 to
/// 63 characters, values of at most 255). Throws InvalidField; `prefix` precedes "labels".
void check_request(const std::string& request_id, const google::protobuf::Map<std::string, std::string>& labels,
                   const std::string& prefix = "");

/// Checks a note: at most 2000 bytes, no control characters but line feeds. Throws InvalidField.
void check_note(const std::string& field, const std::string& note);

/// Checks the common fields of UpdateJob and UpdateSweep, for `note` in `resource`. Throws InvalidField.
void check_update(const google::protobuf::FieldMask& mask, const std::string& resource, const std::string& note);

/// Throws InvalidField unless the priority is -100 to 100.
void check_priority(int priority, const std::string& field);

/// Hash of a CreateJobRequest or CreateSweepRequest and its owner, without the id: equal for a repetition of the call
/// by the same owner. Empty without an id, as nothing then looks for a repetition.
template <class Request>
std::string payload_hash(Request request, const std::string& owner);

/// The job with that name. Throws ServiceError (not_found) if there is none, and InvalidField if the name is too long.
store::StoredJob find_job(store::JournalReader& journal, const std::string& name);

/// Limit of a page, below a client's limit of 4 MiB.
inline constexpr std::size_t kPageBytes = 3'000'000;

/// The requested part of a list. Resources are numbered in order of creation. A page starts after the number in its
/// token, so that creations and deletions in between do not shift pages.
struct Page {
  int size = 0;
  std::int64_t after = 0;  ///< last number of the previous page; 0 for the first page

  [[nodiscard]] store::PageRoom room() const { return {size, kPageBytes}; }
};

/// Reads page_size (0: 50; more than 1000 is 1000) and page_token. `question` identifies the list, with the same text
/// for all its pages. Throws InvalidField for a negative size, and for a token that is malformed or belongs to another
/// list.
Page read_page(int page_size, const std::string& page_token, const std::string& question);

/// The same for small, numerous entries: page_size 0 means as many as fit in kPageBytes.
Page read_full_page(int page_size, const std::string& page_token, const std::string& question);

/// Token of the page after the resource with this number.
std::string page_token(std::int64_t last, const std::string& question);

/// Logs that a call which changes something was accepted: "jobs/12 made by anna, request \"night 3\"", and has it
/// audited. `name` is the job or sweep, or empty for the daemon; `request_id` is the caller's, or empty.
void log_change(AuditLog& audit, const std::string& name, const std::string& done, const std::string& caller,
                const std::string& request_id = "");

/// Makes a change that may outlast its call. It is logged too if its caller gives up, or if it fails half-way.
template <class Change>
void make_logged_change(AuditLog& audit, const std::string& name, const std::string& done, const std::string& caller,
                        const Change& change) {
  try {
    change();
  } catch (const ServiceError& error) {
    const bool is_refused =
        error.kind() == ServiceError::Kind::not_found || error.kind() == ServiceError::Kind::failed_precondition;
    if (!is_refused) log_change(audit, name, done + " in part, or soon", caller);
    throw;
  }
  log_change(audit, name, done, caller);
}

}  // namespace cellcrush::rpc
