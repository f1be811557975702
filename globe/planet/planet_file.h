#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "globe/planet/dataset.h"

namespace globe::planet {

inline constexpr int kFormatVersion = 2;  ///< planets without insets are written as version 1
inline constexpr const char* kPlanetFileName = "planet.json";

/// A file of a planet folder, as planet.json lists it.
struct StoredFile {
  std::string name;
  std::uint64_t bytes = 0;
  std::uint64_t hash = 0;  ///< XXH3, 64 bits, of the whole file

  friend bool operator==(const StoredFile&, const StoredFile&) = default;
};

/// The files of one layer, diamond 0 to 3; none when no level is stored.
struct StoredLayer {
  LayerInfo info;
  int stored_level = -1;  ///< finest level in the files; finer ones up to info.level are those of "height"
  std::vector<StoredFile> files;

  friend bool operator==(const StoredLayer&, const StoredLayer&) = default;
};

/// One file of an inset's block.
struct InsetFile {
  std::string what;  ///< "height", "weight", "relief", "color"
  int channels = 1;
  std::string storage;     ///< as in LayerInfo
  int levels_coarser = 0;  ///< its finest level is so much coarser than the inset's
};
/// The files of each block of an inset over a layer, in this order; none for an unknown layer.
std::vector<InsetFile> inset_files(const std::string& layer);

struct StoredInset {
  InsetInfo info;
  std::vector<std::vector<StoredFile>> files;  ///< of each block, those of inset_files

  friend bool operator==(const StoredInset&, const StoredInset&) = default;
};

/// Whether an inset may be called so: 1 to 64 letters, digits, '.', '_' or '-', no '.' at the front, and not
/// a word that answers use for other sources ("data", "synthesised").
bool is_inset_name(const std::string& name);

/// planet.json: what the folder holds. `info.layers` repeats `layers[].info`, `info.insets` `insets[].info`.
struct PlanetFile {
  PlanetInfo info;
  std::vector<StoredLayer> layers;
  std::vector<StoredInset> insets = {};

  friend bool operator==(const PlanetFile&, const PlanetFile&) = default;
};

/// Reads FOLDER/planet.json. Throws globe::Error when it is absent, malformed or of a newer format version.
PlanetFile read_planet_file(const std::filesystem::path& folder);

/// Writes FOLDER/planet.json under a temporary name, syncs it to disk and renames it; `info.layers`,
/// `info.insets` and `info.id` are derived from the rest.
void write_planet_file(const std::filesystem::path& folder, PlanetFile file);

/// Size and hash of a file on disk. Throws globe::Error when it cannot be read.
StoredFile describe_file(const std::filesystem::path& path);

/// Flushes a file or folder to disk. Throws globe::Error when that fails.
void sync_to_disk(const std::filesystem::path& path);

/// One line for each file of the planet whose bytes differ from what planet.json says, and for planet.json
/// itself when it is not as write_planet_file left it; reads everything.
std::vector<std::string> find_damage(const std::filesystem::path& folder);

}  // namespace globe::planet
