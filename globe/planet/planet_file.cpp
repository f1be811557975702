#include "globe/planet/planet_file.h"

#include <fcntl.h>
#include <unistd.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "globe/base/error.h"
#include "globe/planet/grid.h"

namespace globe::planet {
namespace {

using nlohmann::ordered_json;

constexpr const char* kFormat = "globe planet";

std::string hex(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

std::uint64_t from_hex(const std::string& text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (error != std::errc{} || end != text.data() + text.size())
    throw std::runtime_error("bad hash '" + text + "'");
  return value;
}

ordered_json to_json(const std::vector<StoredFile>& stored) {
  ordered_json files = ordered_json::array();
  for (const StoredFile& file : stored) {
    files.push_back({{"name", file.name}, {"bytes", file.bytes}, {"xxh3", hex(file.hash)}});
  }
  return files;
}

ordered_json to_json(const StoredLayer& layer) {
  return {{"name", layer.info.name},
          {"level", layer.info.level},
          {"stored_level", layer.stored_level},
          {"channels", layer.info.channels},
          {"storage", layer.info.storage},
          {"min", layer.info.min},
          {"max", layer.info.max},
          {"files", to_json(layer.files)}};
}

ordered_json to_json(const StoredInset& inset) {
  ordered_json blocks = ordered_json::array();
  for (std::size_t b = 0; b < inset.info.blocks.size(); ++b) {
    const InsetBlock& block = inset.info.blocks[b];
    blocks.push_back({{"diamond", block.d},
                      {"i0", block.i0},
                      {"i1", block.i1},
                      {"j0", block.j0},
                      {"j1", block.j1},
                      {"files", to_json(inset.files[b])}});
  }
  return {{"name", inset.info.name}, {"layer", inset.info.layer}, {"level", inset.info.level},
          {"min", inset.info.min},   {"max", inset.info.max},     {"blocks", blocks}};
}

ordered_json to_json(const PlanetFile& file) {
  ordered_json layers = ordered_json::array();
  for (const StoredLayer& layer : file.layers) layers.push_back(to_json(layer));
  ordered_json json{{"format", kFormat},
                    {"version", file.insets.empty() ? 1 : kFormatVersion},
                    {"name", file.info.name},
                    {"body", file.info.body},
                    {"id", file.info.id},
                    {"ellipsoid", {{"a", file.info.ellipsoid.a}, {"f", file.info.ellipsoid.f}}},
                    {"vertical_datum", file.info.vertical_datum},
                    {"tile_size", file.info.tile_size},
                    {"layers", layers},
                    {"credits", file.info.credits}};
  for (const StoredInset& inset : file.insets) json["insets"].push_back(to_json(inset));
  return json;
}

void require(bool good, const std::string& what) {
  if (!good) throw std::runtime_error(what);
}

/// A name from planet.json must stay inside the folder.
std::string plain_file_name(const std::string& name) {
  require(!name.empty() && std::filesystem::path(name).filename() == name && name != "." && name != "..",
          "'" + name + "' is not a plain file name");
  return name;
}

std::vector<StoredFile> files_from_json(const ordered_json& json) {
  std::vector<StoredFile> files;
  for (const ordered_json& file : json) {
    files.push_back({plain_file_name(file.at("name").get<std::string>()),
                     file.at("bytes").get<std::uint64_t>(), from_hex(file.at("xxh3").get<std::string>())});
  }
  return files;
}

StoredLayer layer_from_json(const ordered_json& json) {
  StoredLayer layer;
  layer.info.name = json.at("name").get<std::string>();
  layer.info.level = json.at("level").get<int>();
  layer.stored_level = json.at("stored_level").get<int>();
  layer.info.channels = json.at("channels").get<int>();
  layer.info.storage = json.at("storage").get<std::string>();
  layer.info.min = json.at("min").get<double>();
  layer.info.max = json.at("max").get<double>();
  layer.files = files_from_json(json.at("files"));
  const std::string where = "layer '" + layer.info.name + "' ";
  require(layer.info.level >= 0 && layer.info.level <= kMaxLevel, where + "has a level outside 0 to 29");
  require(layer.stored_level >= -1 && layer.stored_level <= layer.info.level,
          where + "has a bad stored_level");
  require(layer.info.channels >= 1 && layer.info.channels <= 4, where + "has a bad number of channels");
  require(layer.info.storage == "float32" || layer.info.storage == "uint8",
          where + "has the unknown storage '" + layer.info.storage + "'");
  require(layer.files.size() == (layer.stored_level < 0 ? 0U : 4U),
          where + "does not list one file a diamond");
  return layer;
}

StoredInset inset_from_json(const ordered_json& json) {
  StoredInset inset;
  InsetInfo& info = inset.info;
  info.name = json.at("name").get<std::string>();
  require(is_inset_name(info.name), "'" + info.name + "' is no name for an inset");
  const std::string where = "inset '" + info.name + "' ";
  info.layer = json.at("layer").get<std::string>();
  const std::size_t files = inset_files(info.layer).size();
  require(files > 0, where + "lies over the unknown layer '" + info.layer + "'");
  info.level = json.at("level").get<int>();
  require(info.level >= kCoarsestInset && info.level <= kMaxLevel, where + "has a level outside 7 to 29");
  info.min = json.at("min").get<double>();
  info.max = json.at("max").get<double>();
  const int n = nodes_per_side(info.level);
  for (const ordered_json& one : json.at("blocks")) {
    const InsetBlock block{one.at("diamond").get<int>(), one.at("i0").get<int>(), one.at("i1").get<int>(),
                           one.at("j0").get<int>(), one.at("j1").get<int>()};
    require(block.d >= 0 && block.d < kDiamonds && block.i0 >= 0 && block.j0 >= 0 && block.i1 <= n &&
                block.j1 <= n && !block.empty() && !block.coarser(1).empty(),
            where + "has a block outside its diamond");
    for (const InsetBlock& other : info.blocks)
      require(other.d != block.d, where + "has two blocks in a diamond");
    info.blocks.push_back(block);
    inset.files.push_back(files_from_json(one.at("files")));
    require(inset.files.back().size() == files, where + "does not list the files of a block");
  }
  return inset;
}

PlanetFile planet_from_json(const ordered_json& json) {
  PlanetFile file;
  file.info.name = json.at("name").get<std::string>();
  file.info.body = json.at("body").get<std::string>();
  file.info.id = json.at("id").get<std::string>();
  file.info.ellipsoid = geo::make_ellipsoid(json.at("ellipsoid").at("a").get<double>(),
                                            json.at("ellipsoid").at("f").get<double>());
  file.info.vertical_datum = json.at("vertical_datum").get<std::string>();
  file.info.tile_size = json.at("tile_size").get<int>();
  require(file.info.tile_size >= 16 && file.info.tile_size <= 4096 && file.info.tile_size % 16 == 0,
          "tile_size is not a multiple of 16 from 16 to 4096");
  for (const ordered_json& layer : json.at("layers")) file.layers.push_back(layer_from_json(layer));
  for (const StoredLayer& layer : file.layers) file.info.layers.push_back(layer.info);
  file.info.credits = json.at("credits").get<std::vector<std::string>>();
  if (json.contains("insets")) {
    for (const ordered_json& inset : json.at("insets")) file.insets.push_back(inset_from_json(inset));
  }
  for (const StoredInset& inset : file.insets) {
    const auto layer = std::find_if(file.info.layers.begin(), file.info.layers.end(),
                                    [&](const LayerInfo& one) { return one.name == inset.info.layer; });
    require(layer != file.info.layers.end() && layer->level <= inset.info.level,
            "inset '" + inset.info.name + "' has no layer to lie over, or one finer than it");
    require(std::none_of(file.info.insets.begin(), file.info.insets.end(),
                         [&](const InsetInfo& other) {
                           return other.name == inset.info.name && other.layer == inset.info.layer;
                         }),
            "inset '" + inset.info.name + "' is listed twice");
    file.info.insets.push_back(inset.info);
  }
  return file;
}

/// Every file that planet.json names.
std::vector<StoredFile> all_files(const PlanetFile& planet) {
  std::vector<StoredFile> all;
  const auto add = [&](const std::vector<StoredFile>& files) {
    all.insert(all.end(), files.begin(), files.end());
  };
  for (const StoredLayer& layer : planet.layers) add(layer.files);
  for (const StoredInset& inset : planet.insets) std::for_each(inset.files.begin(), inset.files.end(), add);
  return all;
}

}  // namespace

std::vector<InsetFile> inset_files(const std::string& layer) {
  if (layer == "height")
    return {{"height", 1, "float32", 0}, {"weight", 1, "float32", 0}, {"relief", 1, "float32", 1}};
  if (layer == "color") return {{"color", 3, "uint8", 0}, {"weight", 1, "float32", 0}};
  return {};
}

bool is_inset_name(const std::string& name) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  };
  return !name.empty() && name.size() <= 64 && name.front() != '.' &&
         std::all_of(name.begin(), name.end(), allowed) && name != "data" && name != "filled" &&
         name != "synthesised";
}

PlanetFile read_planet_file(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kPlanetFileName;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw Error(folder.string(), "not a planet (no readable planet.json in it)",
                "give a folder made by globe convert, or procedural");
  }
  std::ostringstream text;
  text << stream.rdbuf();
  try {
    const ordered_json json = ordered_json::parse(text.str());
    require(json.is_object() && json.value("format", "") == kFormat,
            "it does not say \"format\": \"globe planet\"");
    const int version = json.at("version").get<int>();
    if (version > kFormatVersion) {
      throw Error(path.string(),
                  "format version " + std::to_string(version) + " is newer than this program's " +
                      std::to_string(kFormatVersion),
                  "use a newer globe");
    }
    return planet_from_json(json);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(path.string(), std::string("malformed (") + error.what() + ")", "convert the map again");
  }
}

namespace {

/// The digest of everything else.
std::string id_of(PlanetFile file) {
  file.info.id.clear();
  const std::string text = to_json(file).dump();
  return hex(XXH3_64bits(text.data(), text.size()));
}

std::string text_of(const PlanetFile& file) { return to_json(file).dump(2) + '\n'; }

}  // namespace

void write_planet_file(const std::filesystem::path& folder, PlanetFile file) {
  file.info.layers.clear();
  for (const StoredLayer& layer : file.layers) file.info.layers.push_back(layer.info);
  file.info.insets.clear();
  for (const StoredInset& inset : file.insets) file.info.insets.push_back(inset.info);
  file.info.id = id_of(file);
  const std::filesystem::path path = folder / kPlanetFileName;
  const std::filesystem::path temporary = folder / "planet.json.tmp";
  {
    std::ofstream stream(temporary, std::ios::binary);
    stream << text_of(file);
    if (!stream.flush())
      throw Error(temporary.string(), "cannot be written", "check the space left on the disk");
  }
  sync_to_disk(temporary);
  std::filesystem::rename(temporary, path);
  sync_to_disk(folder);
}

StoredFile describe_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  XXH3_state_t hash;
  XXH3_64bits_reset(&hash);
  StoredFile file{path.filename().string(), 0, 0};
  std::vector<char> block(std::size_t{1} << 20);
  while (stream) {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    const auto count = static_cast<std::size_t>(stream.gcount());
    XXH3_64bits_update(&hash, block.data(), count);
    file.bytes += count;
  }
  if (!stream.eof()) throw Error(path.string(), "cannot be read", "check that it exists and may be read");
  file.hash = XXH3_64bits_digest(&hash);
  return file;
}

void sync_to_disk(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = descriptor >= 0 && ::fsync(descriptor) == 0;
  if (descriptor >= 0) ::close(descriptor);
  if (!synced) throw Error(path.string(), "cannot be flushed to disk", "check the space left on the disk");
}

std::vector<std::string> find_damage(const std::filesystem::path& folder) {
  std::vector<std::string> damage;
  const PlanetFile planet = read_planet_file(folder);
  std::ifstream stream(folder / kPlanetFileName, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (id_of(planet) != planet.info.id || text_of(planet) != text)
    damage.push_back(std::string(kPlanetFileName) + ": not as it was written");
  for (const StoredFile& file : all_files(planet)) {
    try {
      const StoredFile found = describe_file(folder / file.name);
      if (found.bytes != file.bytes) {
        damage.push_back(file.name + ": " + std::to_string(found.bytes) + " bytes instead of " +
                         std::to_string(file.bytes));
      } else if (found.hash != file.hash) {
        damage.push_back(file.name + ": contents changed (checksum differs)");
      }
    } catch (const Error&) {
      damage.push_back(file.name + ": missing or unreadable");
    }
  }
  return damage;
}

}  // namespace globe::planet
