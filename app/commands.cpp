#include "app/commands.h"

#include "app/convert.h"
#include "app/info.h"

namespace app {

std::string version() { return "globe " GLOBE_VERSION; }

void add_commands(CLI::App& program, int& exit_status) {
  add_convert(program, exit_status);
  add_info(program, exit_status);
}

}  // namespace app
