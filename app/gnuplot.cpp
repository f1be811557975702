#include "app/gnuplot.h"

#include <cstdint>

#include "app/piped_program.h"

namespace app {

std::string gnuplot_literal(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < ' ') continue;
    result += c == '\'' ? std::string("''") : std::string(1, c);
  }
  return result + "'";
}

void run_gnuplot(std::string_view commands, const std::string& remedy) {
  PipedProgram gnuplot({"gnuplot", "-d", "-"}, remedy);
  gnuplot.write({reinterpret_cast<const std::uint8_t*>(commands.data()), commands.size()});
  gnuplot.finish();
}

}  // namespace app
