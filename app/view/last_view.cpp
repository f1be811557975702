#include "app/view/last_view.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "globe/base/error.h"
#include "globe/base/pending_file.h"

namespace app::view {
namespace {

using nlohmann::json;

/// An object without anything where the file is missing or damaged.
json read_views(const std::filesystem::path& file) {
  std::ifstream stream(file);
  json views = json::parse(stream, nullptr, false);
  return views.is_object() ? views : json::object();
}

}  // namespace

std::optional<std::filesystem::path> views_file() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state == '/')
    return std::filesystem::path(state) / "globe" / "views.json";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/')
    return std::filesystem::path(home) / ".local" / "state" / "globe" / "views.json";
  return std::nullopt;
}

std::optional<LastView> recall_view(const std::filesystem::path& file, const std::string& name) {
  const json views = read_views(file);
  const auto found = views.find(name);
  if (found == views.end() || !found->is_object()) return std::nullopt;
  const auto number = [&](const char* key) {
    const auto value = found->find(key);
    return value != found->end() && value->is_number() ? value->get<double>() : NAN;
  };
  const auto text = [&](const char* key) {
    const auto value = found->find(key);
    return value != found->end() && value->is_string() ? value->get<std::string>() : std::string();
  };
  LastView view{{{number("lat"), number("lon"), number("alt_m")}, {number("heading"), number("pitch"), 0.0}},
                number("moment_s"),
                text("time"),
                text("sun")};
  const Standpoint& stand = view.stand;
  const bool sane = std::abs(stand.place.lat_deg) <= 90.0 && std::abs(stand.place.lon_deg) <= 180.0 &&
                    std::isfinite(stand.place.h_m) && std::abs(stand.look.pitch_deg) <= 90.0 &&
                    std::isfinite(stand.look.heading_deg) && view.moment_s >= 0.0;
  if (!sane) return std::nullopt;
  return view;
}

void remember_view(const std::filesystem::path& file, const std::string& name, const LastView& view) {
  std::error_code failed;
  std::filesystem::create_directories(file.parent_path(), failed);
  if (failed) throw globe::Error(file.parent_path().string(), failed.message(), "make that folder");
  json views = read_views(file);
  views[name] = {{"lat", view.stand.place.lat_deg},
                 {"lon", view.stand.place.lon_deg},
                 {"alt_m", view.stand.place.h_m},
                 {"heading", view.stand.look.heading_deg},
                 {"pitch", view.stand.look.pitch_deg},
                 {"moment_s", view.moment_s},
                 {"time", view.time},
                 {"sun", view.overhead}};
  globe::PendingFile pending(file, true);
  std::ofstream stream(pending.temporary());
  stream << views.dump(1) << '\n';
  stream.close();
  if (!stream) throw globe::Error(file.string(), "could not be written", "is the disk full?");
  pending.publish();
}

}  // namespace app::view
