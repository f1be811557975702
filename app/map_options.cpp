#include "app/map_options.h"

#include <functional>
#include <optional>

#include "app/parse_options.h"
#include "globe/base/error.h"

namespace app {
namespace {

/// Gives maps what an option says of them: once, it is for all height maps (for all color maps when there are
/// no height maps); twice, when there are both, for the height maps, then for the color maps; or it comes
/// once for each map, height maps first. "auto" leaves a map to its file.
template <typename T, typename Parse>
void assign(const std::vector<std::string>& texts, const std::string& option,
            std::optional<T> converters::MapInput::*member, std::vector<converters::MapInput>& heights,
            std::vector<converters::MapInput>& colors, const Parse& parse) {
  const std::size_t maps = heights.size() + colors.size();
  const bool by_kind = texts.size() == 2 && !heights.empty() && !colors.empty();
  if (texts.size() > 1 && texts.size() != maps && !by_kind) {
    throw globe::UsageError(
        option, "given " + std::to_string(texts.size()) + " times for " + std::to_string(maps) + " maps",
        "give it once, once for heights and once for colors, or once for each map, heights first");
  }
  const auto set = [&](converters::MapInput& map, const std::string& text) {
    if (text != "auto") map.*member = parse(text);
  };
  for (std::size_t k = 0; k < maps && !texts.empty(); ++k) {
    const bool is_height = k < heights.size();
    converters::MapInput& map = is_height ? heights[k] : colors[k - heights.size()];
    if (texts.size() == maps) {
      set(map, texts[k]);
    } else if (texts.size() == 2) {
      set(map, texts[is_height ? 0 : 1]);
    } else if (is_height || heights.empty()) {
      set(map, texts.front());
    }
  }
}

/// Reads the number of an option; `example` is one.
std::function<double(const std::string&)> number_for(const std::string& option, const std::string& example) {
  return [=](const std::string& text) {
    const std::optional<double> number = parse_number(text);
    if (number) return *number;
    throw globe::UsageError(option, "'" + text + "' is not a number", "give a value such as " + example);
  };
}

}  // namespace

void add_map_options(CLI::App& command, MapOptions& options) {
  const auto of_maps = [&](const char* name, std::vector<std::string>& texts, const std::string& help) {
    return command.add_option(name, texts, help)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->delimiter('\0')
        ->group(
            "Of maps (once for all height maps, again for color maps; or once for each; auto: as the file "
            "says)");
  };
  of_maps("--extent", options.extents, "W,S,E,N in degrees");
  of_maps("--registration", options.registrations, "whether coordinates mean edges or samples")
      ->check(CLI::IsMember({"area", "point", "auto"}));
  of_maps("--crs", options.systems, "coordinate reference system: EPSG:32610, or a text of PROJ or WKT");
  of_maps("--nodata", options.nodata, "raw value that means no data");
  of_maps("--scale", options.scales, "of heights: raw * scale + offset");
  of_maps("--offset", options.offsets, "in the unit of --units");
  of_maps("--units", options.units, "of heights")->check(CLI::IsMember({"m", "ft", "us-ft", "auto"}));
}

void apply_map_options(const MapOptions& options, std::vector<converters::MapInput>& heights,
                       std::vector<converters::MapInput>& colors) {
  using converters::MapInput;
  const auto as_it_is = [](const std::string& text) { return text; };
  assign(options.extents, "--extent", &MapInput::extent, heights, colors, parse_extent);
  assign(options.registrations, "--registration", &MapInput::registration, heights, colors,
         [](const std::string& text) {
           return text == "area" ? converters::Registration::kArea : converters::Registration::kPoint;
         });
  assign(options.systems, "--crs", &MapInput::crs, heights, colors, as_it_is);
  assign(options.units, "--units", &MapInput::unit, heights, colors, as_it_is);
  assign(options.scales, "--scale", &MapInput::scale, heights, colors, number_for("--scale", "0.1"));
  assign(options.offsets, "--offset", &MapInput::offset, heights, colors, number_for("--offset", "-10000"));
  assign(options.nodata, "--nodata", &MapInput::nodata, heights, colors,
         number_for("--nodata", "-9999 or nan"));
}

std::vector<converters::MapInput> maps_of(const std::vector<std::string>& paths) {
  std::vector<converters::MapInput> maps;
  for (const std::string& path : paths) maps.push_back({path});
  return maps;
}

}  // namespace app
