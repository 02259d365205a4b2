#include "store/lattice_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <optional>
#include <string>

#include "error.h"
#include "store/case_hash.h"
#include "store/durable_file.h"
#include "store/large_lattice.h"

namespace cellcrush::store {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestLattice = std::size_t{64} << 20;

// Nothing if there is no such file that can be read.
std::optional<std::string> read_lattice(const fs::path& path) {
  const OpenFile file = try_open_own(path, O_RDONLY);
  struct stat status {};
  if (!file || fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > kLargestLattice) return std::nullopt;
  std::string bytes(size, '\0');
  bytes.resize(read_at(file, path, bytes.data(), size, 0));
  return bytes;
}

void write_lattice(const JobFolder& folder, const std::string& bytes) {
  OpenFile file = open_own(folder.lattice(), O_WRONLY | O_CREAT | O_EXCL);
  write_all(file, folder.lattice(), bytes);
  if (fsync(file.get()) != 0 || !file.close()) throw_file_error(folder.lattice(), "written", errno);
}

// 0 or the errno.
int link_file(const fs::path& from, const fs::path& to) {
  const OpenFile source = try_open_own(from.parent_path(), O_RDONLY | O_DIRECTORY);
  if (!source) return errno;
  const OpenFile target = try_open_own(to.parent_path(), O_RDONLY | O_DIRECTORY);
  if (!target) return errno;
  return linkat(source.get(), from.filename().c_str(), target.get(), to.filename().c_str(), 0) == 0 ? 0 : errno;
}

// Gives the folder its lattice: that of another one, which is read first, or else a new file that others may link to.
void share_lattice(const JobFolder& folder, const std::string& name, const std::string& bytes) {
  const fs::path shared = folder.lattices() / name;
  const auto is_shared = [&] { return read_lattice(shared) == bytes && link_file(shared, folder.lattice()) == 0; };
  if (is_shared()) return;
  write_lattice(folder, bytes);
  if (const int error = make_own_folder(folder.lattices()); error != 0 && error != EEXIST) return;
  if (link_file(folder.lattice(), shared) == 0) return;
  // Another folder was first; or its file is damaged or has no links left, and folders that have it keep it.
  if (read_lattice(shared) == bytes) {
    static_cast<void>(remove_own(folder.lattice()));
    if (is_shared()) return;
    write_lattice(folder, bytes);
  }
  static_cast<void>(remove_own(shared));
  static_cast<void>(link_file(folder.lattice(), shared));
}

}  // namespace

worker::Order put_lattice_apart(const JobFolder& folder, worker::Order order) {
  if (!order.lattice().empty()) return order;
  if (const int error = remove_own(folder.lattice()); error != 0) throw_file_error(folder.lattice(), "removed", error);
  const auto bytes = take_lattice_out(*order.mutable_case_());
  if (!bytes) return order;
  order.set_lattice(sha256_of(*bytes));
  share_lattice(folder, order.lattice(), *bytes);
  return order;
}

void read_lattice_of(const JobFolder& folder, worker::Order& order) {
  if (order.lattice().empty()) return;
  const auto bytes = read_lattice(folder.lattice());
  if (!bytes || sha256_of(*bytes) != order.lattice() || !put_lattice_back(*bytes, *order.mutable_case_())) {
    throw ServiceError(ServiceError::Kind::data_loss, "The file lattice in the folder of " + order.job() + " is " +
                                                          (bytes ? "damaged." : "missing.") +
                                                          " Check the disk for faults.");
  }
}

void remove_unused_lattices(const fs::path& lattices) {
  if (!find_own(lattices)) return;
  try {
    for (const auto& name : names_in(lattices)) {
      const auto status = find_own(lattices / name);
      if (status && S_ISREG(status->st_mode) && status->st_nlink == 1) static_cast<void>(remove_own(lattices / name));
    }
  } catch (const ServiceError&) {
    // They are looked at again.
  }
}

}  // namespace cellcrush::store
