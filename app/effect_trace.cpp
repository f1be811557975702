#include "app/effect_trace.h"

#include <nlohmann/json.hpp>

#include "globe/base/text_file.h"

namespace app {

void EffectTrace::add(const Moment& moment, const std::vector<globe::render::EffectState>& states) {
  active_frames_.resize(states.size());
  for (std::size_t k = 0; k < states.size(); ++k) {
    active_frames_[k] += states[k].verdict.active ? 1 : 0;
    const bool changed = frames_ == 0 || states[k].verdict.active != last_[k].verdict.active ||
                         states[k].verdict.why != last_[k].verdict.why;
    if (changed) events_.push_back({moment, states[k]});
  }
  last_ = states;
  ++frames_;
}

void EffectTrace::write(const std::string& path) const {
  using nlohmann::ordered_json;
  ordered_json events = ordered_json::array(), effects = ordered_json::array();
  for (const Event& event : events_)
    events.push_back({{"frame", event.moment.frame},
                      {"time_s", event.moment.time_s},
                      {"lat", event.moment.place.lat_deg},
                      {"lon", event.moment.place.lon_deg},
                      {"alt_m", event.moment.place.h_m},
                      {"above_ground_m", event.moment.above_ground_m},
                      {"effect", event.state.name},
                      {"active", event.state.verdict.active},
                      {"why", event.state.verdict.why},
                      {"gpu_bytes", event.state.gpu_bytes}});
  for (std::size_t k = 0; k < last_.size(); ++k)
    effects.push_back(
        {{"effect", last_[k].name}, {"frames_active", active_frames_[k]}, {"gpu_bytes", last_[k].gpu_bytes}});
  const ordered_json document{
      {"frames", frames_}, {"effects", std::move(effects)}, {"events", std::move(events)}};
  globe::write_text_file(path, document.dump(1) + "\n", true);
}

}  // namespace app
