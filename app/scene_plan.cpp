#include "app/scene_plan.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace app {
namespace {

using nlohmann::ordered_json;

std::string height_text(double metres) {
  char text[32];
  if (std::isinf(metres)) return "any height";
  std::snprintf(text, sizeof text, metres >= 1e4 ? "%.3g km" : "%.3g m",
                metres >= 1e4 ? metres / 1e3 : metres);
  return text;
}

std::string stretches_text(const std::vector<Stretch>& stretches) {
  if (stretches.empty()) return "nowhere";
  std::string text;
  for (const Stretch& stretch : stretches) {
    if (!text.empty()) text += ", ";
    if (stretch.from_m == 0.0) {
      text += std::isinf(stretch.to_m) ? "at any height" : "up to " + height_text(stretch.to_m);
    } else {
      text += std::isinf(stretch.to_m) ? "from " + height_text(stretch.from_m) + " up"
                                       : height_text(stretch.from_m) + " to " + height_text(stretch.to_m);
    }
  }
  return text;
}

std::string bytes_text(std::size_t bytes) {
  char text[32];
  const auto size = static_cast<double>(bytes);
  std::snprintf(text, sizeof text,
                bytes < 10000      ? "%.0f B"
                : bytes < 10000000 ? "%.0f kB"
                                   : "%.0f MB",
                bytes < 10000      ? size
                : bytes < 10000000 ? size / 1e3
                                   : size / 1e6);
  return text;
}

ordered_json json_of(const Time& time) {
  return {{"median_ms", time.median}, {"low_ms", time.low}, {"high_ms", time.high}};
}

}  // namespace

std::string text_of(const Plan& plan) {
  char line[320];
  std::snprintf(line, sizeof line, "%s: %zu effect%s; camera at %.5f,%.5f, %s above ground, %dx%d, %s\n\n",
                plan.scene.c_str(), plan.effects.size(), plan.effects.size() == 1 ? "" : "s",
                plan.place.lat_deg, plan.place.lon_deg, height_text(plan.above_ground_m).c_str(),
                plan.size.width, plan.size.height, plan.renderer.c_str());
  std::string text = line;
  std::snprintf(line, sizeof line, "%-14s %-8s %-38s %-30s %8s %6s %8s %8s %14s\n", "effect", "asked by",
                "here", "active, above ground", "GPU", "passes", "ms on", "ms off", "cost, ms");
  text += line;
  double sum = 0;
  for (const PlannedEffect& effect : plan.effects) {
    const globe::render::EffectState& state = effect.state;
    const double cost = plan.all.median - effect.without->median;
    sum += cost;
    char passes[32], costs[64];
    std::snprintf(passes, sizeof passes, "%d%s", state.passes, state.in_shaders ? "+" : "");
    std::snprintf(costs, sizeof costs, "%.2f (%.2f to %.2f)", cost, plan.all.low - effect.without->high,
                  plan.all.high - effect.without->low);
    std::snprintf(line, sizeof line, "%-14s line %-3d %-38s %-30s %8s %6s %8.2f %8.2f %s\n",
                  state.name.c_str(), effect.line,
                  ((state.verdict.active ? "yes: " : "no: ") + state.verdict.why).c_str(),
                  stretches_text(effect.active).c_str(), bytes_text(state.gpu_bytes).c_str(), passes,
                  plan.all.median, effect.without->median, costs);
    text += line;
  }
  if (plan.region) {
    std::snprintf(
        line, sizeof line,
        "\nregion: %zu patches, %zu triangles in view, %s; %.2f ms with it (%.2f to %.2f), %.2f without "
        "(%.2f to %.2f)\n",
        plan.region->patches, plan.region->triangles, bytes_text(plan.region->gpu_bytes).c_str(),
        plan.region->with.median, plan.region->with.low, plan.region->with.high, plan.region->without.median,
        plan.region->without.low, plan.region->without.high);
    text += line;
  }
  if (plan.light_bytes > 0)
    text += "\nthe picture is drawn as light for the effects' passes: " + bytes_text(plan.light_bytes) + "\n";
  std::snprintf(
      line, sizeof line,
      "\nall %.2f ms (%.2f to %.2f), none %.2f ms (%.2f to %.2f): %.2f ms for all; the single costs add up "
      "to %.2f ms\n",
      plan.all.median, plan.all.low, plan.all.high, plan.none.median, plan.none.low, plan.none.high,
      plan.all.median - plan.none.median, sum);
  return text + line + "+: a part of it is in the programs of the ground and the sky\n";
}

std::string json_of(const Plan& plan) {
  ordered_json effects = ordered_json::array();
  for (const PlannedEffect& effect : plan.effects) {
    ordered_json active = ordered_json::array();
    for (const Stretch& stretch : effect.active)
      active.push_back({{"from_m", stretch.from_m},
                        {"to_m", std::isinf(stretch.to_m) ? ordered_json() : ordered_json(stretch.to_m)}});
    effects.push_back({{"effect", effect.state.name},
                       {"asked_by", plan.scene + ":" + std::to_string(effect.line)},
                       {"active", effect.state.verdict.active},
                       {"why", effect.state.verdict.why},
                       {"active_above_ground", std::move(active)},
                       {"gpu_bytes", effect.state.gpu_bytes},
                       {"passes", effect.state.passes},
                       {"in_shaders", effect.state.in_shaders},
                       {"on", json_of(plan.all)},
                       {"off", json_of(*effect.without)},
                       {"cost_ms", plan.all.median - effect.without->median}});
  }
  ordered_json region;
  if (plan.region) {
    region = {{"patches", plan.region->patches},
              {"triangles", plan.region->triangles},
              {"gpu_bytes", plan.region->gpu_bytes},
              {"on", json_of(plan.region->with)},
              {"off", json_of(plan.region->without)}};
  }
  const ordered_json object{{"scene", plan.scene},           {"renderer", plan.renderer},
                            {"lat", plan.place.lat_deg},     {"lon", plan.place.lon_deg},
                            {"alt_m", plan.place.h_m},       {"above_ground_m", plan.above_ground_m},
                            {"width", plan.size.width},      {"height", plan.size.height},
                            {"effects", std::move(effects)}, {"light_bytes", plan.light_bytes},
                            {"region", std::move(region)},   {"all", json_of(plan.all)},
                            {"none", json_of(plan.none)}};
  return object.dump(2) + "\n";
}

}  // namespace app
