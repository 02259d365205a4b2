#include "connection/pages.h"

namespace cellcrush::client {

v1::GetHistoryResponse fetch_history(Connection& connection, const std::string& job) {
  v1::GetHistoryRequest request;
  request.set_name(job);
  return call_for_pages(connection, connection.jobs(), &v1::Jobs::Stub::GetHistory, request);
}

v1::Sweep fetch_sweep(Connection& connection, const std::string& name) {
  v1::GetSweepRequest request;
  request.set_name(name);
  return connection.call(connection.sweeps(), &v1::Sweeps::Stub::GetSweep, request);
}

v1::SweepTable fetch_table(Connection& connection, const std::string& sweep) {
  v1::GetSweepTableRequest request;
  request.set_name(sweep);
  return call_for_pages(connection, connection.sweeps(), &v1::Sweeps::Stub::GetSweepTable, request);
}

}  // namespace cellcrush::client
