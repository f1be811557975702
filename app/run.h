#pragma once

namespace app {

/// The program: reads the command line (argv[0] is its name), does what it says and gives the exit status: 0,
/// 1 for a failure, 2 for a command line that means nothing. Failures are told in one line on standard error.
int run(int argc, const char* const* argv);

}  // namespace app
