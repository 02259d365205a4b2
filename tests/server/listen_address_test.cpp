#include "listen_address.h"

#include <gtest/gtest.h>

#include <fstream>

#include "error.h"
#include "server/temporary_folder.h"

namespace cellcrush {
namespace {

TEST(ListenAddress, TakesSocketsAndLoopbackPorts) {
  EXPECT_EQ(parse_listen_address("unix:/tmp/a.sock").text(), "unix:/tmp/a.sock");
  EXPECT_EQ(parse_listen_address("127.0.0.1:50551").text(), "127.0.0.1:50551");
  EXPECT_EQ(parse_listen_address("localhost:0").port, 0);
  EXPECT_EQ(parse_listen_address("[::1]:7").text(), "[::1]:7");
}

TEST(ListenAddress, RefusesWhatOthersCouldReachAndWhatIsNoAddress) {
  for (const char* text : {"0.0.0.0:50551", "192.168.1.4:50551", "[::]:50551", "example.org:1", ":50551", "127.0.0.1",
                           "127.0.0.1:", "127.0.0.1:70000", "127.0.0.1:-1", "127.0.0.1:12x", "unix:", ""})
    EXPECT_THROW(parse_listen_address(text), ServiceError) << text;
  EXPECT_THROW(parse_listen_address("unix:/tmp/" + std::string(120, 'x')), ServiceError);
}

TEST(ListenAddress, AFileThatIsNoSocketIsLeftAlone) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "file";
  std::ofstream(path) << "precious";
  EXPECT_THROW(remove_stale_socket(path.string()), ServiceError);
  EXPECT_TRUE(std::filesystem::exists(path));
  EXPECT_NO_THROW(remove_stale_socket((folder.path() / "absent").string()));
}

}  // namespace
}  // namespace cellcrush
