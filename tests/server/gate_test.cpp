#include <gmock/gmock.h>
#include <grpcpp/generic/generic_stub.h>

#include "access/token_file.h"
#include "error.h"
#include "log_format.h"
#include "server/gate_fixture.h"
#include "server/log_capture.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;

class GateTest : public GateFixture {
 protected:
  // A TLS port of clients whose certificates one of the authorities has signed.
  void start_with_client_authority() {
    DaemonOptions options = with_tls(tcp_options());
    options.access.tls_client_authority = authority_.certificate();
    start(options);
  }
};

TEST_F(GateTest, AnAddressThatOthersReachIsRefusedWithoutTlsOrAWayToTellWhoCalls) {
  for (const char* address : {"0.0.0.0:0", "[::]:0", "192.0.2.1:0"}) {
    EXPECT_THAT(refusal_of_start(tcp_options(address)), HasSubstr("--tls-cert FILE --tls-key FILE")) << address;
    EXPECT_THAT(refusal_of_start(with_tokens(tcp_options(address))), HasSubstr("--tls-cert")) << address;
    EXPECT_THAT(refusal_of_start(with_tls(tcp_options(address))), HasSubstr("--tokens FILE or --tls-client-ca FILE"));
  }
  DaemonOptions half = with_tls(tcp_options());
  half.access.tls_key.clear();
  EXPECT_THAT(refusal_of_start(half), HasSubstr("belong together"));
  DaemonOptions clients = tcp_options();
  clients.access.tls_client_authority = authority_.certificate();
  EXPECT_THAT(refusal_of_start(clients), HasSubstr("--tls-client-ca needs TLS"));
  DaemonOptions missing = tcp_options();
  missing.access.tokens = folder_.path() / "none";
  EXPECT_THAT(refusal_of_start(missing), HasSubstr("--tokens " + (folder_.path() / "none").string()));
  DaemonOptions metrics = default_options();
  metrics.metrics = "0.0.0.0:0";
  EXPECT_THAT(refusal_of_start(metrics), HasSubstr("--metrics 127.0.0.1"));
  EXPECT_FALSE(std::filesystem::exists(data_folder())) << "Nothing is opened before.";
  EXPECT_EQ(refusal_of_start(with_tokens(with_tls(tcp_options("0.0.0.0:0")))), "");
}

TEST_F(GateTest, TcpTakesGoodTokensOnlyAndTheSocketNeedsNone) {
  start(with_tokens(with_tls(tcp_options())));
  EXPECT_TRUE(list(with("reader")).ok());
  Visitor none{authority_.certificate(), {}, ""};
  EXPECT_EQ(list(none).error_code(), grpc::StatusCode::UNAUTHENTICATED);
  EXPECT_THAT(list(none).error_message(), HasSubstr("--token-file"));
  for (const std::string& wrong : {tokens_.at("anna") + "0", tokens_.at("anna").substr(1), std::string("x")}) {
    const auto status = list({authority_.certificate(), {}, wrong});
    EXPECT_THAT(status, Fails(grpc::StatusCode::UNAUTHENTICATED, "cellcrushd token"));
  }
  EXPECT_TRUE(client().list().empty());
}

TEST_F(GateTest, AChangedFileOfTokensIsTakenWithoutARestartAndABrokenOneChangesNothing) {
  start(with_tokens(with_tls(tcp_options())));
  ASSERT_TRUE(list(with("reader")).ok());
  const LogCapture log(make_text_formatter());
  const auto made = access::make_token("carla", access::Scope::read);
  const std::filesystem::path file = folder_.path() / "tokens";
  write_secret(file, made.line + "\nnonsense\n");
  daemon_->read_files_again();
  EXPECT_TRUE(list(with("reader")).ok());
  EXPECT_EQ(log.count_lines("--tokens " + file.string() + ": line 2 is not of the form"), 1) << log.text();
  EXPECT_EQ(log.count_lines("Fix the file and send SIGHUP again."), 1);

  write_secret(file, made.line + "\n");
  daemon_->read_files_again();
  EXPECT_EQ(list(with("reader")).error_code(), grpc::StatusCode::UNAUTHENTICATED) << "It was taken back.";
  EXPECT_TRUE(list({authority_.certificate(), {}, made.token}).ok());
}

TEST_F(GateTest, AChangedCertificateIsShownToNewConnectionsAndOldOnesStay) {
  const DaemonOptions options = with_tokens(with_tls(tcp_options()));
  start(options);
  const auto old_jobs = v1::Jobs::NewStub(channel(with("reader")));
  v1::ListJobsResponse response;
  ASSERT_TRUE(old_jobs->ListJobs(bounded_context().get(), {}, &response).ok());

  const LogCapture log(make_text_formatter());
  const Visitor newcomer{other_authority_.certificate(), {}, tokens_.at("reader")};
  const auto key = text_of_file(options.access.tls_key);
  static_cast<void>(other_authority_.sign("server", {"new-server"}));
  const auto new_key = text_of_file(options.access.tls_key);
  write_secret(options.access.tls_key, key);
  daemon_->read_files_again();
  EXPECT_EQ(log.count_lines("--tls-key " + options.access.tls_key.string() + ": does not match"), 1) << log.text();
  EXPECT_EQ(log.count_lines("The previous certificates stay in force."), 1);
  EXPECT_TRUE(list(with("reader")).ok()) << "A key of another certificate changes nothing.";

  write_secret(options.access.tls_key, new_key);
  daemon_->read_files_again();
  EXPECT_EQ(log.count_lines("--tls-cert " + options.access.tls_certificate.string() + ": CN=new-server, valid until "),
            1)
      << log.text();
  EXPECT_TRUE(list(newcomer).ok());
  EXPECT_EQ(list(with("reader")).error_code(), grpc::StatusCode::UNAVAILABLE) << "Who trusts the old authority only.";
  EXPECT_TRUE(old_jobs->ListJobs(bounded_context().get(), {}, &response).ok()) << "An open connection stays.";
}

TEST_F(GateTest, AChangedAuthorityOfClientsHoldsForNewConnections) {
  DaemonOptions options = with_tls(tcp_options());
  options.access.tls_client_authority = folder_.path() / "clients.pem";
  write_secret(options.access.tls_client_authority, text_of_file(authority_.certificate()));
  start(options);
  const Visitor anna{authority_.certificate(), authority_.sign("anna", client_request("anna")), ""};
  const Visitor bob{authority_.certificate(), other_authority_.sign("bob", client_request("bob")), ""};
  EXPECT_TRUE(list(anna).ok());
  EXPECT_EQ(list(bob).error_code(), grpc::StatusCode::UNAVAILABLE);
  write_secret(options.access.tls_client_authority, text_of_file(other_authority_.certificate()));
  daemon_->read_files_again();
  EXPECT_EQ(list(anna).error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_TRUE(list(bob).ok());
}

TEST_F(GateTest, TwoTokensInOneCallAreRefused) {
  start(with_tokens(tcp_options()));
  const auto jobs = v1::Jobs::NewStub(channel({}));
  const auto context = bounded_context();
  context->AddMetadata("authorization", "Bearer " + tokens_.at("chief"));
  context->AddMetadata("authorization", "Bearer wrong");
  v1::ListJobsResponse response;
  EXPECT_EQ(jobs->ListJobs(context.get(), {}, &response).error_code(), grpc::StatusCode::UNAUTHENTICATED);
}

TEST_F(GateTest, CallsOfOneConnectionAreEachTakenForTheirOwn) {
  start(with_tokens(tcp_options()));
  const auto jobs = v1::Jobs::NewStub(channel({}));
  for (const char* name : {"anna", "bob", "anna"}) {
    v1::Job job;
    ASSERT_TRUE(jobs->CreateJob(context_of({{}, {}, tokens_.at(name)}).get(), job_of(small_case()), &job).ok());
    EXPECT_EQ(job.owner(), name);
  }
  EXPECT_EQ(try_call(*jobs, &v1::Jobs::Stub::CreateJob, {}).error_code(), grpc::StatusCode::UNAUTHENTICATED);
}

TEST_F(GateTest, HealthIsOpenAndReflectionIsNot) {
  start(with_tokens(tcp_options()));
  const auto call = [this](const std::string& method, const Visitor& visitor) {
    grpc::GenericStub stub(channel(visitor));
    grpc::CompletionQueue queue;
    const auto context = context_of(visitor);
    const grpc::Slice nothing("");
    const auto rpc = stub.PrepareUnaryCall(context.get(), method, grpc::ByteBuffer(&nothing, 1), &queue);
    rpc->StartCall();
    grpc::ByteBuffer response;
    grpc::Status status;
    void* tag = nullptr;
    bool ok = false;
    rpc->Finish(&response, &status, nullptr);
    queue.Next(&tag, &ok);
    return status.error_code();
  };
  EXPECT_EQ(call("/grpc.health.v1.Health/Check", {}), grpc::StatusCode::OK);
  const std::string reflection = "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo";
  EXPECT_EQ(call(reflection, {}), grpc::StatusCode::UNAUTHENTICATED);
  EXPECT_EQ(call("/cellcrush.v1.Jobs/Unknown", {}), grpc::StatusCode::UNAUTHENTICATED);
  EXPECT_EQ(call("/cellcrush.v1.Jobs/Unknown", {{}, {}, tokens_.at("bob")}), grpc::StatusCode::PERMISSION_DENIED);
  EXPECT_EQ(call("/cellcrush.v1.Jobs/Unknown", {{}, {}, tokens_.at("chief")}), grpc::StatusCode::UNIMPLEMENTED);
}

TEST_F(GateTest, AScopeThatIsTooSmallIsToldTheOneThatIsNeeded) {
  start(with_tokens(with_tls(tcp_options())));
  const auto denied = [](const grpc::Status& status, const std::string& scope) {
    EXPECT_EQ(status.error_code(), grpc::StatusCode::PERMISSION_DENIED) << status.error_message();
    EXPECT_THAT(status.error_message(), HasSubstr("requires scope " + scope));
  };
  const auto reader = channel(with("reader"));
  denied(try_call(*v1::Jobs::NewStub(reader), &v1::Jobs::Stub::CreateJob, job_of(small_case())), "submit");
  denied(try_call(*v1::Sweeps::NewStub(reader), &v1::Sweeps::Stub::CreateSweep, {}), "submit");
  denied(try_call(*v1::Admin::NewStub(channel(with("anna"))), &v1::Admin::Stub::Drain, {}), "admin");
  // A watch is a stream, and passes the same gate.
  v1::JobEvent event;
  const auto context = bounded_context();
  const auto stream = v1::Jobs::NewStub(channel({authority_.certificate(), {}, ""}))
                          ->WatchJob(context.get(), named<v1::WatchJobRequest>("jobs/1"));
  EXPECT_FALSE(stream->Read(&event));
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::UNAUTHENTICATED);
}

TEST_F(GateTest, ACertificateNamesItsOwnerAndOneOfAnotherAuthorityIsNotLetIn) {
  start_with_client_authority();
  const auto anna = channel({authority_.certificate(), authority_.sign("anna", client_request("anna")), ""});
  const auto job = answer_of(*v1::Jobs::NewStub(anna), &v1::Jobs::Stub::CreateJob, job_of(small_case()));
  EXPECT_EQ(job.owner(), "anna");
  EXPECT_EQ(try_call(*v1::Admin::NewStub(anna), &v1::Admin::Stub::Drain, {}).error_code(),
            grpc::StatusCode::PERMISSION_DENIED);
  const auto refused = [this](const CertificateFiles& shown) {
    return list({authority_.certificate(), shown, ""}).error_code();
  };
  EXPECT_EQ(refused({}), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(refused(other_authority_.sign("eve", {"anna"})), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(refused(authority_.sign("old", {"anna", "", -7200, -3600})), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(refused(authority_.sign("liar", client_request("local"))), grpc::StatusCode::UNAUTHENTICATED);
}

TEST_F(GateTest, ACertificateThatIsNotForClientsIsRefused) {
  start_with_client_authority();
  const auto status_of = [this](const char* use) {
    CertificateRequest request{"anna"};
    request.extended_key_usage = use;
    return list({authority_.certificate(), authority_.sign("anna", request), ""});
  };
  EXPECT_TRUE(status_of("clientAuth").ok());
  EXPECT_TRUE(status_of("serverAuth,clientAuth").ok());
  EXPECT_EQ(status_of("serverAuth").error_code(), grpc::StatusCode::UNAVAILABLE) << "TLS refuses it.";
  // The daemon's own certificate, which says nothing about its use.
  const auto server = status_of("");
  EXPECT_THAT(server, Fails(grpc::StatusCode::UNAUTHENTICATED, "extendedKeyUsage = clientAuth"));
}

}  // namespace
}  // namespace cellcrush::testing
