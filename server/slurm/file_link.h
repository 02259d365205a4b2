#pragma once

#include <utility>

#include "slurm/attempt_folder.h"
#include "slurm/link.h"

namespace cellcrush::slurm {

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
