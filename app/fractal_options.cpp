#include "app/fractal_options.h"

#include <charconv>

#include "app/parse_options.h"
#include "globe/base/error.h"

namespace app {

namespace fractal = globe::flat::fractal;

std::optional<std::uint64_t> fractal_seed(const std::string& word) {
  constexpr std::string_view kName = "fractal";
  if (word == kName) return fractal::Settings{}.seed;
  if (!word.starts_with(kName) || word[kName.size()] != ':') return std::nullopt;
  std::uint64_t seed = 0;
  const char* const first = word.data() + kName.size() + 1;
  const char* const last = word.data() + word.size();
  const auto [end, error] = std::from_chars(first, last, seed);
  if (first == last || end != last || error != std::errc()) {
    throw globe::UsageError(word, "the seed is not a whole number below 2^64", "write fractal or fractal:7");
  }
  return seed;
}

void add_fractal_options(CLI::App& command, FractalOptions& options) {
  fractal::Settings& settings = options.settings;
  const auto add = [&](const char* name, auto& value, double low, double high, const char* help) {
    command.add_option(name, value, help)
        ->capture_default_str()
        ->check(in_range(low, high))
        ->group("Fractal ground");
  };
  add("--iterations", settings.iterations, 1, 24, "an area's side has 2^iterations cells");
  add("--roughness", settings.roughness, 0, 1, "H: 0 jagged, 1 smooth");
  add("--relief", settings.relief_m, 0, 1e5, "deviation of the heights at the areas' corners, metres");
  add("--area", settings.area_m, 1e-3, 1e9, "side of an area, metres");
  add("--base", settings.base_m, -1e5, 1e5, "added to every height, metres");
  add("--contrast", settings.contrast, 0, 1, "how much smoother valleys are than peaks");
  command
      .add_option("--method", options.method,
                  "diamond-square, as first published, which creases; or square-square, which does not")
      ->capture_default_str()
      ->check(CLI::IsMember({"diamond-square", "square-square"}))
      ->group("Fractal ground");
}

fractal::Settings fractal_settings(const FractalOptions& options, const std::string& word) {
  fractal::Settings settings = options.settings;
  const auto seed = fractal_seed(word);
  if (!seed) throw globe::UsageError(word, "not the name of fractal ground", "write fractal or fractal:7");
  settings.seed = *seed;
  settings.method = fractal::method_by_name(options.method).value();
  fractal::check(settings);
  return settings;
}

}  // namespace app
