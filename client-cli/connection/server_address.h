#pragma once

#include <string>

namespace cellcrush::client {

/// The server to use: `option` if not empty, else $CELLCRUSH_SERVER, else the daemon's default socket
/// ($XDG_DATA_HOME/cellcrush/cellcrushd.sock or ~/.local/share/cellcrush/cellcrushd.sock) if it exists, else
/// 127.0.0.1:50551. Returns "unix:PATH" or "HOST:PORT"; throws CommandError (refused) for another form.
std::string find_server_address(const std::string& option);

}  // namespace cellcrush::client
