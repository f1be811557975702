#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <vector>

#include "app/view_options.h"
#include "globe/scene/scene.h"

namespace app {

/// The scene, where the word for the PLANET names one: a file that ends in .toml. The planet and whatever
/// picture it asks for are then taken into the options, unless the command line says otherwise; the rest is
/// up to the command. Throws what globe::scene::read_scene throws.
std::optional<globe::scene::Scene> take_scene(const CLI::App& command, CameraOptions& options);
/// The same with what --shapes, --graticule and --labels ask for, a scene even where no file is named.
std::optional<globe::scene::Scene> take_scene(const CLI::App& command, ViewOptions& options);

/// Has the scene ask for an effect as it usually is, in place of one that it has. Throws UsageError for one
/// that there is not, Error when nothing is usual for it.
void add_effect(globe::scene::Scene& scene, const std::string& name);

/// The effects that it asks for; none without a scene. Throws what effects::make_effects throws, and Error
/// for those of a lens in pictures that are taken without one.
std::vector<globe::render::NamedEffect> effects_of(const std::optional<globe::scene::Scene>& scene,
                                                   const globe::planet::Surface& surface,
                                                   const Optics& optics);

}  // namespace app
