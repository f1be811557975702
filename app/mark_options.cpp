#include "app/mark_options.h"

#include <algorithm>
#include <any>
#include <array>
#include <charconv>
#include <filesystem>

#include "globe/base/error.h"
#include "globe/effects/graticule.h"
#include "globe/effects/list.h"
#include "globe/effects/mark_parameters.h"

namespace app {
namespace {

namespace effects = globe::effects;
namespace scene = globe::scene;

/// Of files, one after the other.
constexpr std::array kMarkColors{0xffd133u, 0x5cccffu, 0xff7aaeu, 0x94e66bu, 0xff9e52u, 0xbda3ffu};

bool is_named(const scene::Scene& in, const std::string& name) {
  return std::any_of(in.effects.begin(), in.effects.end(),
                     [&](const scene::Effect& effect) { return effect.name == name; });
}

/// Parameters of an effect of a scene, which is added if it is not there.
template <class Parameters>
Parameters& parameters_of(scene::Scene& in, const std::string& name, const std::string& option) {
  const auto known = effects::all_effects();
  if (std::none_of(known.begin(), known.end(), [&](const auto& entry) { return entry.kind.name == name; }))
    throw globe::UsageError(option, "this program has no effect \"" + name + '"', "leave it out");
  if (!is_named(in, name)) in.effects.push_back({name, 0, Parameters{}});
  const auto at = std::find_if(in.effects.begin(), in.effects.end(),
                               [&](const scene::Effect& effect) { return effect.name == name; });
  return *std::any_cast<Parameters>(&at->parameters);
}

std::optional<double> step_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  double step = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), step);
  constexpr double kLeast = 1.0 / 360'000.0, kMost = 90.0;
  if (error != std::errc() || end != text.data() + text.size() || !(step >= kLeast && step <= kMost) ||
      !effects::divides_quarter(step)) {
    throw globe::UsageError("--graticule " + text, "not a step in degrees that divides 90",
                            "write one such as 10 or 0.5, or none, after the PLANET");
  }
  return step;
}

/// A file of shapes and what its names are shown with.
void add_shapes(const std::vector<std::string>& files, scene::Scene& in) {
  auto& shapes = parameters_of<effects::ShapesParameters>(in, "shapes", "--shapes");
  for (const std::string& file : files) {
    effects::ShapeLayer layer;
    layer.file = file;
    layer.color = effects::mark_color(kMarkColors[shapes.layers.size() % kMarkColors.size()]);
    shapes.layers.push_back(std::move(layer));
  }
}

void add_labels(scene::Scene& in) {
  std::vector<std::filesystem::path> files;
  std::optional<effects::GraticuleParameters> graticule;
  for (const scene::Effect& effect : in.effects) {
    if (const auto* shapes = std::any_cast<effects::ShapesParameters>(&effect.parameters)) {
      for (const effects::ShapeLayer& layer : shapes->layers) files.push_back(layer.file);
    }
    if (const auto* lines = std::any_cast<effects::GraticuleParameters>(&effect.parameters))
      graticule = *lines;
  }
  if (files.empty() && !graticule)
    throw globe::UsageError("--labels on", "there is nothing to name", "give --shapes or --graticule too");
  auto& labels = parameters_of<effects::LabelsParameters>(in, "labels", "--labels");
  for (const std::filesystem::path& file : files) {
    if (std::find(labels.files.begin(), labels.files.end(), file) == labels.files.end())
      labels.files.push_back(file);
  }
  if (graticule) labels.graticule = graticule;
}

}  // namespace

void add_mark_options(CLI::App& command, MarkOptions& options) {
  command
      .add_option("--shapes", options.shapes,
                  "GeoJSON file of points, lines and polygons to draw on the ground; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      .add_option("--graticule", options.graticule,
                  "draw meridians and parallels, so many degrees apart (default: by what is in view)")
      ->expected(0, 1);
  command
      .add_option("--labels", options.labels,
                  "on or off: names of --shapes and numbers of the --graticule (default: on with either)")
      ->check(CLI::IsMember({"on", "off"}));
}

void add_marks(const MarkOptions& options, bool labels_fit, scene::Scene& in) {
  if (!options.shapes.empty()) add_shapes(options.shapes, in);
  if (options.graticule) {
    auto& graticule = parameters_of<effects::GraticuleParameters>(in, "graticule", "--graticule");
    if (const auto step = step_of(*options.graticule)) graticule.step_deg = step;
  }
  const bool asked = options.labels == "on";
  if (asked || (options.labels.empty() && labels_fit && (!options.shapes.empty() || options.graticule)))
    add_labels(in);
  if (options.labels == "off")
    std::erase_if(in.effects, [](const scene::Effect& effect) { return effect.name == "labels"; });
}

}  // namespace app
