#include "app/commands.h"

namespace app {

std::string version() { return "globe " GLOBE_VERSION; }

void add_commands(CLI::App& program, int& exit_status) {
  add_fly(program);
  add_shot(program);
  static_cast<void>(exit_status);
}

}  // namespace app
