#include "http/loopback_channel.h"

#include <fcntl.h>
#include <grpcpp/create_channel_posix.h>
#include <grpcpp/server_posix.h>
#include <sys/socket.h>

#include <array>

#include "error.h"

namespace cellcrush::http {

std::shared_ptr<grpc::Channel> connect_to(grpc::Server& server) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends.data()) != 0) {
    throw ServiceError(ServiceError::Kind::exhausted,
                       "The daemon has no file descriptors left for this call. Try again later.");
  }
  grpc::AddInsecureChannelFromFd(&server, ends[0]);
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);
  return grpc::CreateCustomInsecureChannelFromFd("cellcrushd", ends[1], arguments);
}

}  // namespace cellcrush::http
