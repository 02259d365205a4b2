#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>

namespace cellcrush::client {

/// Files that say how to reach a server and who calls, as the options name them; empty ones are not given.
struct CredentialFiles {
  std::string authority;    ///< --tls-ca, else $CELLCRUSH_TLS_CA
  std::string certificate;  ///< --tls-cert
  std::string key;          ///< --tls-key
  std::string token;        ///< --token-file, else $CELLCRUSH_TOKEN_FILE; else $CELLCRUSH_TOKEN is the token itself
};

/// How to talk to a server.
struct Credentials {
  bool tls = false;
  std::string authority;    ///< PEM
  std::string certificate;  ///< PEM; empty: none
  std::string key;          ///< PEM
  std::string token;        ///< empty: none
};

/// Reads what the options and the environment name, for a server address of find_server_address. A Unix socket takes
/// none of it. Throws CommandError (refused): a file cannot be read or is not what it should be, --tls-cert without
/// --tls-key or without an authority, or a token that would go in plain text to another host.
Credentials read_credentials(const CredentialFiles& files, const std::string& address);

/// A channel that talks so; the token goes with every call.
std::shared_ptr<grpc::Channel> open_channel(const std::string& address, const Credentials& credentials,
                                            const grpc::ChannelArguments& arguments);

}  // namespace cellcrush::client
