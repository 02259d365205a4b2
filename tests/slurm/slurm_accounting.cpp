#include "slurm/slurm_accounting.h"

#include <fstream>

#include "server/daemon_process.h"
#include "slurm/slurm_conf.h"

namespace cellcrush::testing {

namespace fs = std::filesystem;

SlurmAccounting::SlurmAccounting(fs::path folder, fs::path munge_socket)
    : folder_(std::move(folder)), munge_socket_(std::move(munge_socket)) {}

SlurmAccounting::~SlurmAccounting() {
  stop_daemon(slurmdbd_);
  stop_daemon(database_);
}

bool SlurmAccounting::start(std::chrono::milliseconds limit) {
  const fs::path socket = start_database();
  if (!wait_until([&] { return fs::exists(socket); }, limit)) return false;
  const fs::path configuration = folder_ / "slurmdbd.conf";
  std::ofstream(configuration) << slurmdbd_conf_text(port(), folder_, munge_socket_);
  // slurmdbd refuses a file that others can read.
  fs::permissions(configuration, fs::perms::owner_read | fs::perms::owner_write);
  // It finds its file beside slurm.conf, and the client of MariaDB its socket in the environment.
  slurmdbd_ =
      start_daemon(folder_ / "log/slurmdbd.out", {"/usr/bin/env", "SLURM_CONF=" + (folder_ / "slurm.conf").string(),
                                                  "MYSQL_UNIX_PORT=" + socket.string(), kSlurmdbd, "-D"});
  return true;
}

fs::path SlurmAccounting::start_database() {
  const fs::path folder = folder_ / "database";
  fs::create_directory(folder);
  fs::permissions(folder, fs::perms::owner_all);
  const fs::path data = folder / "data";
  fs::create_directory(data);
  // The server runs these statements when it starts, line by line.
  std::ifstream tables(kMariadbTables);
  std::ofstream(folder / "start.sql") << "create database mysql;\nuse mysql;\n" << tables.rdbuf();
  fs::path socket = folder / "socket";
  const std::string prefix = folder.string() + "/";
  database_ = start_daemon(
      folder_ / "log/mariadbd.out",
      {kMariadbd, "--no-defaults", "--user=" + user_name(), "--datadir=" + data.string(), "--socket=" + socket.string(),
       "--pid-file=" + prefix + "pid", "--init-file=" + prefix + "start.sql", "--skip-networking",
       "--skip-grant-tables", "--innodb-buffer-pool-size=64M", "--innodb-log-file-size=8M",
       "--innodb-flush-log-at-trx-commit=0"});
  return socket;
}

}  // namespace cellcrush::testing
