#include <absl/strings/escaping.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <utility>

#include "access/secret_file.h"
#include "error.h"
#include "listen_address.h"
#include "notices/receiver.h"
#include "run_program.h"
#include "store/case_hash.h"

namespace cellcrush::notices {
namespace {

constexpr std::size_t kLeastKey = 24;  // bytes, as Standard Webhooks has it
constexpr std::size_t kLargestKey = 64;
constexpr std::size_t kLongestUrl = 2048;
constexpr const char* kSecretOption = "--webhook-secret";

[[noreturn]] void refuse(const std::string& why) { throw ServiceError(ServiceError::Kind::invalid, why); }

std::string read_key(const std::filesystem::path& path) {
  std::string text = access::read_named_file(kSecretOption, path, access::Secrecy::secret);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  auto key = key_of(text);
  if (key.empty()) {
    access::refuse_file(kSecretOption, path,
                        "is not \"whsec_\" and 24 to 64 bytes in base64. Make one with "
                        "echo \"whsec_$(openssl rand -base64 32)\" > " +
                            path.string());
  }
  return key;
}

bool is_on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::string folders = path == nullptr ? "/usr/bin:/bin" : path;
  for (std::size_t begin = 0; begin <= folders.size();) {
    const auto end = std::min(folders.find(':', begin), folders.size());
    if (::access((folders.substr(begin, end - begin) + "/" + program).c_str(), X_OK) == 0) return true;
    begin = end + 1;
  }
  return false;
}

// Says no more of a URL than its host: it may hold a secret.
void check_url(const std::string& option, const std::string& url) {
  const bool is_printable =
      std::ranges::all_of(url, [](char c) { return c > ' ' && c < '\x7f' && c != '"' && c != '\\'; });
  const auto host = host_of(url);
  const bool has_scheme = url.starts_with("https://") || url.starts_with("http://");
  if (!has_scheme || url.size() > kLongestUrl || !is_printable || host.empty() || host.find('@') != std::string::npos)
    refuse(option +
           " is not a URL that can be used. Write https://HOST/PATH, without spaces, quotes, backslashes and @.");
  if (url.starts_with("https://")) return;
  const auto end_of_number = host.find(']');
  const bool has_port = host.find(':', end_of_number == std::string::npos ? 0 : end_of_number) != std::string::npos;
  bool is_loopback = false;
  try {
    is_loopback = parse_listen_address(has_port ? host : host + ":80").is_loopback();
  } catch (const ServiceError&) {
    is_loopback = false;
  }
  if (!is_loopback)
    refuse(option + " http://" + host +
           " sends what others can read on the way. Use https://, or a receiver on 127.0.0.1.");
}

std::string now_in_seconds() {
  return std::to_string(
      std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch()).count());
}

std::string key_for(const std::string& kind, const std::string& place) {
  return kind + ":" + store::sha256_of(place).substr(0, 16);
}

bool is_one_of(const std::vector<std::string>& types, const std::string& type) {
  return types.empty() || std::ranges::find(types, type) != types.end();
}

/// An HTTP endpoint that takes Standard Webhooks.
class Webhook final : public Receiver {
 public:
  Webhook(std::string url, std::string key, const Options& options)
      : url_(std::move(url)), key_(std::move(key)), options_(options) {}

  Result send(const Notice& notice, const std::stop_token& stop, std::string& why) override {
    const std::string time = now_in_seconds();
    return post(url_,
                {"webhook-id: " + notice.id, "webhook-timestamp: " + time,
                 "webhook-signature: " + signature_of(key_, notice.id, time, notice.body)},
                notice.body, options_.answer_limit, stop, why);
  }
  [[nodiscard]] std::string name() const override { return host_of(url_); }
  [[nodiscard]] std::string key() const override { return key_for("webhook", url_); }
  [[nodiscard]] bool wants(const std::string& type) const override { return is_one_of(options_.types, type); }

 private:
  std::string url_;
  std::string key_;
  Options options_;
};

/// A program of the administrator: the notice on its input, type and resource in its environment.
class Command final : public Receiver {
 public:
  explicit Command(const Options& options) : options_(options) {}

  Result send(const Notice& notice, const std::stop_token& stop, std::string& why) override {
    try {
      const auto end =
          run_program({"env", "CELLCRUSH_NOTICE=" + notice.type, "CELLCRUSH_RESOURCE=" + notice.resource,
                       "CELLCRUSH_NOTICE_ID=" + notice.id, "sh", "-c", "exec \"$0\"", options_.command.string()},
                      options_.answer_limit, stop, notice.body);
      if (end.is_good()) return Result::taken;
      why = what_failed(options_.command.filename().string(), end);
    } catch (const std::exception& error) {
      why = error.what();
    }
    return Result::failed;
  }
  [[nodiscard]] std::string name() const override { return options_.command.filename().string(); }
  [[nodiscard]] std::string key() const override { return key_for("command", options_.command.string()); }
  [[nodiscard]] bool wants(const std::string& type) const override { return is_one_of(options_.types, type); }

 private:
  Options options_;
};

/// A collector of traces: gets the spans of each job that has ended.
class Collector final : public Receiver {
 public:
  Collector(const Options& options, std::string epoch, store::JournalReader& reader)
      : options_(options), epoch_(std::move(epoch)), reader_(reader) {}

  Result send(const Notice& notice, const std::stop_token& stop, std::string& why) override {
    try {
      const auto states = reader_.states(notice.job);
      if (states.empty()) return Result::taken;  // deleted meanwhile
      return post(options_.traces, {}, spans_of(states, epoch_), options_.answer_limit, stop, why);
    } catch (const ServiceError& error) {
      why = error.what();
      return error.kind() == ServiceError::Kind::data_loss ? Result::refused : Result::failed;
    }
  }
  [[nodiscard]] std::string name() const override { return "traces"; }
  [[nodiscard]] std::string key() const override { return key_for("traces", options_.traces); }
  [[nodiscard]] bool wants(const std::string& type) const override { return type.starts_with("job."); }

 private:
  Options options_;
  std::string epoch_;
  store::JournalReader& reader_;
};

}  // namespace

void check(const Options& options) {
  for (const auto& url : options.webhooks) check_url("--webhook", url);
  if (!options.traces.empty()) check_url("--traces", options.traces);
  if (options.webhooks.empty() != options.webhook_secret.empty())
    refuse(
        "--webhook and --webhook-secret belong together: a receiver knows by its signature that a notice is from "
        "this daemon. Give both or neither.");
  if (!options.webhook_secret.empty()) static_cast<void>(read_key(options.webhook_secret));
  if ((!options.webhooks.empty() || !options.traces.empty()) && !is_on_path("curl"))
    refuse("--webhook and --traces send with curl, which is not installed. Run apt-get install curl.");
  if (!options.command.empty() && (!options.command.is_absolute() || ::access(options.command.c_str(), X_OK) != 0))
    refuse("--notify-command " + options.command.string() +
           " is not a program that this user may run. Give the absolute path of one.");
  if (!options.types.empty() && options.webhooks.empty() && options.command.empty())
    refuse("--notify chooses what --webhook and --notify-command are told. Give one of them, or leave it out.");
}

std::vector<std::unique_ptr<Receiver>> make_receivers(const Options& options, const std::string& epoch,
                                                      store::JournalReader& reader) {
  check(options);
  std::vector<std::unique_ptr<Receiver>> out;
  for (const auto& url : options.webhooks)
    out.push_back(std::make_unique<Webhook>(url, read_key(options.webhook_secret), options));
  if (!options.command.empty()) out.push_back(std::make_unique<Command>(options));
  if (!options.traces.empty()) out.push_back(std::make_unique<Collector>(options, epoch, reader));
  return out;
}

std::string host_of(const std::string& url) {
  const auto scheme = url.find("://");
  if (scheme == std::string::npos) return "";
  const auto begin = scheme + 3;
  return url.substr(begin, url.find_first_of("/?#", begin) - begin);
}

std::string key_of(const std::string& secret) {
  constexpr std::string_view kPrefix = "whsec_";
  std::string out;
  if (!secret.starts_with(kPrefix) || !absl::Base64Unescape(secret.substr(kPrefix.size()), &out)) return "";
  return out.size() < kLeastKey || out.size() > kLargestKey ? "" : out;
}

std::string signature_of(const std::string& key, const std::string& id, const std::string& timestamp,
                         const std::string& body) {
  const std::string text = id + "." + timestamp + "." + body;
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  HMAC(EVP_sha256(), key.data(), static_cast<int>(key.size()), reinterpret_cast<const unsigned char*>(text.data()),
       text.size(), digest.data(), &size);
  return "v1," + absl::Base64Escape({reinterpret_cast<const char*>(digest.data()), size});
}

Receiver::Result post(const std::string& url, const std::vector<std::string>& headers, const std::string& body,
                      std::chrono::milliseconds limit, const std::stop_token& stop, std::string& why) {
  // The arguments of a program are seen by others on the machine. The URL may hold a secret, and goes another way. A
  // redirection is not followed, since it may lead out of what the administrator has allowed.
  const std::vector<std::string> command = {"curl",
                                            "--disable",
                                            "--silent",
                                            "--show-error",
                                            "--globoff",
                                            "--proto",
                                            "=http,https",
                                            "--output",
                                            "/dev/null",
                                            "--write-out",
                                            "%{http_code}",
                                            "--max-time",
                                            std::to_string(std::max<std::int64_t>(1, limit.count() / 1000)),
                                            "--user-agent",
                                            "cellcrushd",
                                            "--data-binary",
                                            "@-",
                                            "--config",
                                            kMoreInput};
  std::string config = "url = \"" + url + "\"\nheader = \"Content-Type: application/json\"\nheader = \"Expect:\"\n";
  for (const auto& header : headers) config += "header = \"" + header + "\"\n";
  try {
    const auto end = run_program(command, limit + std::chrono::seconds(1), stop, body, config);
    if (!end.is_good()) {
      why = what_failed("curl", end);
      return Receiver::Result::failed;
    }
    const int code = std::atoi(end.output.c_str());
    if (code >= 200 && code < 300) return Receiver::Result::taken;
    why = "The receiver answered " + end.output + ".";
    constexpr std::array kLater = {408, 425, 429};
    const bool is_refused = code >= 400 && code < 500 && std::ranges::find(kLater, code) == kLater.end();
    return is_refused ? Receiver::Result::refused : Receiver::Result::failed;
  } catch (const std::exception& error) {
    why = error.what();
    return Receiver::Result::failed;
  }
}

}  // namespace cellcrush::notices
