#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>

#include "app/commands.h"
#include "globe/base/error.h"

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file over the limit is then a write that fails, and told in one line
  CLI::App program("A planet-scale globe: fly over it, convert maps to it, ask it questions.", "globe");
  program.set_version_flag("--version", app::version());
  program.require_subcommand(1);
  int exit_status = 0;
  app::add_commands(program, exit_status);
  try {
    program.parse(app::arguments(argc, argv));
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
