#include "slurm/slurm_cluster.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>

#include "server/daemon_process.h"
#include "slurm/process_tree.h"

namespace cellcrush::testing {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;

constexpr seconds kStartLimit{60};
constexpr seconds kStopLimit{20};

const std::string kMunged = "/usr/sbin/munged";
const std::string kSlurmctld = "/usr/sbin/slurmctld";
const std::string kSlurmd = "/usr/sbin/slurmd";
const std::string kSlurmdbd = "/usr/sbin/slurmdbd";
const std::string kMariadbd = "/usr/sbin/mariadbd";
// The tables that MariaDB itself needs; slurmdbd creates its own.
const std::string kMariadbTables = "/usr/share/mysql/mysql_system_tables.sql";

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string node_name(int node) { return "n" + std::to_string(node); }

bool are_executable(const std::vector<std::string>& programs) {
  return std::all_of(programs.begin(), programs.end(),
                     [](const std::string& program) { return access(program.c_str(), X_OK) == 0; });
}

// Starts a daemon in the foreground, with its output in the file `log`.
KeptDaemon start_daemon(const std::filesystem::path& log, const std::vector<std::string>& command) {
  std::vector<std::string> words = {DAEMON_KEEPER_PROGRAM, log.string()};
  words.insert(words.end(), command.begin(), command.end());
  return std::make_unique<e2e::Process>(words);
}

// Kills the daemon with everything below it; returns when all are gone. Does nothing when it is null.
void stop_daemon(KeptDaemon& daemon) {
  if (!daemon) return;
  daemon->send(SIGTERM);
  (void)daemon->wait(std::chrono::seconds(20));
  daemon.reset();
}

}  // namespace

ReservedPort::ReservedPort() : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  const int yes = 1;
  setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  if (bind(socket_, generic, size) != 0 || getsockname(socket_, generic, &size) != 0) {
    close(socket_);
    throw std::runtime_error("no free port on 127.0.0.1");
  }
  number_ = ntohs(address.sin_port);
}

ReservedPort::~ReservedPort() { close(socket_); }

bool slurm_is_installed() { return are_executable({kMunged, kSlurmctld, kSlurmd, "/usr/bin/sbatch"}); }

bool slurm_accounting_is_installed() {
  return slurm_is_installed() && are_executable({kMariadbd, kSlurmdbd}) && fs::exists(kMariadbTables);
}

SlurmCluster::SlurmCluster(const SlurmOptions& options) : config_(folder_.path() / "slurm.conf") {
  // munge refuses a socket that others cannot reach.
  fs::permissions(folder_.path(), fs::perms::owner_all | fs::perms::group_exec | fs::perms::others_exec);
  for (const char* name : {"state", "spool_n1", "spool_n2", "log", "shared"}) {
    fs::create_directory(folder_.path() / name);
  }
  SlurmPorts ports;
  ports.nodes.resize(kNodes);
  ports.controller = reserve_port();
  for (int& port : ports.nodes) port = reserve_port();
  const fs::path munge_socket = folder_.path() / "munge/socket";
  if (options.accounting) ports.accounting = reserve_port();
  std::ofstream(config_) << slurm_conf_text(options, ports, folder_.path(), munge_socket);
  start_munge();
  if (options.accounting) start_accounting(ports.accounting, munge_socket);
  start_controller();
  nodes_.resize(kNodes);
  for (int node = 1; node <= kNodes; ++node) start_node(node);
  for (int node = 1; node <= kNodes; ++node) {
    if (!wait_until([&] { return node_state(node) == "idle"; }, kStartLimit))
      throw std::runtime_error(node_name(node) + " is " + node_state(node) + ", not idle:\n" + logs());
  }
}

SlurmCluster::~SlurmCluster() {
  for (KeptDaemon& node : nodes_) stop_daemon(node);
  for (KeptDaemon& node : lost_) stop_daemon(node);
  stop_daemon(controller_);
  stop_daemon(slurmdbd_);
  stop_daemon(database_);
  stop_daemon(munge_);
}

int SlurmCluster::reserve_port() {
  reserved_ports_.push_back(std::make_unique<ReservedPort>());
  return reserved_ports_.back()->number();
}

KeptDaemon SlurmCluster::start(const std::string& name, const std::vector<std::string>& command) const {
  return start_daemon(folder_.path() / "log" / (name + ".out"), command);
}

void SlurmCluster::start_munge() {
  const fs::path folder = folder_.path() / "munge";
  fs::create_directory(folder);
  fs::permissions(folder, fs::perms::owner_all | fs::perms::group_exec | fs::perms::others_exec);
  std::random_device random;
  std::string key(128, '\0');
  for (char& byte : key) byte = static_cast<char>(random());
  std::ofstream(folder / "key", std::ios::binary) << key;
  fs::permissions(folder / "key", fs::perms::owner_read | fs::perms::owner_write);
  const std::string prefix = folder.string() + "/";
  munge_ = start("munged", {kMunged, "--foreground", "--num-threads=2", "--key-file=" + prefix + "key",
                            "--socket=" + prefix + "socket", "--pid-file=" + prefix + "pid",
                            "--log-file=" + prefix + "log", "--seed-file=" + prefix + "seed"});
  if (!wait_until([&] { return fs::exists(folder / "socket"); }, kStartLimit))
    throw std::runtime_error("munged does not start:\n" + logs());
}

// slurmdbd on a port of loopback, and a MariaDB server without a port. The server asks for no password, as only the
// calling user can reach its socket. slurmdbd answers about 1 s after its start.
void SlurmCluster::start_accounting(int port, const fs::path& munge_socket) {
  const fs::path folder = folder_.path() / "database";
  const fs::path data = folder / "data";
  const fs::path socket = folder / "socket";
  fs::create_directories(data);
  fs::permissions(folder, fs::perms::owner_all);
  // The server runs these statements when it starts, line by line.
  std::ifstream tables(kMariadbTables);
  std::ofstream(folder / "start.sql") << "create database mysql;\nuse mysql;\n" << tables.rdbuf();
  const std::string prefix = folder.string() + "/";
  database_ = start(
      "mariadbd", {kMariadbd, "--no-defaults", "--user=" + user_name(), "--datadir=" + data.string(),
                   "--socket=" + socket.string(), "--pid-file=" + prefix + "pid", "--init-file=" + prefix + "start.sql",
                   "--skip-networking", "--skip-grant-tables", "--innodb-buffer-pool-size=64M",
                   "--innodb-log-file-size=8M", "--innodb-flush-log-at-trx-commit=0"});
  bool registered = wait_until([&] { return fs::exists(socket); }, kStartLimit);
  const fs::path configuration = folder_.path() / "slurmdbd.conf";
  std::ofstream(configuration) << slurmdbd_conf_text(port, folder_.path(), munge_socket);
  // slurmdbd refuses a file that others can read.
  fs::permissions(configuration, fs::perms::owner_read | fs::perms::owner_write);
  // It finds its file beside slurm.conf, and the client of MariaDB its socket in the environment.
  slurmdbd_ = start("slurmdbd", {"/usr/bin/env", "SLURM_CONF=" + config_.string(), "MYSQL_UNIX_PORT=" + socket.string(),
                                 kSlurmdbd, "-D"});
  const std::vector<std::string> clusters = {"sacctmgr", "-nP", "list", "cluster", "format=Cluster"};
  registered = registered && wait_for(clusters, "", kStartLimit);
  if (registered) {
    (void)run({"sacctmgr", "-i", "add", "cluster", "test"}, kStartLimit);
    registered = wait_for(clusters, "test", kStartLimit);
  }
  if (!registered) throw std::runtime_error("the accounting does not start:\n" + logs());
}

e2e::Outcome SlurmCluster::run(const std::vector<std::string>& command, std::chrono::milliseconds limit) const {
  std::vector<std::string> words = {"/usr/bin/env", "SLURM_CONF=" + config_.string()};
  words.insert(words.end(), command.begin(), command.end());
  return e2e::run(words, limit);
}

bool SlurmCluster::wait_for(const std::vector<std::string>& command, const std::string& output,
                            std::chrono::milliseconds limit) const {
  return wait_until(
      [&] {
        const e2e::Outcome outcome = run(command);
        const auto end = outcome.output.find_last_not_of(" \n");
        return outcome.exit_code == 0 && outcome.output.substr(0, end + 1) == output;
      },
      limit);
}

std::vector<int> SlurmCluster::wait_for_exit_codes(const std::string& job, std::chrono::milliseconds limit) const {
  std::vector<int> codes;
  if (!wait_for({"squeue", "-h", "-j", job}, "", limit)) return codes;
  const std::string tasks = run({"scontrol", "show", "job", "-o", job}).output;
  const std::string key = " ExitCode=";
  for (auto at = tasks.find(key); at != std::string::npos; at = tasks.find(key, at + 1))
    codes.push_back(std::stoi(tasks.substr(at + key.size())));
  std::sort(codes.begin(), codes.end());
  return codes;
}

std::string SlurmCluster::node_state(int node) const {
  const e2e::Outcome outcome = run({"sinfo", "-h", "-p", "main", "-n", node_name(node), "-o", "%T"});
  return outcome.output.substr(0, outcome.output.find('\n'));
}

void SlurmCluster::kill_node(int node, JobProcesses processes) {
  KeptDaemon& keeper = nodes_.at(node - 1);
  if (processes == JobProcesses::die) {
    stop_daemon(keeper);
    return;
  }
  for (const pid_t process : descendants_of(keeper->id())) {
    const std::string program = program_of(process);
    if (program == "slurmd" || program == "slurmstepd") kill(process, SIGKILL);
  }
  lost_.push_back(std::move(keeper));
}

void SlurmCluster::start_node(int node) {
  const std::string name = node_name(node);
  nodes_.at(node - 1) = start("slurmd_" + name, {kSlurmd, "-D", "-f", config_.string(), "-N", name});
}

void SlurmCluster::stop_controller() {
  for (const pid_t process : children_of(controller_->id())) kill(process, SIGTERM);
  (void)controller_->wait(kStopLimit);
  controller_.reset();
}

void SlurmCluster::start_controller() {
  controller_ = start("slurmctld", {kSlurmctld, "-D", "-f", config_.string()});
  if (!wait_until([&] { return run({"scontrol", "ping"}).exit_code == 0; }, kStartLimit))
    throw std::runtime_error("slurmctld does not answer:\n" + logs());
}

std::string SlurmCluster::logs() const {
  std::string text;
  for (const auto& entry : fs::directory_iterator(folder_.path() / "log"))
    text += "== " + entry.path().filename().string() + "\n" + bytes_of(entry.path());
  return text;
}

}  // namespace cellcrush::testing
