#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "load/figures.h"
#include "server/daemon_process.h"

namespace cellcrush::load {

/// A daemon with one worker that serves. Throws std::runtime_error if it does not within 30 s.
testing::DaemonProcess start_daemon(const std::filesystem::path& data_folder, const std::string& address);

/// Submits jobs one after the other that wait behind all others. Returns how long the calls took, and their names.
std::vector<double> submit(const std::string& address, int count, std::vector<std::string>* names = nullptr);

/// Durable submits of one client, then of eight at once.
void measure_submits(const std::string& address, int daemon, Record& record);

/// A sweep of 10,000 points: created, cancelled and deleted.
void measure_sweep(const std::string& address, int daemon, Record& record);

/// Memory of an idle daemon without jobs and with 200,000 that wait, its start with these, and lists of them with each
/// kind of filter, of which few or none match, so that all are searched.
void measure_many_jobs(const std::filesystem::path& folder, Record& record);

}  // namespace cellcrush::load
