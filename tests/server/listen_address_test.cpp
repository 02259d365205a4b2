#include "listen_address.h"

#include <gtest/gtest.h>

#include <fstream>

#include "error.h"
#include "net/listening_port.h"
#include "server/temporary_folder.h"

namespace cellcrush {
namespace {

TEST(ListenAddress, TakesSocketsAndLoopbackPorts) {
  EXPECT_EQ(parse_listen_address("unix:/tmp/a.sock").text(), "unix:/tmp/a.sock");
  EXPECT_EQ(parse_listen_address("127.0.0.1:50551").text(), "127.0.0.1:50551");
  EXPECT_EQ(parse_listen_address("localhost:0").port, 0);
  EXPECT_EQ(parse_listen_address("[::1]:7").text(), "[::1]:7");
  for (const char* text : {"unix:/tmp/a.sock", "127.0.0.1:1", "127.3.2.1:1", "localhost:1", "[::1]:1", "[0:0::1]:1"})
    EXPECT_TRUE(parse_listen_address(text).is_loopback()) << text;
}

TEST(ListenAddress, KnowsWhatOthersCanReach) {
  for (const char* text :
       {"0.0.0.0:1", "192.168.1.4:1", "[::]:1", "[::ffff:127.0.0.1]:1", "[2001:db8::1]:1", "128.0.0.1:1"})
    EXPECT_FALSE(parse_listen_address(text).is_loopback()) << text;
}

TEST(ListenAddress, RefusesWhatIsNoAddress) {
  for (const char* text : {"example.org:1", "unix-abstract:a:1", "::1:1", "[127.0.0.1]:1", "0x7f.1:1", ":50551",
                           "127.0.0.1", "127.0.0.1:", "127.0.0.1:70000", "127.0.0.1:-1", "127.0.0.1:12x", "unix:", ""})
    EXPECT_THROW(parse_listen_address(text), ServiceError) << text;
  EXPECT_THROW(parse_listen_address("unix:/tmp/" + std::string(120, 'x')), ServiceError);
}

TEST(ListenAddress, AFileThatIsNoSocketIsLeftAlone) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "file";
  std::ofstream(path) << "precious";
  EXPECT_THROW(net::remove_stale_socket(path.string()), ServiceError);
  EXPECT_TRUE(std::filesystem::exists(path));
  EXPECT_NO_THROW(net::remove_stale_socket((folder.path() / "absent").string()));
}

}  // namespace
}  // namespace cellcrush
