#include "app/run.h"

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>

#include "app/commands.h"
#include "globe/base/error.h"

namespace app {

int run(int argc, const char* const* argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file over the limit is then a write that fails, and told in one line
  CLI::App program("A planet-scale globe: fly over it, convert maps to it, ask it questions.", "globe");
  program.set_version_flag("--version", version());
  program.require_subcommand(1);
  int exit_status = 0;
  add_commands(program, exit_status);
  try {
    program.parse(arguments(argc, argv));
    return exit_status;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);
    std::fprintf(stderr, "globe: command line: %s; see globe --help\n", error.what());
    return 2;
  } catch (const globe::UsageError& error) {
    std::fprintf(stderr, "globe: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "globe: %s\n", error.what());
    return 1;
  }
}

}  // namespace app
