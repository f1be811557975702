#include "app/mpi_team.h"

#include <dlfcn.h>

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "globe/base/error.h"

namespace app {
namespace {

int number_in_environment(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  int value = otherwise;
  if (text != nullptr) std::from_chars(text, text + std::strlen(text), value);
  return value;
}

/// Beside the program, or where an installed one has its libraries.
void* load_plugin() {
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  for (const char* place : {"libglobe_mpi.so", "../lib/globe/libglobe_mpi.so"}) {
    if (void* plugin = ::dlopen((folder / place).c_str(), RTLD_NOW | RTLD_GLOBAL)) return plugin;
  }
  return nullptr;
}

}  // namespace

MpiPlace mpi_place() {
  return {number_in_environment("OMPI_COMM_WORLD_RANK", 0), number_in_environment("OMPI_COMM_WORLD_SIZE", 1),
          number_in_environment("OMPI_COMM_WORLD_LOCAL_SIZE", 1)};
}

std::unique_ptr<converters::Team> make_mpi_team(std::size_t lists) {
  void* plugin = load_plugin();
  void* make = plugin != nullptr ? ::dlsym(plugin, "globe_make_mpi_team") : nullptr;
  if (make == nullptr) {
    throw globe::Error("mpirun", "this program was built without MPI",
                       "build it with libopenmpi-dev installed, or spread its --jobs by other means");
  }
  return std::unique_ptr<converters::Team>(reinterpret_cast<decltype(&globe_make_mpi_team)>(make)(lists));
}

}  // namespace app
