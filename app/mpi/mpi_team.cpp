#include <mpi.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <memory>
#include <thread>
#include <vector>

#include "app/mpi_team.h"

// Loaded only under mpirun, so that no other run pays for MPI's libraries.

namespace {

/// Every member takes each size-th job: jobs of a map cost about the same, and nobody has to be asked.
class MpiTeam : public converters::Team {
 public:
  explicit MpiTeam(std::size_t lists) : next_(lists) {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    int rank = 0, size = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    rank_ = static_cast<std::size_t>(rank);
    size_ = static_cast<std::size_t>(size);
  }

  /// Ends all members when this one gives up half-way.
  ~MpiTeam() override {
    if (!gathered_) MPI_Abort(MPI_COMM_WORLD, 1);
    wait_for_all();  // the first one is finishing the planet
    MPI_Finalize();
  }
  MpiTeam(const MpiTeam&) = delete;
  MpiTeam& operator=(const MpiTeam&) = delete;

  std::size_t claim(std::size_t list) override { return rank_ + size_ * next_[list]++; }

  bool gather(bool /*all_done*/) override {
    wait_for_all();
    gathered_ = true;
    return rank_ == 0;
  }

 private:
  /// A barrier that sleeps: MPI's own would keep a core busy that others work on.
  static void wait_for_all() {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(MPI_COMM_WORLD, &request);
    for (int done = 0; done == 0;) {
      MPI_Test(&request, &done, MPI_STATUS_IGNORE);
      if (done == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  std::vector<std::atomic<std::size_t>> next_;
  std::size_t rank_ = 0;
  std::size_t size_ = 1;
  bool gathered_ = false;
};

}  // namespace

extern "C" converters::Team* globe_make_mpi_team(std::size_t lists) {
  return std::make_unique<MpiTeam>(lists).release();
}
