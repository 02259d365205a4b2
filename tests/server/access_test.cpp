#include <gmock/gmock.h>
#include <sys/stat.h>

#include "access/call_backlog.h"
#include "access/tls_files.h"
#include "access/token_file.h"
#include "error.h"
#include "programs/certificates.h"
#include "programs/temporary_folder.h"

namespace cellcrush::access {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using testing::write_secret;

template <class Action>
std::string access_refusal_of(const Action& action) {
  try {
    action();
  } catch (const ServiceError& refused) {
    return refused.what();
  }
  return "";
}

// Two connections, by their keys.
class CallBacklogTest : public ::testing::Test {
 protected:
  // How many of 100 calls are admitted and queued.
  int flood(CallBacklog::Key connection) {
    int out = 0;
    for (int i = 0; i < 100; ++i) {
      if (!backlog_.admit(connection)) continue;
      backlog_.queue();
      ++out;
    }
    return out;
  }

  CallBacklog backlog_{40};
  const CallBacklog::Key one_ = &backlog_;
  const CallBacklog::Key two_ = this;
};

TEST_F(CallBacklogTest, AConnectionHasAsManyCallsAsAreLeftAndAnotherOneStillFindsPlaces) {
  EXPECT_EQ(flood(one_), 20);
  EXPECT_EQ(flood(two_), 10);
  for (int i = 0; i < 20; ++i) backlog_.begin(one_, "one");
  EXPECT_EQ(flood(one_), 0) << "open calls count until they end";
  for (int i = 0; i < 20; ++i) backlog_.end(one_);
  EXPECT_GT(flood(one_), 0);
}

TEST_F(CallBacklogTest, CallsThatNeverBeganAreForgottenOnceNoneIsQueued) {
  for (int i = 0; i < 15; ++i) ASSERT_TRUE(backlog_.admit(one_));
  ASSERT_TRUE(backlog_.admit(two_));
  backlog_.queue();
  backlog_.begin(two_, "two");
  EXPECT_EQ(flood(one_), 20) << "one call is open, none comes";
}

TEST_F(CallBacklogTest, AConnectionThatGoesOnInSpiteOfRefusalsIsNamed) {
  std::vector<std::string> named;
  backlog_.on_flood([&named](const std::string& name) { named.push_back(name); });
  EXPECT_EQ(flood(one_), 20);
  backlog_.begin(one_, "ipv4:192.0.2.7:1");
  backlog_.look();
  for (int i = 0; i < 99; ++i) backlog_.refuse(one_);
  EXPECT_TRUE(named.empty());
  EXPECT_EQ(flood(one_), 0);
  EXPECT_EQ(named, std::vector<std::string>{"ipv4:192.0.2.7:1"}) << "once";
  EXPECT_EQ(flood(two_), 10);
}

TEST_F(CallBacklogTest, AConnectionHasOneCallHoweverManyOthersHave) {
  std::vector<int> keys(10);
  for (const int& key : keys) EXPECT_GE(flood(&key), 1);
  EXPECT_EQ(flood(two_), 1);
}

class TokenFileTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string refusal(const std::string& text) const {
    write_secret(path(), text);
    return access_refusal_of([this] { const TokenFile tokens(path()); });
  }
  [[nodiscard]] std::filesystem::path path() const { return folder_.path() / "tokens"; }

  testing::TemporaryFolder folder_;
};

TEST_F(TokenFileTest, AWrongLineIsNamedByItsNumberAndNotRepeated) {
  const std::string line = make_token("anna", Scope::submit).line;
  const std::string hash = line.substr(line.rfind(' ') + 1);
  EXPECT_THAT(refusal("anna submit"), AllOf(StartsWith("--tokens " + path().string()), HasSubstr("line 1")));
  EXPECT_THAT(refusal("\nanna submit secret"), AllOf(HasSubstr("line 2"), ::testing::Not(HasSubstr("secret"))));
  EXPECT_THAT(refusal(line + " more"), HasSubstr("NAME SCOPE SHA256-HEX"));
  EXPECT_THAT(refusal("anna all " + hash), HasSubstr("read, submit or admin"));
  EXPECT_THAT(refusal("local admin " + hash), HasSubstr("name"));
  EXPECT_THAT(refusal("an\"na admin " + hash), HasSubstr("name"));
  EXPECT_THAT(refusal("anna admin " + hash.substr(1) + "g"), HasSubstr("hexadecimal"));
  EXPECT_THAT(refusal(line + "\nbob read " + hash), HasSubstr("line 2"));
  EXPECT_THAT(refusal(line + "\nanna admin " + std::string(64, '0')), HasSubstr("a different scope"));
  EXPECT_THAT(refusal("# none yet\n"), HasSubstr("cellcrushd token"));
}

TEST_F(TokenFileTest, AFileThatOthersCanReadOrWriteIsRefused) {
  const std::string line = make_token("anna", Scope::submit).line;
  for (const mode_t mode : {0644U, 0604U, 0620U, 0602U}) {
    write_secret(path(), line);
    chmod(path().c_str(), mode);
    EXPECT_THAT(access_refusal_of([this] { const TokenFile tokens(path()); }), HasSubstr("chmod 600")) << mode;
  }
  chmod(path().c_str(), 0440);
  EXPECT_EQ(access_refusal_of([this] { const TokenFile tokens(path()); }), "");
  EXPECT_THAT(access_refusal_of([this] { const TokenFile tokens(folder_.path()); }),
              HasSubstr("is not a regular file"));
  EXPECT_THAT(access_refusal_of([this] { const TokenFile tokens(folder_.path() / "none"); }),
              HasSubstr("No such file"));
}

TEST(TlsFilesTest, UnsoundFilesAreRefusedByTheirOptionAndName) {
  const testing::TemporaryFolder folder;
  const testing::Authority authority(folder.path(), "authority");
  const auto good = authority.sign("good");
  const auto other = authority.sign("other");
  const auto expired = authority.sign("expired", {"server", "DNS:localhost", -7200, -3600});
  const auto early = authority.sign("early", {"server", "DNS:localhost", 3600, 7200});
  const auto text = folder.path() / "text";
  write_secret(text, "no certificate");
  const auto refusal = [](const auto& certificate, const auto& key, const std::filesystem::path& clients = {}) {
    return access_refusal_of([&] { read_tls_files(certificate, key, clients); });
  };
  EXPECT_EQ(refusal(good.certificate, good.key), "");
  EXPECT_EQ(refusal(good.certificate, good.key, authority.certificate()), "");
  EXPECT_THAT(refusal(folder.path() / "none", good.key), StartsWith("--tls-cert " + (folder.path() / "none").string()));
  EXPECT_THAT(refusal(text, good.key), AllOf(StartsWith("--tls-cert"), HasSubstr("no valid PEM certificate")));
  EXPECT_THAT(refusal(expired.certificate, expired.key), HasSubstr("expired on"));
  EXPECT_THAT(refusal(early.certificate, early.key), HasSubstr("not valid before"));
  EXPECT_THAT(refusal(good.certificate, text), AllOf(StartsWith("--tls-key"), HasSubstr("no PEM private key")));
  EXPECT_THAT(refusal(good.certificate, other.key), HasSubstr("does not match the certificate"));
  EXPECT_THAT(refusal(good.certificate, good.key, text), StartsWith("--tls-client-ca"));
  chmod(good.key.c_str(), 0644);
  EXPECT_THAT(refusal(good.certificate, good.key), HasSubstr("is readable by other users"));
}

}  // namespace
}  // namespace cellcrush::access
