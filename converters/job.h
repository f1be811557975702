#pragma once

#include <string>
#include <vector>

#include "converters/node_rect.h"

namespace converters {

/// Side of the tiles on disk, nodes: a clipmap's update strips touch few samples they do not need.
inline constexpr int kTileSize = 128;

/// Layers that jobs make (planet/dataset.h); those derived from heights come along with them.
enum class JobLayer { kHeight, kColor, kVoid };

/// "height", "color", "void".
std::string name_of(JobLayer layer);

/// A part of a conversion that needs no other: some rows of tiles of one diamond, at the finest level of one
/// layer.
struct Job {
  JobLayer layer = JobLayer::kHeight;
  int level = 0;
  int d = 0;
  int row = 0;  ///< block row, 0 .. block_rows(level) - 1

  friend bool operator==(const Job&, const Job&) = default;
};

/// Rows of nodes in a block row: whole tiles, a 64th of a diamond where that is as much, at most 512, so that
/// the parts of a planet are many and none is large.
int rows_per_job(int level);
int block_rows(int level);

/// The nodes of a job. The last row of a diamond belongs to its last job.
NodeRect nodes_of(const Job& job);

/// Every job of a layer, in order.
std::vector<Job> jobs_of(JobLayer layer, int level);

/// "height 2 17": layer, diamond, block row.
std::string name_of(const Job& job);

}  // namespace converters
