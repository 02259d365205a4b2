#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>

namespace cellcrush::client {

/// Files that define how to reach a server and who calls, as the options name them. An empty path means that the option
/// was not given.
struct CredentialFiles {
  std::string authority;    ///< --tls-ca, else $CELLCRUSH_TLS_CA
  std::string certificate;  ///< --tls-cert
  std::string key;          ///< --tls-key
  std::string token;        ///< --token-file, else $CELLCRUSH_TOKEN_FILE; else $CELLCRUSH_TOKEN is the token itself
};

/// Credentials for a server.
struct Credentials {
  bool tls = false;
  std::string authority;    ///< PEM
  std::string certificate;  ///< PEM; empty: none
  std::string key;          ///< PEM
  std::string token;        ///< empty: none
};

/// Reads the files named by options and environment, for an address of find_server_address. A Unix socket uses none of
/// them. Throws CommandError (refused): a file is unreadable or invalid, --tls-cert is given without --tls-key or an
/// authority, or a token would be sent in plain text to another host.
Credentials read_credentials(const CredentialFiles& files, const std::string& address);

/// "unix:PATH" or "HOST:PORT".
struct ServerAddress {
  std::string text;
  bool may_be_others = false;  ///< the default port, which any user may hold
};

/// The server to use: `option` if not empty, else $CELLCRUSH_SERVER, else the socket of this user's daemon
/// ($XDG_DATA_HOME/cellcrush/cellcrushd.sock or ~/.local/share/cellcrush/cellcrushd.sock) if it exists, else
/// 127.0.0.1:50551. Throws CommandError (refused) for another form.
ServerAddress find_server_address(const std::string& option);

/// Name of the Unix user that runs this program, as a server on this machine has it.
std::string own_user();

}  // namespace cellcrush::client
