#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "cellcrush/v1/jobs_service.pb.h"
#include "jobs/frame_series.h"
#include "jobs/mesh_places.h"
#include "rpc/services.h"
#include "rpc/stream_state.h"
#include "store/data_folder.h"
#include "store/journal_reader.h"

namespace cellcrush::rpc {

/// Source of an ExportJob: the HTML file (web/exported_page.h) in chunks. Holds one frame, the mesh and a page of
/// samples at most. Not thread-safe.
class ExportSource final : public PlainSource<v1::ExportJobResponse> {
 public:
  /// All of it outlives the source.
  struct Parts {
    const store::DataFolder& folder;
    store::JournalReader& reader;
    jobs::MeshPlaces& places;
  };

  /// Throws InvalidField for a request that is not valid, and ServiceError (failed_precondition) if the job has not
  /// ended.
  ExportSource(const Parts& parts, store::StoredJob job, const v1::ExportJobRequest& request);

  /// Checks the case and opens the frames. Throws ServiceError: exhausted while checks of other large cases occupy the
  /// daemon, and the errors of jobs::FrameSeries.
  void prepare(const Call& call);
  [[nodiscard]] bool is_large() const { return is_large_case(job_.job.case_()); }

  /// Throws the errors of jobs::FrameSeries.
  std::optional<Message> next();
  [[nodiscard]] bool has_more() const;
  [[nodiscard]] bool ended() const { return stage_ == Stage::done && text_.size() == sent_; }
  [[nodiscard]] std::string resume_advice() const { return "from the start"; }

 private:
  enum class Stage { head, check, history, times, mesh, frames, end, done };

  /// Appends the next piece of the file to `text_`.
  void append();
  /// Throws ServiceError (not_found) if the job was deleted meanwhile.
  void check_is_there();
  void append_history();
  void append_times();
  void append_mesh();
  void append_frame();
  /// Which frames fit.
  void choose_frames();
  [[nodiscard]] double mean_frame_bytes(int count);

  Parts parts_;
  store::StoredJob job_;
  std::int64_t max_bytes_;
  std::string check_;  ///< of the case, as it stands in the file
  Stage stage_ = Stage::head;
  std::string text_;       ///< made
  std::size_t sent_ = 0;   ///< of text_
  std::int64_t size_ = 0;  ///< of the file so far
  std::int64_t last_sample_ = 0;
  int page_ = 0;                               ///< of the samples
  std::unique_ptr<jobs::FrameSeries> series_;  ///< null without frames
  std::optional<v1::Mesh> mesh_;
  std::deque<v1::MeshChunk> mesh_chunks_;  ///< still to append
  int frame_count_ = 0;                    ///< of the job
  int stride_ = 1;                         ///< between the frames of the file
  int next_frame_ = 0;
};

}  // namespace cellcrush::rpc
