#pragma once

#include <cstddef>
#include <memory>

#include "converters/team.h"

/// Made by the plug-in that app/mpi builds; the caller owns it. Ends the member, and with it the others, when
/// it dies before gather().
extern "C" converters::Team* globe_make_mpi_team(std::size_t lists);

namespace app {

/// This process' place among those that mpirun started: 0 of 1 when it did not.
struct MpiPlace {
  int rank = 0;
  int size = 1;
  int local_size = 1;  ///< of those on this machine
};
MpiPlace mpi_place();

/// The team of all of them. Throws globe::Error when the program was built without MPI.
std::unique_ptr<converters::Team> make_mpi_team(std::size_t lists);

}  // namespace app
