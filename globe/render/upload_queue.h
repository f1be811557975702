#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <functional>

#include "globe/clipmap/level_data.h"

namespace globe::render {

/// A rectangle of one layer's texels to bring in: from a block in memory, or from another layer. Or a texture
/// to make, in one piece: drivers may well fill it.
struct UploadJob {
  enum class Kind {
    kVertices,
    kKnots,
    kShading,
    kCopyVertices,
    kCopyKnots,
    kCopyShading,
    kGrowVertices,
    kGrowShading
  };
  static constexpr std::size_t kKinds = 8;

  Kind kind = Kind::kVertices;
  int layer = 0;                                   ///< where to; to make: which plane
  clipmap::NodeRect nodes;                         ///< or knots; not empty
  std::size_t node_bytes = 0;                      ///< of each of them
  const clipmap::VertexBlock* vertices = nullptr;  ///< of kVertices and kKnots: holds `nodes`
  const clipmap::ShadingBlock* shading = nullptr;  ///< of kShading
  int from_layer = 0;                              ///< of copies

  std::size_t bytes() const;
  bool is_whole() const { return kind == Kind::kGrowVertices || kind == Kind::kGrowShading; }
};

/// What waits to be uploaded, first come, first served, within a frame's time.
///
/// A job that does not fit into what is left of the time, by the pace at which jobs of its kind went lately,
/// is cut into halves until it does. However short the time, one piece goes: everything asked for gets there.
class UploadQueue {
 public:
  using Clock = std::function<double()>;  ///< milliseconds since some moment

  /// Pieces are cut no smaller than this.
  static constexpr std::size_t kSmallestBytes = 16 * 1024;

  explicit UploadQueue(Clock clock = steady_milliseconds);

  void add(const UploadJob& job);
  void clear();

  /// Performs jobs, or pieces of them, in their order for about `ms` milliseconds; returns their bytes.
  std::size_t run(double ms, const std::function<void(const UploadJob&)>& perform);

  bool empty() const { return jobs_.empty(); }
  std::size_t size() const { return jobs_.size(); }
  std::size_t bytes() const { return bytes_; }

  static double steady_milliseconds();

 private:
  /// Bytes of a job's kind that go in so many milliseconds.
  double affordable(const UploadJob& job, double ms) const;
  void note(const UploadJob& job, double took_ms);

  Clock clock_;
  std::deque<UploadJob> jobs_;
  std::size_t bytes_ = 0;                            ///< of jobs_
  std::array<double, UploadJob::kKinds> ms_a_byte_;  ///< by kind, of late
};

}  // namespace globe::render
