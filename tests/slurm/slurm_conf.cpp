#include "slurm/slurm_conf.h"

#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <array>

namespace cellcrush::testing {
namespace {

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

// Slurm binds to the addresses of this file, so to loopback. Its own files of accounting, processes and tasks need no
// database, no cgroups and no rights of root. The life of a credential is also the delay of a requeued job; Slurm takes
// no less than 5 s. Times are short, so that tests are quick: a silent node goes down after about 10 s in all.
constexpr const char* kCommon = R"(ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={munge_socket},cred_expire=5
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool_%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd_%n.pid
SlurmctldLogFile={folder}/log/slurmctld.log
SlurmdLogFile={folder}/log/slurmd_%n.log
MailProg=/bin/true
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
JobCompType=jobcomp/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0
SlurmdParameters=config_overrides
ReturnToService=2
MaxArraySize=10001
MinJobAge=300
KillWait={kill_wait_s}
SlurmctldTimeout=10
SlurmdTimeout=3
MessageTimeout=2
)";

// Messages to slurmdbd do not heed AuthInfo; the "password" is where their munge is.
constexpr const char* kSlurmdbdStorage = R"(AccountingStorageType=accounting_storage/slurmdbd
AccountingStorageHost=127.0.0.1
AccountingStoragePort={}
AccountingStoragePass=socket={}
)";

constexpr const char* kSlurmdbdConf = R"(DbdHost={host}
DbdAddr=127.0.0.1
DbdPort={port}
CommunicationParameters=NoInAddrAny
SlurmUser={user}
AuthType=auth/munge
AuthInfo=socket={munge_socket}
PidFile={folder}/slurmdbd.pid
LogFile={folder}/log/slurmdbd.log
StorageType=accounting_storage/mysql
StorageHost=localhost
StorageUser={user}
StorageLoc=accounting
)";

}  // namespace

std::string user_name() {
  const passwd* user = getpwuid(geteuid());
  return user != nullptr ? user->pw_name : std::to_string(geteuid());
}

std::string slurm_conf_text(const SlurmOptions& options, const SlurmPorts& ports, const std::filesystem::path& folder,
                            const std::filesystem::path& munge_socket) {
  using fmt::arg;
  const std::string host = host_name();
  std::string text = fmt::format(kCommon, arg("host", host), arg("controller_port", ports.controller),
                                 arg("user", user_name()), arg("munge_socket", munge_socket.string()),
                                 arg("folder", folder.string()), arg("kill_wait_s", options.kill_wait_s));
  text += ports.accounting == 0 ? "AccountingStorageType=accounting_storage/none\n"
                                : fmt::format(kSlurmdbdStorage, ports.accounting, munge_socket.string());
  for (std::size_t i = 0; i < ports.nodes.size(); ++i) {
    text += fmt::format("NodeName=n{} NodeHostname={} NodeAddr=127.0.0.1 Port={} CPUs=1 RealMemory=8000\n", i + 1, host,
                        ports.nodes[i]);
  }
  text += "PartitionName=main Nodes=ALL Default=YES PriorityTier=2 PreemptMode=OFF MaxTime=INFINITE\n";
  if (!options.preempt_mode.empty()) {
    text += fmt::format("PreemptType=preempt/partition_prio\nPreemptMode={}\n", options.preempt_mode);
    text += "PartitionName=low Nodes=ALL PriorityTier=1 GraceTime=0 MaxTime=INFINITE\n";
  }
  return text;
}

std::string slurmdbd_conf_text(int port, const std::filesystem::path& folder,
                               const std::filesystem::path& munge_socket) {
  using fmt::arg;
  return fmt::format(kSlurmdbdConf, arg("host", host_name()), arg("port", port), arg("user", user_name()),
                     arg("munge_socket", munge_socket.string()), arg("folder", folder.string()));
}

}  // namespace cellcrush::testing
