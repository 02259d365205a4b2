#include "worker/piece_file.h"

#include <fcntl.h>

#include <cerrno>
#include <cstring>

namespace cellcrush::worker {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 18;

}  // namespace

PieceWriter::PieceWriter(const std::filesystem::path& path)
    : path_(path), file_(store::open_own(path, O_WRONLY | O_CREAT | O_TRUNC)) {}

void PieceWriter::write(std::string_view bytes) {
  if (gathered_.size() + bytes.size() > kPiece) flush();
  if (bytes.size() > kPiece) return store::write_all(file_, path_, bytes);
  gathered_ += bytes;
}

void PieceWriter::flush() {
  store::write_all(file_, path_, gathered_);
  gathered_.clear();
}

void PieceWriter::close() {
  flush();
  if (!file_.close()) store::throw_file_error(path_, "written", errno);
}

std::string_view PieceReader::next(std::uint64_t most) {
  if (place_ < start_ || place_ >= start_ + piece_.size()) {
    piece_ = file_.read(static_cast<std::int64_t>(place_), kPiece);
    start_ = place_;
  }
  const auto out = std::string_view(piece_).substr(place_ - start_, most);
  place_ += out.size();
  return out;
}

bool PieceReader::read(char* to, std::size_t size) {
  if (size > left()) return false;
  while (size > 0) {
    const auto part = next(size);
    std::memcpy(to, part.data(), part.size());
    to += part.size();
    size -= part.size();
  }
  return true;
}

}  // namespace cellcrush::worker
