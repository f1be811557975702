#include "app/view/navigator.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "app/flight.h"
#include "app/view/motion.h"
#include "globe/base/angles.h"

namespace app::view {
namespace {

namespace geo = globe::geo;
using glm::dvec2;
using glm::dvec3;
using globe::kDegree;

constexpr double kNotch = 0.8;           ///< of the distance, to a notch of the wheel
constexpr double kZoomTime = 0.07;       ///< seconds in which a wheel's turn is followed up to 1/e
constexpr double kZoomRest = 0.02;       ///< notches that are not spun out further
constexpr double kRollTime = 0.45;       ///< seconds in which a roll slows down to 1/e
constexpr double kPushTime = 0.1;        ///< seconds of a drag that count for its speed
constexpr double kStillTime = 0.06;      ///< seconds without a move after which nothing rolls on
constexpr double kFarthest = 10.0;       ///< planet's radii above it
constexpr double kSkyWay = 4.0;          ///< heights above ground to what stands for the sky
constexpr double kSwingDegrees = 180.0;  ///< to a picture's height
constexpr double kDoubleClick = 0.25;    ///< of the way is left

}  // namespace

Navigator::Navigator(const Eye& eye, World world, const Standpoint& start)
    : eye_(eye), world_(std::move(world)), stand_(start) {
  keep_clear();
}

double Navigator::above() const {
  return world_.height_above_ground(geo::ecef_from_geodetic(eye_.ellipsoid, stand_.place));
}

void Navigator::keep_clear() { keep_clear_of(world_.height_above_ground); }

void Navigator::keep_clear_of(const std::function<double(const dvec3&)>& height_above_ground) {
  stand_.place.h_m = std::min(stand_.place.h_m, kFarthest * eye_.ellipsoid.mean_radius());
  const double least = least_clearance(eye_.ellipsoid);
  // Where the ground is steep, once is not enough: the height above it is along the normal.
  for (int k = 0; k < 3; ++k) {
    const double low = height_above_ground(geo::ecef_from_geodetic(eye_.ellipsoid, stand_.place));
    if (low >= least) return;
    stand_.place.h_m += least - low;
  }
}

void Navigator::stop() {
  stand_.look.roll_deg = 0.0;
  rolling_ = dvec3(0.0);
  zooming_ = {};
  glide_.reset();
}

void Navigator::jump_to(const Standpoint& stand) {
  stop();
  stand_ = stand;
  keep_clear();
}

void Navigator::fly_to(const Standpoint& to) {
  stop();
  Standpoint end = to;
  const double low = world_.height_above_ground(geo::ecef_from_geodetic(eye_.ellipsoid, to.place));
  const double least = least_clearance(eye_.ellipsoid);
  if (low < least) end.place.h_m += least - low;
  glide_.emplace(eye_.ellipsoid, stand_, above(), end, std::max(low, least));
  glided_s_ = 0.0;
}

void Navigator::look_at(const dvec3& place, double distance_m, double heading_deg, double pitch_deg) {
  const geo::Geodetic foot = geo::geodetic_from_ecef(eye_.ellipsoid, place);
  const geo::LocalFrame frame = geo::local_frame(foot.lat_deg, foot.lon_deg);
  const dvec3 ahead = geo::look_direction(frame, heading_deg, pitch_deg);
  Standpoint to{geo::geodetic_from_ecef(eye_.ellipsoid, place - distance_m * ahead),
                {heading_deg, pitch_deg, 0.0}};
  if (pitch_deg > -89.9) to.look = aimed(eye_, to, ahead, 0.5 * eye_.size);
  fly_to(to);
}

dvec3 Navigator::place_at(dvec2 pixel) const {
  if (const auto seen = world_.seen_at(pixel)) return *seen;
  const globe::render::Camera at = camera();
  const double way = kSkyWay * std::max(above(), least_clearance(eye_.ellipsoid));
  return at.position + way * eye_.direction(at, pixel);
}

void Navigator::press(Grip grip, dvec2 pixel, double time_s) {
  stop();
  const dvec2 anchor = grip == Grip::kSwing ? 0.5 * eye_.size : pixel;
  held_ = Held{grip, grip == Grip::kLook ? std::nullopt : world_.seen_at(anchor), pixel};
  pushes_.assign({{time_s, dvec3(0.0)}});
}

void Navigator::move(dvec2 pixel, double time_s) {
  if (!held_ || pixel == held_->pixel) return;
  hold(*held_, pixel, time_s);
  held_->pixel = pixel;
  keep_clear();
}

void Navigator::hold(const Held& held, dvec2 pixel, double time_s) {
  const dvec2 by = pixel - held.pixel;
  if (!held.place) {
    // The sky goes with the pointer.
    const double to_degrees = eye_.fov_deg / eye_.size.y;
    const double spread = std::max(std::cos(stand_.look.pitch_deg * kDegree), 0.2);
    stand_ = turned(stand_, {-by.x * to_degrees / spread, by.y * to_degrees});
    return;
  }
  if (held.grip == Grip::kSwing) {
    const double to_degrees = kSwingDegrees / eye_.size.y;
    stand_ = swung(eye_, stand_, *held.place, 0.5 * eye_.size, by * to_degrees);
    return;
  }
  const auto turn = turn_to_hold(eye_, stand_, *held.place, pixel);
  if (!turn) return;
  stand_ = carried(eye_.ellipsoid, stand_, *turn);
  pushes_.push_back({time_s, *turn});
  while (pushes_.size() > 1 && pushes_.front().time_s < time_s - kPushTime) pushes_.pop_front();
  const double before = stand_.place.h_m;
  keep_clear();  // over rising ground the place is held from higher up
  if (stand_.place.h_m == before) return;
  if (const auto again = turn_to_hold(eye_, stand_, *held.place, pixel))
    stand_ = carried(eye_.ellipsoid, stand_, *again);
}

void Navigator::release(double time_s) {
  if (!held_) return;
  const bool grabbed = held_->grip == Grip::kGrab && held_->place;
  held_.reset();
  if (!grabbed || pushes_.size() < 2 || time_s - pushes_.back().time_s > kStillTime) return;
  dvec3 turn{0.0};
  for (std::size_t k = 1; k < pushes_.size(); ++k) turn += pushes_[k].turn;
  rolling_ = turn / std::max(pushes_.back().time_s - pushes_.front().time_s, 1e-3);
}

void Navigator::zoom(double notches, dvec2 pixel) {
  stand_.look.roll_deg = 0.0;
  glide_.reset();
  rolling_ = dvec3(0.0);
  // A wheel that goes on over one pixel keeps the place: what is seen there is drawn anew meanwhile.
  if (zooming_.notches == 0.0 || glm::distance(zooming_.pixel, pixel) > 1.0) {
    zooming_.pixel = pixel;
    zooming_.place = place_at(pixel);
  }
  zooming_.notches += notches;
}

void Navigator::zoom_by(double notches) {
  const double way = glm::distance(geo::ecef_from_geodetic(eye_.ellipsoid, stand_.place), zooming_.place);
  const double factor =
      std::max(std::pow(kNotch, notches), std::min(1.0, 2.0 * least_clearance(eye_.ellipsoid) / way));
  const double high = stand_.place.h_m + (factor - 1.0) * way;
  if (factor > 1.0 && high > kFarthest * eye_.ellipsoid.mean_radius()) {
    zooming_ = {};
    return;
  }
  stand_ = approached(eye_, stand_, zooming_.place, zooming_.pixel, factor);
}

void Navigator::double_click(dvec2 pixel) {
  const auto place = world_.seen_at(pixel);
  if (!place) return;
  const dvec3 position = geo::ecef_from_geodetic(eye_.ellipsoid, stand_.place);
  Standpoint to{geo::geodetic_from_ecef(eye_.ellipsoid, *place + kDoubleClick * (position - *place)),
                stand_.look};
  if (stand_.look.pitch_deg > -89.9) {
    to.look = aimed(eye_, to, *place - geo::ecef_from_geodetic(eye_.ellipsoid, to.place), 0.5 * eye_.size);
  } else {
    const double high = to.place.h_m;
    to.place = geo::geodetic_from_ecef(eye_.ellipsoid, *place);
    to.place.h_m = high;
  }
  fly_to(to);
}

void Navigator::drive(const Drive& drive) {
  if (!drive.is_idle()) stop();
  drive_ = drive;
}

void Navigator::roll(double seconds) {
  // What a speed that fades exponentially covers.
  const double covered = kRollTime * (1.0 - std::exp(-seconds / kRollTime));
  stand_ = carried(eye_.ellipsoid, stand_, covered * rolling_);
  rolling_ *= std::exp(-seconds / kRollTime);
  // Until it is a pixel a second or so.
  const double speed = glm::length(rolling_) * eye_.ellipsoid.a;
  if (speed * eye_.size.y < eye_.fov_deg * kDegree * above()) rolling_ = dvec3(0.0);
}

void Navigator::go(double seconds) {
  const double height = std::max(above(), least_clearance(eye_.ellipsoid));
  stand_ = turned(stand_, kTurn * seconds * drive_.turn);
  stand_.place.h_m += height * std::expm1(drive_.go.z * seconds);
  const geo::LocalFrame frame = geo::local_frame(stand_.place.lat_deg, stand_.place.lon_deg);
  const dvec3 ahead = geo::look_direction(frame, stand_.look.heading_deg, 0.0);
  const dvec3 right = glm::cross(ahead, frame.up);
  const double speed = std::min(height, eye_.ellipsoid.mean_radius()) / eye_.ellipsoid.mean_radius();
  const dvec3 along = speed * seconds * (drive_.go.x * ahead + drive_.go.y * right);
  if (along != dvec3(0.0)) stand_ = carried(eye_.ellipsoid, stand_, glm::cross(frame.up, along));
}

bool Navigator::is_moving() const {
  return glide_ || zooming_.notches != 0.0 || rolling_ != dvec3(0.0) || !drive_.is_idle();
}

bool Navigator::advance(double seconds) {
  if (!is_moving()) return false;
  if (glide_) {
    glided_s_ += seconds;
    stand_ = glide_->at(glided_s_);
    if (glided_s_ >= glide_->duration_s()) glide_.reset();
  }
  if (rolling_ != dvec3(0.0)) roll(seconds);
  if (zooming_.notches != 0.0) {
    const double rest = zooming_.notches * std::exp(-seconds / kZoomTime);
    const double now = std::abs(rest) < kZoomRest ? zooming_.notches : zooming_.notches - rest;
    const double left = zooming_.notches - now;
    zoom_by(now);
    if (zooming_.notches != 0.0) zooming_.notches = left;
  }
  if (!drive_.is_idle()) go(seconds);
  keep_clear();
  return true;
}

}  // namespace app::view
