#pragma once

#include <cstdint>
#include <string>

#include "slurm/attempt.pb.h"
#include "slurm/file_sink.h"
#include "store/job_folder.h"

namespace cellcrush::slurm {

/// A task's side of an attempt: how it reaches the daemon. Not thread-safe. Failures throw ServiceError; the task then
/// tries again.
class Link : public FileSink {
 public:
  /// Takes the attempt. False if another task or the daemon has it.
  virtual bool claim(const Claim& claim) = 0;

  /// Copies order, reports and checkpoints into this folder.
  virtual void fetch(const store::JobFolder& to) = 0;

  /// A sign of life, with a number that differs from the one before.
  virtual void beat(std::uint64_t number) = 0;

  /// What the daemon asks of the task.
  virtual Request::Kind requested() = 0;

  /// The last word, after all files.
  virtual void end(const Ended& ended) = 0;
};

}  // namespace cellcrush::slurm
