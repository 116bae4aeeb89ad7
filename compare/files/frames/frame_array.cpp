#include "compare/files/frames/frame_array.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "compare/problem/error.hpp"

namespace ogc::compare {
namespace {

/// Bytes of an array that are read at once.
constexpr std::uint64_t chunk_bytes = 1 << 20;

/// Returns `topology` without positions. Throws InputError if a face refers to a vertex that the array lacks.
Mesh checked_faces(Mesh topology, const FrameLayout& layout, const std::string& where) {
  const auto check = [&](const char* kind, const auto& faces) {
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (const Index v : faces[i])
        if (v < 0 || static_cast<std::uint64_t>(v) >= layout.vertices)
          throw InputError(where + ": " + kind + " " + std::to_string(i) + ": vertex " + std::to_string(v) +
                           " does not exist; a frame has " + std::to_string(layout.vertices) + ", numbered from 0");
  };
  check("triangle", topology.triangles);
  check("edge", topology.loose_edges);
  topology.positions.clear();
  return topology;
}

class FrameArray : public MeshSequence {
 public:
  FrameArray(std::string where, const FrameLayout& layout, Mesh topology, ArrayOpener open, std::uint64_t room)
      : where_(std::move(where)),
        layout_(layout),
        topology_(checked_faces(std::move(topology), layout, where_)),
        open_(std::move(open)),
        room_(room) {}

  std::size_t size() const override { return layout_.frames; }
  std::string name(std::size_t i) const override { return "frame " + std::to_string(i); }

  LoadedMesh next() override {
    const std::string frame = name(next_);
    layout_.first_fastest ? gather(frame) : read_next(frame);
    ++next_;
    Mesh mesh = topology_;
    mesh.positions.resize(layout_.vertices);
    const std::size_t width = size_of(layout_.type);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const auto coordinate = [&](std::size_t k) {
        return scalar_at(bytes_.data() + begin_ + (3 * v + k) * width, layout_.type, layout_.order);
      };
      mesh.positions[v] = {coordinate(0), coordinate(1), coordinate(2)};
      if (!std::isfinite(mesh.positions[v].x) || !std::isfinite(mesh.positions[v].y) ||
          !std::isfinite(mesh.positions[v].z))
        throw InputError(where_ + ": " + frame + ": vertex " + std::to_string(v) + ": a coordinate is not finite");
    }
    return {std::move(mesh), {}, {}};
  }

 private:
  void read_next(const std::string& frame) {
    if (!source_) source_ = open_();
    bytes_.resize(layout_.frame_bytes());
    source_(bytes_, frame);
  }

  /// Sets `begin_` to the position of the current frame in `bytes_`, where gathered frames are in C order. Reads the
  /// array again unless the last pass gathered this frame.
  void gather(const std::string& frame) {
    if (next_ >= gathered_end_) {
      gathered_ = next_;
      const std::uint64_t count = std::clamp<std::uint64_t>(room_ / layout_.frame_bytes(), 1, layout_.frames - next_);
      gathered_end_ = next_ + count;
      bytes_.resize(count * layout_.frame_bytes());
      pass(frame);
    }
    begin_ = (next_ - gathered_) * layout_.frame_bytes();
  }

  /// Reads the whole array once and gathers frames. Entry e of the array is coordinate e / (frames · vertices) of
  /// vertex e / frames mod vertices in frame e mod frames.
  void pass(const std::string& frame) {
    const std::size_t width = size_of(layout_.type);
    const std::uint64_t numbers = layout_.frames * layout_.vertices * 3;
    const ByteSource source = open_();
    std::string chunk;
    for (std::uint64_t from = 0; from < numbers;) {
      const std::uint64_t to = std::min(numbers, from + chunk_bytes / width);
      chunk.resize((to - from) * width);
      source(chunk, frame);
      for (std::uint64_t row = from / layout_.frames; row * layout_.frames < to; ++row) {
        const std::uint64_t first = row * layout_.frames, place = row % layout_.vertices * 3 + row / layout_.vertices;
        for (std::uint64_t e = std::max(from, first + gathered_); e < std::min(to, first + gathered_end_); ++e)
          std::copy_n(chunk.data() + (e - from) * width, width,
                      bytes_.data() + (e - first - gathered_) * layout_.frame_bytes() + place * width);
      }
      from = to;
    }
  }

  std::string where_;
  FrameLayout layout_;
  Mesh topology_;
  ArrayOpener open_;
  std::uint64_t room_;
  ByteSource source_{};
  std::string bytes_{};  // one frame, or the frames from gathered_ to gathered_end_
  std::uint64_t begin_ = 0, gathered_ = 0, gathered_end_ = 0;
  std::size_t next_ = 0;
};

class Chain : public MeshSequence {
 public:
  explicit Chain(std::vector<FramePart> parts) : parts_(std::move(parts)) {
    for (const FramePart& part : parts_) size_ += part.frames;
  }
  std::size_t size() const override { return size_; }

  std::string name(std::size_t i) const override {
    for (const FramePart& part : parts_) {
      if (i < part.frames) return part.frames == 1 ? part.name : part.name + ": frame " + std::to_string(i);
      i -= part.frames;
    }
    return {};
  }

  LoadedMesh next() override {
    while (!open_ || read_ == open_->size()) {
      open_ = parts_.at(part_++).open();
      read_ = 0;
    }
    ++read_;
    return open_->next();
  }

 private:
  std::vector<FramePart> parts_;
  std::size_t size_ = 0, part_ = 0, read_ = 0;
  std::unique_ptr<MeshSequence> open_;
};

}  // namespace

std::unique_ptr<MeshSequence> frame_array(std::string where, const FrameLayout& layout, Mesh topology, ArrayOpener open,
                                          std::uint64_t room) {
  return std::make_unique<FrameArray>(std::move(where), layout, std::move(topology), std::move(open), room);
}

std::unique_ptr<MeshSequence> chained(std::vector<FramePart> parts) {
  return std::make_unique<Chain>(std::move(parts));
}

}  // namespace ogc::compare
