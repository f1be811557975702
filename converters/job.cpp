#include "converters/job.h"

#include <algorithm>

namespace converters {

using globe::planet::nodes_per_side;

int rows_per_job(int level) {
  constexpr int kLargest = 512;
  const int n = nodes_per_side(level);
  return std::min(n, std::clamp(n / 64, kTileSize, kLargest));
}

std::string name_of(JobLayer layer) {
  switch (layer) {
    case JobLayer::kHeight:
      return "height";
    case JobLayer::kColor:
      return "color";
    case JobLayer::kVoid:
      break;
  }
  return "void";
}

int block_rows(int level) { return nodes_per_side(level) / rows_per_job(level); }

NodeRect nodes_of(const Job& job) {
  const int rows = rows_per_job(job.level);
  const int last = job.row + 1 == block_rows(job.level) ? 1 : 0;
  return {job.d, job.level, 0, job.row * rows, nodes_per_side(job.level) + 1, rows + last};
}

std::vector<Job> jobs_of(JobLayer layer, int level) {
  std::vector<Job> jobs;
  for (int d = 0; d < globe::planet::kDiamonds; ++d)
    for (int row = 0; row < block_rows(level); ++row) jobs.push_back({layer, level, d, row});
  return jobs;
}

std::string name_of(const Job& job) {
  return name_of(job.layer) + " " + std::to_string(job.d) + " " + std::to_string(job.row);
}

}  // namespace converters
