#include "app/info.h"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "app/planet_argument.h"
#include "globe/base/error.h"
#include "globe/planet/dataset.h"
#include "globe/planet/planet_file.h"

namespace app {
namespace {

using nlohmann::ordered_json;

using globe::planet::kBuiltinRelief_m;

struct Arguments {
  std::string planet;
  bool verify = false;
  bool json = false;
};

std::uint64_t bytes_of(const globe::planet::StoredLayer& layer) {
  std::uint64_t bytes = 0;
  for (const globe::planet::StoredFile& file : layer.files) bytes += file.bytes;
  return bytes;
}

ordered_json to_json(const globe::planet::PlanetFile& file) {
  const globe::planet::PlanetInfo& info = file.info;
  ordered_json layers = ordered_json::array();
  std::uint64_t bytes = 0;
  for (const globe::planet::StoredLayer& layer : file.layers) {
    layers.push_back({{"name", layer.info.name},
                      {"level", layer.info.level},
                      {"channels", layer.info.channels},
                      {"storage", layer.info.storage},
                      {"min", layer.info.min},
                      {"max", layer.info.max},
                      {"bytes", bytes_of(layer)}});
    bytes += bytes_of(layer);
  }
  return {{"name", info.name},
          {"body", info.body},
          {"id", info.id},
          {"ellipsoid", {{"a", info.ellipsoid.a}, {"f", info.ellipsoid.f}}},
          {"datum", info.vertical_datum},
          {"tile_size", info.tile_size},
          {"bytes", bytes},
          {"layers", layers},
          {"credits", info.credits}};
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
  std::printf("%-14s %5s %8s %-8s %12s %12s %14s\n", "layer", "level", "channels", "storage", "min", "max",
              "bytes");
  for (const ordered_json& layer : info["layers"]) {
    std::printf("%-14s %5d %8d %-8s %12.3f %12.3f %14llu\n", layer["name"].get<std::string>().c_str(),
                layer["level"].get<int>(), layer["channels"].get<int>(),
                layer["storage"].get<std::string>().c_str(), layer["min"].get<double>(),
                layer["max"].get<double>(),
                static_cast<unsigned long long>(layer["bytes"].get<std::uint64_t>()));
  }
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

void info(const Arguments& arguments, int& exit_status) {
  ordered_json json = to_json(described(arguments.planet));
  if (arguments.verify && procedural_seed(arguments.planet)) {
    json["damage"] = ordered_json::array();
  } else if (arguments.verify) {
    json["damage"] = globe::planet::find_damage(arguments.planet);
    if (!json["damage"].empty()) exit_status = 1;
  }
  if (arguments.json) {
    std::printf("%s\n", json.dump().c_str());
  } else {
    print_text(json);
    if (arguments.verify && exit_status == 0) std::printf("verified   every file is as it was written\n");
  }
  if (!arguments.verify || arguments.json) return;
  for (const ordered_json& line : json["damage"]) {
    std::fprintf(stderr, "globe: %s: %s; convert the map again\n", arguments.planet.c_str(),
                 line.get<std::string>().c_str());
  }
}

}  // namespace

void add_info(CLI::App& program, int& exit_status) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      program.add_subcommand("info", "What a planet is made of: ellipsoid, layers, ranges, credits");
  command->add_option("planet", arguments->planet, "folder made by globe convert, or procedural[:SEED]")
      ->required();
  command->add_flag("--verify", arguments->verify, "compare every file with its checksum");
  command->add_flag("--json", arguments->json, "one JSON object");
  command->callback([arguments, &exit_status] { info(*arguments, exit_status); });
}

}  // namespace app
