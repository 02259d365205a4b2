#include "store/backup_manifest.h"

#include <absl/strings/escaping.h>
#include <fcntl.h>
#include <google/protobuf/util/time_util.h>
#include <openssl/evp.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <set>
#include <sstream>
#include <string_view>

#include "error.h"
#include "store/durable_file.h"
#include "store/resource_name.h"

namespace cellcrush::store {
namespace {

constexpr std::string_view kManifestTitle = "CELLCRUSH BACKUP 1";
constexpr std::size_t kCopiedAtOnce = 1 << 20;
constexpr std::size_t kLargestManifest = std::size_t{256} << 20;  // that of two million jobs

// SHA-256 of bytes that arrive in parts.
class Digest {
 public:
  Digest() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) { EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr); }
  void add(const char* bytes, std::size_t size) { EVP_DigestUpdate(context_.get(), bytes, size); }
  std::string hexadecimal() {
    std::string digest(EVP_MAX_MD_SIZE, '\0');
    unsigned size = 0;
    EVP_DigestFinal_ex(context_.get(), reinterpret_cast<unsigned char*>(digest.data()), &size);
    return absl::BytesToHexString(digest.substr(0, size));
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

std::string digest_of_text(std::string_view text) {
  Digest digest;
  digest.add(text.data(), text.size());
  return digest.hexadecimal();
}

// A restore creates files with these names, so only the journal, results and histories are allowed.
bool is_name_of_backup(const std::filesystem::path& path) {
  if (path == "journal.sqlite") return true;
  return (path.filename() == "result.h5" || path.filename() == "history") && number_of(path.parent_path().string());
}

ServiceError damaged_manifest() {
  return {
      ServiceError::Kind::data_loss,
      std::string(kManifestName) + " is damaged: it differs from what `cellcrushd backup` wrote. Use another backup."};
}

}  // namespace

std::string text_of(const BackupManifest& manifest) {
  std::string out = std::string(kManifestTitle) + "\ncreated " + manifest.created + "\n";
  for (const auto& file : manifest.files)
    out += "file " + std::to_string(file.size) + " " + file.sha256 + " " + file.path + "\n";
  for (const auto& sentence : manifest.lost) out += "lost " + sentence + "\n";
  return out + "end " + digest_of_text(out) + "\n";
}

BackupManifest read_manifest(const std::filesystem::path& backup) {
  const std::string text = InputFile(backup / kManifestName).read(0, kLargestManifest);
  const auto end = text.rfind("end ");
  if (end == std::string::npos || text.substr(end) != "end " + digest_of_text(text.substr(0, end)) + "\n")
    throw damaged_manifest();
  std::istringstream lines(text.substr(0, end));
  std::string line;
  if (!std::getline(lines, line) || line != kManifestTitle) throw damaged_manifest();
  BackupManifest out;
  std::set<std::string> named;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string kind;
    words >> kind >> std::ws;
    if (kind == "created") {
      words >> out.created;
    } else if (kind == "lost") {
      std::getline(words, out.lost.emplace_back());
      if (!named.insert("lost " + out.lost.back()).second) throw damaged_manifest();
    } else {
      BackupFile file;
      if (kind != "file" || !(words >> file.size >> file.sha256 >> file.path) || !is_name_of_backup(file.path) ||
          !named.insert(file.path).second)
        throw damaged_manifest();
      out.files.push_back(std::move(file));
    }
  }
  return out;
}

BackupFile digest_of(const std::filesystem::path& file, const std::filesystem::path& copy, std::uint64_t most,
                     LastLink link) {
  const OpenFile from = open_to_read(file, ServiceError::Kind::internal, link);
  const OpenFile to = copy.empty() ? OpenFile() : open_own(copy, O_WRONLY | O_CREAT | O_EXCL);
  BackupFile out;
  Digest digest;
  std::string part(kCopiedAtOnce, '\0');
  while (const std::size_t size = out.size > most ? 0 : read_at(from, file, part.data(), part.size(), out.size)) {
    digest.add(part.data(), size);
    out.size += size;
    if (to) write_all(to, copy, {part.data(), size});
  }
  out.sha256 = digest.hexadecimal();
  return out;
}

std::string time_text_now() {
  auto now = google::protobuf::util::TimeUtil::GetCurrentTime();
  now.set_nanos(0);
  return google::protobuf::util::TimeUtil::ToString(now);
}

}  // namespace cellcrush::store
