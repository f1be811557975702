#include "app/converter_command.h"

#include <cstdio>
#include <map>

namespace app {

converters::ConvertListener listener_of(Progress& progress, bool quiet) {
  const auto print = [&progress](const std::string& text) {
    progress.clear();
    std::fprintf(stderr, "globe: %s\n", text.c_str());
  };
  converters::ConvertListener listener;
  if (!quiet) listener.note = print;
  listener.warning = [print](const std::string& text) { print("warning: " + text); };
  listener.progress = [&progress](const std::string& stage, double fraction) {
    progress.show(stage, fraction);
  };
  return listener;
}

converters::Filter filter_named(const std::string& name) {
  static const std::map<std::string, converters::Filter> filters{{"nearest", converters::Filter::kNearest},
                                                                 {"bilinear", converters::Filter::kBilinear},
                                                                 {"bicubic", converters::Filter::kBicubic},
                                                                 {"area", converters::Filter::kArea}};
  return filters.at(name);
}

}  // namespace app
