#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "globe/planet/surface.h"

namespace app {

/// The seed of `procedural[:SEED]`, nothing for other names. Throws globe::UsageError.
std::optional<std::uint64_t> procedural_seed(const std::string& planet);

/// Bytes of decoded data that are kept unless said otherwise.
inline constexpr std::size_t kDatasetCache = std::size_t{256} << 20;

/// Opens PLANET: `procedural[:SEED]` or a folder made by `globe convert`. Throws globe::Error or UsageError.
std::shared_ptr<const globe::planet::Surface> open_planet(const std::string& planet);

/// The same with so many bytes of decoded data, and of tiles made of them, kept, and drawn so many times as
/// high, its sea floor bare for a sea that is drawn over it or not, of some of its layers (the built-in
/// planet has none).
std::shared_ptr<const globe::planet::Surface> open_planet(
    const std::string& planet, std::size_t dataset_cache, std::size_t surface_cache,
    double exaggeration = 1.0, globe::planet::SeaFloor sea_floor = globe::planet::SeaFloor::kFlooded,
    const globe::planet::LayerChoice& layers = {});

/// Throws globe::Error when the planet was made of a colour map alone.
void require_heights(const globe::planet::Surface& surface, const std::string& planet);

/// One line on standard error when planet.json does not say what heights count from (COMMANDS.md, Heights).
void warn_of_unknown_datum(const globe::planet::Surface& surface, const std::string& planet);

}  // namespace app
