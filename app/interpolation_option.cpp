#include "app/interpolation_option.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace app {
namespace {

using globe::planet::Interpolation;

struct NamedInterpolation {
  std::string_view name;
  Interpolation value;
};
constexpr std::array<NamedInterpolation, 3> kInterpolations{{{"nearest", Interpolation::kNearest},
                                                             {"linear", Interpolation::kLinear},
                                                             {"cubic", Interpolation::kCubic}}};

}  // namespace

CLI::Option* add_interpolation_option(CLI::App& command, Interpolation& interpolation) {
  std::vector<std::string> names;
  std::string default_name;
  for (const NamedInterpolation& known : kInterpolations) {
    names.emplace_back(known.name);
    if (known.value == interpolation) default_name = known.name;
  }
  const auto set = [&interpolation](const std::string& name) {
    const auto known =
        std::find_if(kInterpolations.begin(), kInterpolations.end(),
                     [&](const NamedInterpolation& candidate) { return candidate.name == name; });
    interpolation = known->value;  // IsMember lets no other name through
  };
  return command
      .add_option_function<std::string>(
          "--interpolation", set,
          "of heights between the nodes; cubic is clamped to the range of the nodes it is made of")
      ->default_str(default_name)
      ->check(CLI::IsMember(names));
}

}  // namespace app
