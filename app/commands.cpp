#include "app/commands.h"

#include "app/convert.h"
#include "app/info.h"
#include "app/inset.h"

namespace app {

std::string version() { return "globe " GLOBE_VERSION; }

void add_commands(CLI::App& program, int& exit_status) {
  add_accuracy(program);
  add_bench(program);
  add_convert(program, exit_status);
  add_cover(program);
  add_explain(program);
  add_export(program);
  add_flat(program);
  add_fly(program);
  add_info(program, exit_status);
  add_inset(program);
  add_shot(program);
  add_lookup(program, exit_status);
  add_trixel(program, exit_status);
  add_height(program, exit_status);
  add_distance(program, exit_status);
  add_index(program, exit_status);
  add_find(program);
  add_pick(program, exit_status);
  add_profile(program);
  add_sight(program, exit_status);
  add_summary(program);
  add_tune(program);
  add_view(program);
}

std::vector<std::string> arguments(int argc, const char* const* argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  for (std::string& word : words) {
    if (word.size() > 2 && word.starts_with("-.") && word[2] >= '0' && word[2] <= '9') word.insert(1, 1, '0');
  }
  return {words.rbegin(), words.rend()};
}

}  // namespace app
