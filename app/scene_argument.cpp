#include "app/scene_argument.h"

#include <algorithm>
#include <filesystem>
#include <span>

#include "globe/base/error.h"
#include "globe/effects/list.h"

namespace app {
namespace {

namespace scene = globe::scene;

/// Takes what a scene says for an option that was not given; not of commands without it.
template <class Value, class Said>
void take(const CLI::App& command, const char* option, Value& value, const std::optional<Said>& said) {
  const CLI::Option* found = command.get_option_no_throw(option);
  if (said && found != nullptr && found->count() == 0) value = *said;
}

/// --with and --without.
void change_effects(std::optional<scene::Scene>& scene, const ViewOptions& options) {
  for (const std::string& name : options.with) add_effect(*scene, name);
  for (const std::string& name : options.without) {
    if (!scene || std::erase_if(scene->effects, [&](const auto& effect) { return effect.name == name; }) == 0)
      throw globe::UsageError("--without " + name, "the scene has no such effect", "leave it out");
  }
}

std::optional<scene::Scene> scene_of(const std::string& word) {
  if (!word.ends_with(".toml") || std::filesystem::is_directory(word)) return std::nullopt;
  return scene::read_scene(word, globe::effects::effect_kinds());
}

}  // namespace

std::optional<scene::Scene> take_scene(const CLI::App& command, CameraOptions& options) {
  std::optional<scene::Scene> scene = scene_of(options.planet);
  if (!scene) return scene;
  options.planet = scene->planet;
  const scene::Picture& picture = scene->picture;
  take(command, "--size", options.size, picture.size);
  // A field of view is that of its projection: one on the command line leaves the scene's behind.
  if (command.get_option("--projection")->count() == 0 || options.optics.projection == picture.projection)
    take(command, "--fov", options.optics.fov_deg, picture.fov_deg);
  take(command, "--projection", options.optics.projection, picture.projection);
  take(command, "--axis", options.optics.axis, picture.axis);
  take(command, "--faces", options.optics.faces, picture.faces);
  take(command, "--detail", options.detail, picture.detail);
  take(command, "--exaggeration", options.exaggeration, picture.exaggeration);
  if (picture.morph) take(command, "--morph", options.morph, std::optional(*picture.morph ? "on" : "off"));
  if (options.time.empty()) options.sun = scene->sun;
  options.layers = scene->layers;
  return scene;
}

void add_effect(scene::Scene& scene, const std::string& name) {
  const auto kinds = globe::effects::effect_kinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return k.name == name; });
  if (kind == kinds.end()) {
    std::string names;
    for (const auto& known : kinds) names += (names.empty() ? "" : ", ") + std::string(known.name);
    throw globe::UsageError("--with " + name, "no such effect", "give one of " + names);
  }
  std::erase_if(scene.effects, [&](const auto& effect) { return effect.name == name; });
  const scene::Scene usual = scene::parse_scene("planet = \"procedural\"\n[effects." + name + "]\n",
                                                "--with " + name, std::span(kind, 1));
  scene.effects.push_back(usual.effects.front());
}

std::optional<scene::Scene> take_scene(const CLI::App& command, ViewOptions& options) {
  std::optional<scene::Scene> scene = take_scene(command, static_cast<CameraOptions&>(options));
  // Without a scene one that asks for nothing else.
  if (!scene && (options.marks.any() || !options.with.empty())) {
    scene.emplace().file = "command line";
    scene->planet = options.planet;
  }
  if (options.marks.any()) add_marks(options.marks, options.optics.projection == "perspective", *scene);
  change_effects(scene, options);
  if (!scene) return scene;
  const scene::Picture& picture = scene->picture;
  take(command, "--samples", options.samples, picture.samples);
  take(command, "--background", options.background, picture.background);
  take(command, "--positions", options.positions, picture.positions);
  take(command, "--window", options.window, picture.window);
  if (globe::effects::draws_sea(*scene)) options.sea_floor = globe::planet::SeaFloor::kBare;
  return scene;
}

std::vector<globe::render::NamedEffect> effects_of(const std::optional<scene::Scene>& scene,
                                                   const globe::planet::Surface& surface,
                                                   const Optics& optics) {
  if (!scene) return {};
  std::vector<globe::render::NamedEffect> effects = globe::effects::make_effects(*scene, surface);
  for (const globe::render::NamedEffect& named : effects) {
    if (optics.is_wide() && named.effect->stage() == globe::render::Stage::kLens)
      throw globe::Error(scene->file.string() + ": effects." + named.name,
                         "it happens in a camera's lens, which only perspective pictures are taken through",
                         "leave it out, or the projection");
  }
  return effects;
}

}  // namespace app
