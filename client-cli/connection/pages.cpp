#include "connection/pages.h"

namespace cellcrush::client {

v1::GetHistoryResponse fetch_history(Connection& connection, const std::string& job) {
  v1::GetHistoryRequest request;
  request.set_name(job);
  return call_for_pages(connection, connection.jobs(), &v1::Jobs::Stub::GetHistory, request);
}

v1::Job fetch_job(Connection& connection, const std::string& name) {
  return connection.call_for(name, connection.jobs(), &v1::Jobs::Stub::GetJob);
}

v1::Sweep fetch_sweep(Connection& connection, const std::string& name) {
  return connection.call_for(name, connection.sweeps(), &v1::Sweeps::Stub::GetSweep);
}

v1::SweepTable fetch_table(Connection& connection, const std::string& sweep) {
  v1::GetSweepTableRequest request;
  request.set_name(sweep);
  return call_for_pages(connection, connection.sweeps(), &v1::Sweeps::Stub::GetSweepTable, request);
}

}  // namespace cellcrush::client
