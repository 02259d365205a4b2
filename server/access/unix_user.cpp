#include "access/unix_user.h"

#include <grp.h>
#include <linux/inet_diag.h>
#include <linux/netlink.h>
#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <pwd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <climits>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "access/token_file.h"

namespace cellcrush::access {
namespace {

constexpr std::size_t kMostBytes = 1 << 16;  // of an entry of the user database

// Whether the kernel shows other users as this one, since this user namespace lacks them.
bool is_ambiguous(uid_t user) {
  constexpr uid_t kUnmapped = 65534;
  static const bool kKnowsAll = [] {
    std::uint32_t first = 1;
    std::uint32_t count = 0;
    std::ifstream("/proc/self/uid_map") >> first >> first >> count;
    return first == 0 && count == UINT32_MAX;
  }();
  return user == kUnmapped && !kKnowsAll;
}

// An entry of the user database with the bytes it points to.
template <class Entry>
struct Found {
  std::vector<char> bytes = std::vector<char>(kMostBytes);
  Entry entry{};
  Entry* result = nullptr;
};

struct Ends {
  sockaddr_storage own{};
  sockaddr_storage peer{};
};

std::optional<Ends> ends_of(int connection) {
  Ends out;
  socklen_t own = sizeof(out.own);
  socklen_t peer = sizeof(out.peer);
  if (getsockname(connection, reinterpret_cast<sockaddr*>(&out.own), &own) != 0 ||
      getpeername(connection, reinterpret_cast<sockaddr*>(&out.peer), &peer) != 0)
    return std::nullopt;
  return out;
}

bool is_loopback(const sockaddr_storage& address) {
  if (address.ss_family == AF_INET)
    return (ntohl(reinterpret_cast<const sockaddr_in&>(address).sin_addr.s_addr) >> 24U) == 127U;
  return address.ss_family == AF_INET6 &&
         IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<const sockaddr_in6&>(address).sin6_addr);
}

void put_end(const sockaddr_storage& end, __be32 (&address)[4], __be16& port) {
  if (end.ss_family == AF_INET) {
    const auto& name = reinterpret_cast<const sockaddr_in&>(end);
    std::memcpy(address, &name.sin_addr, sizeof(name.sin_addr));
    port = name.sin_port;
  } else {
    const auto& name = reinterpret_cast<const sockaddr_in6&>(end);
    std::memcpy(address, &name.sin6_addr, sizeof(name.sin6_addr));
    port = name.sin6_port;
  }
}

// Who has opened the socket at the peer's end. A socket that its process has closed is shown as root's, without inode.
std::optional<uid_t> ask_kernel(const Ends& ends) {
  struct {
    nlmsghdr header{};
    inet_diag_req_v2 question{};
  } request;
  request.header.nlmsg_len = sizeof(request);
  request.header.nlmsg_type = SOCK_DIAG_BY_FAMILY;
  request.header.nlmsg_flags = NLM_F_REQUEST;
  request.question.sdiag_family = static_cast<__u8>(ends.peer.ss_family);
  request.question.sdiag_protocol = IPPROTO_TCP;
  request.question.idiag_states = 1U << TCP_ESTABLISHED;
  auto& names = request.question.id;
  put_end(ends.peer, names.idiag_src, names.idiag_sport);
  put_end(ends.own, names.idiag_dst, names.idiag_dport);
  names.idiag_cookie[0] = names.idiag_cookie[1] = INET_DIAG_NOCOOKIE;
  const int kernel = socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_SOCK_DIAG);
  if (kernel < 0) return std::nullopt;
  alignas(nlmsghdr) std::array<char, 4096> answer{};
  const bool sent = send(kernel, &request, sizeof(request), 0) == static_cast<ssize_t>(sizeof(request));
  const ssize_t size = sent ? recv(kernel, answer.data(), answer.size(), MSG_DONTWAIT) : -1;
  close(kernel);
  nlmsghdr header{};
  inet_diag_msg found{};
  if (size < static_cast<ssize_t>(NLMSG_LENGTH(sizeof(found)))) return std::nullopt;
  std::memcpy(&header, answer.data(), sizeof(header));
  std::memcpy(&found, answer.data() + NLMSG_HDRLEN, sizeof(found));
  const bool is_open = header.nlmsg_type == SOCK_DIAG_BY_FAMILY && found.idiag_state == TCP_ESTABLISHED &&
                       found.id.idiag_sport == names.idiag_sport && found.idiag_inode != 0;
  return is_open ? std::optional<uid_t>(found.idiag_uid) : std::nullopt;
}

// Asked last: as long as this end is open, no other connection has its addresses.
bool is_established(int connection) {
  tcp_info state{};
  socklen_t size = sizeof(state);
  return getsockopt(connection, IPPROTO_TCP, TCP_INFO, &state, &size) == 0 && state.tcpi_state == TCP_ESTABLISHED;
}

std::optional<uid_t> ask_socket(int connection) {
  ucred peer{};
  socklen_t size = sizeof(peer);
  if (getsockopt(connection, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return std::nullopt;
  return peer.uid;
}

}  // namespace

std::string name_of_user(uid_t user) {
  Found<passwd> found;
  getpwuid_r(user, &found.entry, found.bytes.data(), found.bytes.size(), &found.result);
  return found.result != nullptr && is_caller_name(found.entry.pw_name) ? found.entry.pw_name
                                                                        : "uid" + std::to_string(user);
}

const std::string& own_user() {
  static const std::string kName = name_of_user(geteuid());
  return kName;
}

std::optional<uid_t> user_of_peer(int connection) {
  const auto ends = ends_of(connection);
  if (!ends) return std::nullopt;
  if (ends->own.ss_family == AF_UNIX) {
    const auto user = ask_socket(connection);
    return user && !is_ambiguous(*user) ? user : std::nullopt;
  }
  if (!is_loopback(ends->own) || !is_loopback(ends->peer)) return std::nullopt;
  auto user = ask_kernel(*ends);
  // A kernel may lack tcp_diag. A peer that has closed its socket costs no reading of the tables.
  if (!user && is_established(connection)) user = user_in_socket_tables(ends->own, ends->peer);
  return user && is_established(connection) && !is_ambiguous(*user) ? user : std::nullopt;
}

std::vector<gid_t> groups_of_user(uid_t user) {
  Found<passwd> found;
  getpwuid_r(user, &found.entry, found.bytes.data(), found.bytes.size(), &found.result);
  if (found.result == nullptr) return {};
  int count = NGROUPS_MAX;
  std::vector<gid_t> out(static_cast<std::size_t>(count));
  if (getgrouplist(found.entry.pw_name, found.entry.pw_gid, out.data(), &count) < 0) return {};
  out.resize(static_cast<std::size_t>(count));
  return out;
}

std::optional<gid_t> find_group(const std::string& name) {
  Found<group> found;
  getgrnam_r(name.c_str(), &found.entry, found.bytes.data(), found.bytes.size(), &found.result);
  return found.result == nullptr ? std::nullopt : std::optional(found.entry.gr_gid);
}

}  // namespace cellcrush::access
