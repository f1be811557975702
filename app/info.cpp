#include "app/info.h"

#include <array>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/planet_argument.h"
#include "app/progress.h"
#include "globe/planet/dataset.h"
#include "globe/planet/planet_file.h"
#include "globe/planet/verify.h"

namespace app {
namespace {

using nlohmann::ordered_json;

using globe::planet::kBuiltinRelief_m;

constexpr std::size_t kVerifyCache = std::size_t{128} << 20;

struct InfoArguments {
  std::string planet;
  bool verify = false;
  bool json = false;
};

std::uint64_t bytes_of(const globe::planet::StoredLayer& layer) {
  std::uint64_t bytes = 0;
  for (const globe::planet::StoredFile& file : layer.files) bytes += file.bytes;
  return bytes;
}

/// Nodes of the finest level of a layer, in all four diamonds; those on borders count on both sides.
std::uint64_t nodes_of(const globe::planet::LayerInfo& layer) {
  const auto side = static_cast<std::uint64_t>(globe::planet::nodes_per_side(layer.level)) + 1;
  return globe::planet::kDiamonds * side * side;
}

std::uint64_t bytes_of(const globe::planet::StoredInset& inset) {
  std::uint64_t bytes = 0;
  for (const auto& block : inset.files)
    for (const globe::planet::StoredFile& file : block) bytes += file.bytes;
  return bytes;
}

/// Nodes in the blocks of an inset, at its level.
std::uint64_t nodes_of(const globe::planet::InsetInfo& inset) {
  std::uint64_t nodes = 0;
  for (const globe::planet::InsetBlock& block : inset.blocks) {
    nodes += static_cast<std::uint64_t>(block.i1 - block.i0 + 1) *
             static_cast<std::uint64_t>(block.j1 - block.j0 + 1);
  }
  return nodes;
}

/// Pixels of the map that is as fine along the equator: 4n x 2n.
double map_pixels_of(const globe::planet::LayerInfo& layer) {
  const double n = globe::planet::nodes_per_side(layer.level);
  return 8.0 * n * n;
}

/// Mean height of the planet, weighted by area, of the layer's level 0: eight trixels of equal area.
std::optional<double> mean_height(const std::string& planet) {
  const auto data = globe::planet::Dataset::open(planet, 0);
  if (data.layer("height_mean") == nullptr) return std::nullopt;
  double sum = 0;
  for (int d = 0; d < globe::planet::kDiamonds; ++d) {
    std::array<float, 2> means{};
    data.read("height_mean", d, 0, 0, 0, 1, 1, means.data());
    sum += static_cast<double>(means[0]) + static_cast<double>(means[1]);
  }
  return sum / (2.0 * globe::planet::kDiamonds);
}

ordered_json to_json(const globe::planet::PlanetFile& file, const std::optional<double>& mean_height_m) {
  const globe::planet::PlanetInfo& info = file.info;
  ordered_json layers = ordered_json::array();
  std::uint64_t bytes = 0;
  for (const globe::planet::StoredLayer& layer : file.layers) {
    const bool has_mean = layer.info.name == "height" && mean_height_m;
    layers.push_back(
        {{"name", layer.info.name},
         {"level", layer.info.level},
         {"channels", layer.info.channels},
         {"storage", layer.info.storage},
         {"min", layer.info.min},
         {"mean", has_mean ? ordered_json(*mean_height_m) : ordered_json()},
         {"max", layer.info.max},
         {"nodes", nodes_of(layer.info)},
         {"nodes_to_map_pixels", static_cast<double>(nodes_of(layer.info)) / map_pixels_of(layer.info)},
         {"bytes", bytes_of(layer)}});
    bytes += bytes_of(layer);
  }
  ordered_json insets = ordered_json::array();
  for (const globe::planet::StoredInset& inset : file.insets) {
    insets.push_back({{"name", inset.info.name},
                      {"layer", inset.info.layer},
                      {"level", inset.info.level},
                      {"min", inset.info.min},
                      {"max", inset.info.max},
                      {"nodes", nodes_of(inset.info)},
                      {"bytes", bytes_of(inset)}});
    bytes += bytes_of(inset);
  }
  return {{"name", info.name},
          {"body", info.body},
          {"id", info.id},
          {"ellipsoid", {{"a", info.ellipsoid.a}, {"f", info.ellipsoid.f}}},
          {"datum", info.vertical_datum},
          {"tile_size", info.tile_size},
          {"extent", {-180, -90, 180, 90}},
          {"bytes", bytes},
          {"layers", layers},
          {"insets", insets},
          {"credits", info.credits}};
}

std::string fixed(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", value);
  return text;
}

/// The layer that came from a map, beside a map as fine along the equator.
void print_samples(const ordered_json& layers) {
  for (const ordered_json& layer : layers) {
    const std::string name = layer["name"];
    if (name != "height" && name != "color") continue;
    const int n = globe::planet::nodes_per_side(layer["level"].get<int>());
    std::printf("samples    %s: %.0f nodes, %.4f of the %d x %d pixels of an equally fine map", name.c_str(),
                layer["nodes"].get<double>(), layer["nodes_to_map_pixels"].get<double>(), 4 * n, 2 * n);
    const double bytes = layer["bytes"].get<double>();
    if (bytes > 0.0)
      std::printf("; %.3f bytes a node on disk, coarser levels included",
                  bytes / layer["nodes"].get<double>());
    std::printf("\n");
  }
}

void print_text(const ordered_json& info) {
  const double f = info["ellipsoid"]["f"];
  const std::string flattening = f == 0.0 ? "0 (sphere)" : "1/" + std::to_string(1.0 / f);
  std::printf("name       %s\n", info["name"].get<std::string>().c_str());
  std::printf("body       %s\n", info["body"].get<std::string>().c_str());
  std::printf("id         %s\n", info["id"].get<std::string>().c_str());
  std::printf("ellipsoid  a %.3f m, f %s\n", info["ellipsoid"]["a"].get<double>(), flattening.c_str());
  std::printf("datum      %s\n", info["datum"].get<std::string>().c_str());
  std::printf("bytes      %llu\n", static_cast<unsigned long long>(info["bytes"].get<std::uint64_t>()));
  std::printf("%-14s %5s %8s %-8s %12s %12s %12s %14s %14s\n", "layer", "level", "channels", "storage", "min",
              "mean", "max", "nodes", "bytes");
  for (const ordered_json& layer : info["layers"]) {
    const std::string mean = layer["mean"].is_null() ? "-" : fixed(layer["mean"].get<double>());
    std::printf(
        "%-14s %5d %8d %-8s %12.3f %12s %12.3f %14.0f %14llu\n", layer["name"].get<std::string>().c_str(),
        layer["level"].get<int>(), layer["channels"].get<int>(), layer["storage"].get<std::string>().c_str(),
        layer["min"].get<double>(), mean.c_str(), layer["max"].get<double>(), layer["nodes"].get<double>(),
        static_cast<unsigned long long>(layer["bytes"].get<std::uint64_t>()));
  }
  for (const ordered_json& inset : info["insets"]) {
    std::printf("inset      %s: %s, level %d, %.3f to %.3f, %llu bytes\n",
                inset["name"].get<std::string>().c_str(), inset["layer"].get<std::string>().c_str(),
                inset["level"].get<int>(), inset["min"].get<double>(), inset["max"].get<double>(),
                static_cast<unsigned long long>(inset["bytes"].get<std::uint64_t>()));
  }
  print_samples(info["layers"]);
  for (const ordered_json& credit : info["credits"])
    std::printf("credit     %s\n", credit.get<std::string>().c_str());
}

/// The built-in planet as a planet file would describe it: one layer, computed, within the relief it
/// promises.
globe::planet::PlanetFile builtin_file(const std::string& planet) {
  const auto surface = open_planet(planet);
  globe::planet::PlanetFile file;
  file.info = surface->info();
  globe::planet::StoredLayer heights;
  heights.info = {"height", surface->data_level(), 1, "computed", -kBuiltinRelief_m, kBuiltinRelief_m};
  file.layers.push_back(heights);
  return file;
}

globe::planet::PlanetFile described(const std::string& planet) {
  if (procedural_seed(planet)) return builtin_file(planet);
  globe::planet::Dataset::open(planet, 0);  // every file whole, or one clear line
  return globe::planet::read_planet_file(planet);
}

/// What --verify finds; nothing can be wrong with a planet that is computed.
globe::planet::Verification verify(const InfoArguments& arguments) {
  if (procedural_seed(arguments.planet)) return {};
  Progress progress(progress_style(arguments.json, false));
  return globe::planet::verify_planet(
      arguments.planet, kVerifyCache,
      [&](const std::string& stage, double fraction) { progress.show(stage, fraction); });
}

void info(const InfoArguments& arguments, int& exit_status) {
  const globe::planet::PlanetFile file = described(arguments.planet);
  const bool computed = procedural_seed(arguments.planet).has_value();
  ordered_json json = to_json(file, computed ? std::nullopt : mean_height(arguments.planet));
  globe::planet::Verification found;
  if (arguments.verify) {
    found = verify(arguments);
    json["damage"] = found.damage;
    json["verified"] = {{"files", found.files}, {"nodes", found.nodes}};
    if (!found.damage.empty()) exit_status = 1;
  }
  if (arguments.json) {
    std::printf("%s\n", json.dump().c_str());
    return;
  }
  print_text(json);
  if (arguments.verify && computed) std::printf("verified   nothing is stored\n");
  if (arguments.verify && !computed && found.damage.empty()) {
    std::printf(
        "verified   %llu files are as they were written; %llu nodes of all layers and levels: finite, "
        "borders equal on both sides, coarse heights those of the finer level, ranges hold their cells\n",
        static_cast<unsigned long long>(found.files), static_cast<unsigned long long>(found.nodes));
  }
  for (const std::string& line : found.damage)
    std::fprintf(stderr, "globe: %s: %s; convert the map again\n", arguments.planet.c_str(), line.c_str());
}

}  // namespace

void add_info(CLI::App& program, int& exit_status) {
  const auto arguments = std::make_shared<InfoArguments>();
  CLI::App* command =
      program.add_subcommand("info", "What a planet is made of: ellipsoid, layers, ranges, credits");
  command->add_option("planet", arguments->planet, "folder made by globe convert, or procedural[:SEED]")
      ->required();
  command->add_flag("--verify", arguments->verify, "check every file and every sample");
  command->add_flag("--json", arguments->json, "one JSON object");
  command->callback([arguments, &exit_status] { info(*arguments, exit_status); });
}

}  // namespace app
