#include "rpc/request_fields.h"

#include <absl/strings/ascii.h>
#include <absl/strings/str_replace.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <utility>

#include "access/unix_user.h"
#include "cellcrush/v1/jobs_service.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"
#include "error.h"
#include "log_format.h"
#include "store/case_hash.h"
#include "store/journal_mending.h"
#include "store/resource_name.h"

namespace cellcrush::rpc {
namespace {

constexpr std::size_t kLongestId = 128;
constexpr std::size_t kMostLabels = 64;
constexpr std::size_t kLongestKey = 63;
constexpr std::size_t kLongestValue = 255;
constexpr std::size_t kLongestNote = 2000;
constexpr int kHighestPriority = 100;

constexpr int kDefaultPage = 50;
constexpr int kLargestPage = 1000;

// FNV-1a: distinguishes lists, but keeps nothing secret.
std::string mark_of(const std::string& question) {
  std::uint32_t hash = 2166136261U;
  for (const char character : question) hash = (hash ^ static_cast<unsigned char>(character)) * 16777619U;
  return fmt::format("{:08x}", hash);
}

// The number in a token; 0 for no token.
std::int64_t read_token(const std::string& text, const std::string& question) {
  if (text.empty()) return 0;
  check_length("page_token", text, kLongestPageToken);
  std::int64_t after = 0;
  const auto [stopped, error] = std::from_chars(text.data(), text.data() + text.size(), after);
  if (error != std::errc() || after < 1 || text != page_token(after, question)) {
    throw InvalidField("page_token", "is not a token of this list.",
                       "Use the next_page_token of the previous page, with the same filter and order_by, or name.");
  }
  return after;
}

}  // namespace

void check_size(const std::string& field, std::size_t bytes, std::size_t largest) {
  if (bytes <= largest) return;
  throw InvalidField(field, "has " + std::to_string(bytes) + " bytes.", "Use at most " + std::to_string(largest) + ".");
}

void check_length(const std::string& field, const std::string& text, std::size_t longest) {
  check_size(field, text.size(), longest);
}

void check_epoch(const store::Epoch& epoch, const std::string& given) {
  if (given.empty() || given == epoch.id) return;
  throw ServiceError(
      ServiceError::Kind::failed_precondition,
      "The after_sequence comes" + epoch.of_before() +
          ": its number may now belong to a different event. Watch again without after_sequence and epoch.");
}

void check_request(const std::string& request_id, const google::protobuf::Map<std::string, std::string>& labels,
                   const std::string& prefix) {
  if (request_id.size() > kLongestId)
    throw InvalidField("request_id", "has " + std::to_string(request_id.size()) + " characters.", "Use at most 128.");
  const std::string field = prefix + "labels";
  if (labels.size() > kMostLabels)
    throw InvalidField(field, "are " + std::to_string(labels.size()) + ".", "Use at most 64.");
  for (const auto& [key, value] : labels) {
    if (key.empty() || key.size() > kLongestKey)
      throw InvalidField(field, "have the key \"" + key + "\", of invalid length.", "Use 1 to 63 characters.");
    if (value.size() > kLongestValue)
      throw InvalidField(field, "have a value that is too long for \"" + key + "\".", "Use at most 255 characters.");
  }
}

void check_note(const std::string& field, const std::string& note) {
  check_length(field, note, kLongestNote);
  const auto found = std::ranges::find_if(
      note, [](char character) { return character != '\n' && (absl::ascii_iscntrl(character) != 0); });
  if (found == note.end()) return;
  throw InvalidField(field, fmt::format("has the control character 0x{:02x}.", *found),
                     "Use printable characters and line feeds.");
}

void check_update(const google::protobuf::FieldMask& mask, const std::string& resource, const std::string& note) {
  const std::string remedy = "Use \"note\", the only field that can be written.";
  if (mask.paths().empty()) throw InvalidField("update_mask", "is empty.", remedy);
  for (const std::string& path : mask.paths()) {
    if (path != "note") throw InvalidField("update_mask", "has the path \"" + path + "\".", remedy);
  }
  check_note(resource + ".note", note);
}

void check_priority(int priority, const std::string& field) {
  if (priority < -kHighestPriority || priority > kHighestPriority)
    throw InvalidField(field, "is " + std::to_string(priority) + ".",
                       "Use -100 to 100; higher priorities start first.");
}

template <class Request>
std::string payload_hash(Request request, const std::string& owner) {
  if (request.request_id().empty()) return "";
  request.clear_request_id();
  request.clear_validate_only();
  // The form without owners, which journals of earlier versions hold.
  return store::hash_of(request) + (owner == access::own_user() ? "" : " " + owner);
}
template std::string payload_hash(v1::CreateJobRequest request, const std::string& owner);
template std::string payload_hash(v1::CreateSweepRequest request, const std::string& owner);

store::StoredJob find_job(store::JournalReader& journal, const std::string& name) {
  check_length("name", name, kLongestName);
  const auto number = store::number_of(name);
  auto stored = number ? journal.find_job(*number) : std::nullopt;
  if (!stored) {
    throw ServiceError(
        ServiceError::Kind::not_found,
        "There is no job \"" + name + "\". Job names look like jobs/12; ListJobs (`cellcrush list`) lists them.");
  }
  if (stored->is_damaged) throw store::unreadable_entry(stored->number);
  return *std::move(stored);
}

Page read_page(int page_size, const std::string& page_token_text, const std::string& question) {
  if (page_size < 0) throw InvalidField("page_size", "is negative.", "Use 1 to 1000, or 0 for 50.");
  return {page_size == 0 ? kDefaultPage : std::min(page_size, kLargestPage), read_token(page_token_text, question)};
}

Page read_full_page(int page_size, const std::string& page_token_text, const std::string& question) {
  if (page_size < 0) throw InvalidField("page_size", "is negative.", "Use 0 for as many as fit.");
  return {page_size == 0 ? std::numeric_limits<int>::max() : page_size, read_token(page_token_text, question)};
}

std::string page_token(std::int64_t last, const std::string& question) {
  return std::to_string(last) + "-" + mark_of(question);
}

void log_change(AuditLog& audit, const std::string& name, const std::string& done, const std::string& caller,
                const std::string& request_id) {
  audit.note_change(name, done, caller, request_id);
  const std::string subject = name.empty() ? "the daemon" : name;
  // In quotes, so that it cannot be mistaken for the rest of the line; the form of the log escapes control characters.
  const std::string quoted = "\"" + absl::StrReplaceAll(request_id, {{"\"", "\\\""}, {"\\", "\\\\"}}) + "\"";
  const std::string request = request_id.empty() ? "" : ", request " + quoted;
  const bool is_sweep = name.starts_with("sweeps/");
  log_with_fields(spdlog::level::info, subject + " " + done + " by " + caller + request,
                  {{is_sweep ? "sweep" : "job", name}, {"caller", caller}, {"request", request_id}});
}

}  // namespace cellcrush::rpc
