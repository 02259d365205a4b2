#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "access/gate.h"
#include "audit_log.h"
#include "jobs/admission.h"
#include "jobs/deletion.h"
#include "jobs/mesh_places.h"
#include "jobs/queues.h"
#include "rpc/method_table.h"
#include "store/change_reader.h"
#include "store/data_folder.h"
#include "store/journal.h"
#include "store/journal_reader.h"
#include "store/sweep_reader.h"
#include "watch/hub.h"

namespace cellcrush::rpc {

/// What the services work with; all of it outlives them.
struct ServiceParts {
  const store::DataFolder& folder;
  AuditLog& audit;
  store::Journal& journal;
  store::JournalReader& reader;
  store::SweepReader& sweeps;
  store::ChangeReader& changes;
  const jobs::Deletion& deletion;
  watch::Hub& hub;
  jobs::Queues& queues;
  jobs::Admission& admission;
  const access::Gate& gate;
  CallPool& calls;
  CallPool& checks;  ///< for checks that build meshes and may take seconds
  jobs::MeshPlaces& places;
  int check_threads = 1;      ///< for checking the points of one sweep
  double step_cost = 0.0;     ///< seconds of one core for an element-step of the reference crush
  bool has_device = false;    ///< for the runs that it can advance
  int owner_max_running = 0;  ///< jobs of one owner that run at once on one executor; 0: no limit
  StreamParts streams;
  StreamParts exports;  ///< fewer, as they hold the meshes of their jobs, and read without delay
};

/// Whether checking the case may take seconds, as its mesh waits for one of a few places.
bool is_large_case(const v1::Case& submitted);

// Each adds the calls of one service. `parts` outlives the table.
void add_cases_methods(MethodTable& table, const ServiceParts& parts);
void add_jobs_methods(MethodTable& table, const ServiceParts& parts);
void add_sweeps_methods(MethodTable& table, const ServiceParts& parts);
/// `drain`: called each time a client asks for it.
void add_admin_methods(MethodTable& table, const ServiceParts& parts, std::function<void()> drain);

/// grpc.reflection.v1 and v1alpha: describe the named services and themselves, from the descriptors linked into this
/// program. A stream holds no thread while its client is silent, and counts against the limits. The limits and the gate
/// outlive the services. Thread-safe.
std::vector<std::unique_ptr<grpc::Service>> make_reflection_services(std::vector<std::string> names, access::Gate& gate,
                                                                     StreamLimits& limits);

}  // namespace cellcrush::rpc
