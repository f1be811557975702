#include "app/view/viewer.h"

#include <epoxy/gl.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <deque>
#include <set>
#include <variant>

#include "app/frame_budget.h"
#include "app/frame_clock.h"
#include "app/view/hands.h"
#include "app/view/overlay.h"
#include "app/view/panels/list.h"
#include "app/view/process_age.h"

namespace app::view {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kFastest = 1.0 / 60.0;  ///< seconds to a frame at least
constexpr double kIdle = 0.5;            ///< seconds that it sleeps at most
constexpr double kLongestStep = 0.1;     ///< seconds that may pass for the camera in a frame
constexpr int kSettling = 3;             ///< frames that widgets take to answer
constexpr float kWidth = 330.0f;         ///< of the overlay, in units of its text
constexpr double kHigh = 2.0;            ///< radii above ground

double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

void draw_notice(const Session& session) {
  if (session.notice().empty()) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * size.x, size.y - 24.0f}, ImGuiCond_Always, {0.5f, 1.0f});
  ImGui::Begin("##notice", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::TextUnformatted(session.notice().c_str());
  ImGui::End();
}

void draw_panels(Session& session) {
  const float scale = session.window.content_scale();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({10.0f * scale, 10.0f * scale}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSizeConstraints({kWidth * scale, 0.0f}, {kWidth * scale, size.y - 20.0f * scale});
  ImGui::Begin("globe", nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse);
  for (const Panel& panel : panels()) {
    const ImGuiTreeNodeFlags flags = panel.is_open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : 0;
    if (ImGui::CollapsingHeader(panel.title, flags)) panel.draw(session);
  }
  ImGui::End();
  draw_marks(session);
}

/// The first picture, as soon as there can be one. What is seen from high above takes little to load, and the
/// rest comes over the frames that follow; effects take longer to make.
void show_beginning(Session& session) {
  Standpoint high = session.navigator.stand();
  high.place.h_m = std::max(high.place.h_m, kHigh * session.scenery.ellipsoid().mean_radius());
  const auto draw = [&](const globe::render::Camera& camera, bool wait) {
    session.canvas.draw(session.scenery, camera, session.sunlight(), session.moment_s, wait, 0.0);
  };
  draw(session.navigator.eye().camera(high), true);
  if (high.place.h_m != session.navigator.stand().place.h_m) draw(session.navigator.camera(), false);
  session.window.show(session.canvas.picture().resolved_id(), session.canvas.size());
  session.window.swap();
}

class Loop {
 public:
  explicit Loop(Session& session)
      : session_(session),
        overlay_(Overlay::start(session.window)),
        hands_(
            session,
            [this](glm::dvec2 pixel) {
              return shows_widgets() && overlay_->has_pointer(session_.window, pixel);
            },
            [this] { return shows_widgets() && overlay_->has_keyboard(); }),
        clock_(std::chrono::duration<double>(kFastest)) {
    if (!overlay_) std::fputs("globe: warning: no overlay: Dear ImGui finds no libGL here\n", stderr);
  }

  WindowRun run(std::optional<int> frames) {
    scripted_ = frames.has_value();
    show_beginning(session_);
    const double first_picture_s = process_age_s();
    session_.scenery.complete();
    while (!session_.closes && !session_.window.close_requested()) {
      if (frames && drawn_ >= static_cast<std::size_t>(*frames)) break;
      const bool busy = frames || is_busy();
      if (busy) {
        session_.window.poll();
      } else {
        session_.window.wait(kIdle);
      }
      const bool happened = take_events();
      if (!adopt_size() || (!busy && !happened && !is_busy())) {
        last_ = Clock::now();
        continue;
      }
      if (!frames) clock_.await_turn();
      frame();
    }
    if (session_.recorder) session_.toggle_recording();
    return {drawn_, first_picture_s};
  }

 private:
  bool shows_widgets() const { return overlay_ && (session_.shows_overlay || !session_.notice().empty()); }

  /// As many events as a frame may show: what went down in it goes up in the next, or widgets would miss it.
  bool take_events() {
    for (const globe::gl::WindowEvent& event : session_.window.take_events()) waiting_.push_back(event);
    if (waiting_.empty()) return false;
    settling_ = kSettling;
    std::set<int> pressed;
    while (!waiting_.empty()) {
      const globe::gl::WindowEvent& event = waiting_.front();
      if (const auto* key = std::get_if<globe::gl::KeyChanged>(&event)) {
        if (key->down) pressed.insert(key->key);
        if (!key->down && pressed.count(key->key) > 0) break;
      } else if (const auto* button = std::get_if<globe::gl::ButtonChanged>(&event)) {
        const int number = -1 - static_cast<int>(button->button);  // beside those of keys
        if (button->down) pressed.insert(number);
        if (!button->down && pressed.count(number) > 0) break;
      }
      if (overlay_) overlay_->hear(session_.window, event);
      hands_.take(event);
      waiting_.pop_front();
    }
    return true;
  }

  bool is_busy() const {
    const bool animated = session_.running && (session_.on_path || session_.scenery.is_animated());
    return settling_ > 0 || drawn_ == 0 || session_.navigator.is_moving() || session_.navigator.is_held() ||
           !session_.figures.last().complete || animated || session_.recorder || !session_.notice().empty();
  }

  /// False while there is nothing to draw into.
  bool adopt_size() {
    const glm::ivec2 size = session_.window.size();
    if (size.x <= 0 || size.y <= 0) {
      session_.window.wait(kIdle);
      return false;
    }
    if (size == session_.canvas.size()) return true;
    if (session_.recorder) session_.toggle_recording();
    session_.canvas = Canvas(size, session_.scenery.options().samples);
    session_.navigator.resize(glm::dvec2(size));
    settling_ = kSettling;
    return true;
  }

  void frame() {
    const Clock::time_point now = Clock::now();
    const double real = seconds_between(last_, now);
    const double step = scripted_ ? kFastest : std::min(real, kLongestStep);
    last_ = now;
    hands_.drive();
    session_.pass(step, real);
    session_.navigator.advance(step);
    const globe::render::FrameStats stats =
        session_.canvas.draw(session_.scenery, session_.navigator.camera(), session_.sunlight(),
                             session_.moment_s, false, budget_.uploads_ms());
    session_.window.show(session_.canvas.picture().resolved_id(), session_.canvas.size());
    glFinish();
    const double took_ms = 1000.0 * seconds_between(now, Clock::now());
    budget_.note(took_ms, stats.upload_ms);
    session_.figures.add(took_ms, stats);
    if (session_.recorder) session_.recorder->show(session_.canvas.picture(), session_.real_s());
    if (shows_widgets()) draw_widgets();
    session_.window.swap();
    tell_loading(!stats.complete || session_.navigator.is_moving());
    settling_ = std::max(settling_ - 1, 0);
    ++drawn_;
  }

  /// The title says whether the picture will still change by itself.
  void tell_loading(bool loading) {
    if (loading == told_loading_) return;
    told_loading_ = loading;
    session_.window.set_title(session_.title + (loading ? " (loading)" : ""));
  }

  void draw_widgets() {
    session_.pointed = session_.shows_overlay ? session_.canvas.seen_at(session_.pointer) : std::nullopt;
    overlay_->begin();
    if (session_.shows_overlay) draw_panels(session_);
    draw_notice(session_);
    overlay_->end(session_.window);
  }

  Session& session_;
  std::unique_ptr<Overlay> overlay_;
  Hands hands_;
  FrameClock clock_;
  FrameBudget budget_{std::nullopt};
  Clock::time_point last_ = Clock::now();
  int settling_ = kSettling;
  std::deque<globe::gl::WindowEvent> waiting_;
  std::size_t drawn_ = 0;
  bool told_loading_ = true;
  bool scripted_ = false;  ///< each frame is a step of the same length
};

}  // namespace

WindowRun run_window(Session& session, std::optional<int> frames) { return Loop(session).run(frames); }

}  // namespace app::view
