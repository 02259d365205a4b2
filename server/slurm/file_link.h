#pragma once

#include <utility>

#include "slurm/attempt_folder.h"
#include "slurm/file_sink.h"

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

/// Reaches the daemon through the attempt's folder on a shared file system.
class FileLink final : public Link {
 public:
  explicit FileLink(AttemptFolder folder) : folder_(std::move(folder)), sink_(folder_.files()) {}

  bool claim(const Claim& claim) override { return folder_.claim(claim); }
  void fetch(const store::JobFolder& to) override;
  void beat(std::uint64_t number) override { folder_.beat(number); }
  Request::Kind requested() override {
    folder_.look_again();
    return folder_.requested();
  }
  void write_reports(std::uint64_t offset, const std::string& bytes) override { sink_.write_reports(offset, bytes); }
  void put_checkpoint(const std::string& bytes) override { sink_.put_checkpoint(bytes); }
  void put_result(const std::filesystem::path& file) override { sink_.put_result(file); }
  void end(const Ended& ended) override { folder_.end(ended); }

 private:
  AttemptFolder folder_;
  FolderSink sink_;
};

/// Copies the files from which a worker resumes: reports and checkpoints. Throws ServiceError.
void copy_run(const store::JobFolder& from, const store::JobFolder& to);

}  // namespace cellcrush::slurm
