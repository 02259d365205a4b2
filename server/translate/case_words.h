#pragma once

#include <string>

#include "cellcrush/v1/cases_service.pb.h"
#include "cellcrush/v1/event.pb.h"
#include "cellcrush/v1/jobs_service.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"

namespace cellcrush::translate {

// The words of answers: cases, theory and crush modes are described here and nowhere else. No words are stored, so jobs
// of earlier data folders have them too.

void add_words(v1::CheckCaseResponse& check);
void add_words(v1::Job& job);
void add_words(v1::ListJobsResponse& jobs);  ///< without the facts of the cases
void add_words(v1::Sweep& sweep);
void add_words(v1::ListSweepsResponse& sweeps);
void add_words(v1::SweepTable& table);
void add_words(v1::JobEvent& event);
void add_words(v1::WatchJobsResponse& message);
void add_words(v1::WatchSweepResponse& message);
/// Other answers have no words.
template <class Message>
void add_words(Message&) {}

/// Whether two plates crush the walls.
bool has_plates(const v1::Case& scene);

/// The numbers of a material, after its name if it has one.
std::string material_text(const v1::Material& material);

/// What elements_per_wall of a case counts: "elements per wall", of a frame "elements per beam".
std::string mesh_words(const v1::Case& scene);

}  // namespace cellcrush::translate
