#include "converters/raster_projection.h"

#include <gdal_alg.h>
#include <gdal_priv.h>
#include <proj.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>
#include <numbers>
#include <utility>
#include <vector>

#include "converters/use_gdal.h"
#include "globe/base/angles.h"
#include "globe/base/error.h"

namespace converters {
namespace {

using globe::kDegree;
using globe::geo::dvec3;

constexpr int kGridSide = 17;              ///< places of a raster that tell where it lies
constexpr double kEqualDegrees = 1e-9;     ///< coordinates that are longitudes and latitudes as they stand
constexpr double kStraightSamples = 1e-4;  ///< how straight parallels and meridians are in a plain map

struct DestroyContext {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
struct DestroyOperation {
  void operator()(PJ* operation) const { proj_destroy(operation); }
};
using Context = std::unique_ptr<PJ_CONTEXT, DestroyContext>;
using Operation = std::unique_ptr<PJ, DestroyOperation>;

Context new_context() {
  Context context(proj_context_create());
  proj_context_set_enable_network(context.get(), 0);
  proj_log_level(context.get(), PJ_LOG_NONE);
  return context;
}

/// Columns and rows, from the outer corner of the first sample, to coordinates and back; one thread at a
/// time.
class Grid {
 public:
  Grid(const std::string& path, const Georeference& reference) {
    if (reference.transform) {
      transform_ = *reference.transform;
      std::array<double, 6> inverse{};
      if (!GDALInvGeoTransform(transform_.data(), inverse.data()))
        throw globe::Error(path, "its georeferencing has no inverse", "give its --extent W,S,E,N");
      inverse_ = inverse;
      return;
    }
    dataset_ = open_dataset(path, 1);
    CPLStringList options;
    options.SetNameValue("METHOD",
                         dataset_ && dataset_->GetGCPCount() > 0 ? "GCP_POLYNOMIAL" : "GEOLOC_ARRAY");
    points_ = dataset_ ? GDALCreateGenImgProjTransformer2(GDALDataset::ToHandle(dataset_.get()), nullptr,
                                                          options.List())
                       : nullptr;
    if (points_ == nullptr)
      throw globe::Error(path, "its control points are of no use (" + first_failure() + ")",
                         "give its --extent W,S,E,N");
  }
  ~Grid() {
    if (points_ != nullptr) GDALDestroyGenImgProjTransformer(points_);
  }
  Grid(const Grid&) = delete;
  Grid& operator=(const Grid&) = delete;

  /// In place; HUGE_VAL where there is nothing.
  void to_coordinates(std::vector<double>& x, std::vector<double>& y) const {
    if (points_ != nullptr) return by_points(FALSE, x, y);
    apply(transform_, x, y);
  }
  void to_samples(std::vector<double>& x, std::vector<double>& y) const {
    if (points_ != nullptr) return by_points(TRUE, x, y);
    apply(inverse_, x, y);
  }

 private:
  static void apply(const std::array<double, 6>& t, std::vector<double>& x, std::vector<double>& y) {
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double a = x[k], b = y[k];
      x[k] = t[0] + (t[1] * a + t[2] * b);
      y[k] = t[3] + (t[4] * a + t[5] * b);
    }
  }
  void by_points(int backwards, std::vector<double>& x, std::vector<double>& y) const {
    std::vector<double> z(x.size(), 0.0);
    std::vector<int> good(x.size(), FALSE);
    GDALGenImgProjTransform(points_, backwards, static_cast<int>(x.size()), x.data(), y.data(), z.data(),
                            good.data());
    for (std::size_t k = 0; k < x.size(); ++k) {
      if (good[k] == FALSE) x[k] = y[k] = HUGE_VAL;
    }
  }

  std::array<double, 6> transform_{}, inverse_{};
  DatasetHandle dataset_;
  void* points_ = nullptr;
};

/// What one thread needs.
struct Worker {
  Context context = new_context();
  Operation operation;  ///< coordinates to degrees east and north; null: they are that
  std::unique_ptr<Grid> grid;

  /// In place, HUGE_VAL where there is nothing.
  void transform(PJ_DIRECTION direction, std::vector<double>& x, std::vector<double>& y) const {
    if (!operation) return;
    constexpr std::size_t kStep = sizeof(double);
    proj_errno_reset(operation.get());
    proj_trans_generic(operation.get(), direction, x.data(), kStep, x.size(), y.data(), kStep, y.size(),
                       nullptr, 0, 0, nullptr, 0, 0);
  }
};

bool is_number(double value) { return std::isfinite(value) && std::abs(value) < 1e30; }

double semi_major_axis(PJ_CONTEXT* context, const PJ* crs) {
  const Operation ellipsoid(proj_get_ellipsoid(context, crs));
  double a = 0;
  if (ellipsoid) proj_ellipsoid_get_parameters(context, ellipsoid.get(), &a, nullptr, nullptr, nullptr);
  return a;
}

bool is_on_a_planet(PJ_TYPE type) {
  return type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS ||
         type == PJ_TYPE_PROJECTED_CRS || type == PJ_TYPE_BOUND_CRS;
}

}  // namespace

struct RasterProjection::State {
  std::string path;
  int width, height;
  Georeference reference;
  PlanetFrame frame;
  std::string pipeline;        ///< of the operation; "" when coordinates are degrees east and north
  bool is_geographic = false;  ///< coordinates are longitudes and latitudes
  double middle_x = 0;         ///< coordinate of the raster's middle
  std::vector<dvec3> grid;     ///< directions of kGridSide x kGridSide places; zero where there is none
  std::vector<double> grid_lon, grid_lat;  ///< degrees, as the operation gives them
  dvec3 cap_middle{0.0};
  double cap_radius = std::numbers::pi;
  double per_quadrant = 1;

  mutable std::mutex mutex;
  mutable std::vector<std::unique_ptr<Worker>> idle;

  std::unique_ptr<Worker> take() const {
    {
      const std::lock_guard lock(mutex);
      if (!idle.empty()) {
        std::unique_ptr<Worker> worker = std::move(idle.back());
        idle.pop_back();
        return worker;
      }
    }
    auto worker = std::make_unique<Worker>();
    if (!pipeline.empty()) worker->operation.reset(proj_create(worker->context.get(), pipeline.c_str()));
    worker->grid = std::make_unique<Grid>(path, reference);
    return worker;
  }
  void give(std::unique_ptr<Worker> worker) const {
    const std::lock_guard lock(mutex);
    idle.push_back(std::move(worker));
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw globe::Error(path, why, "give its --crs (such as EPSG:4326), or its --extent W,S,E,N");
  }

  /// Of the grid, k = 0 .. kGridSide-1: at the middles of samples, from the first to the last; over the whole
  /// of a single one.
  static double along(int count, double k) {
    return count > 1 ? 0.5 + (count - 1.0) * k / (kGridSide - 1) : k / (kGridSide - 1);
  }
  double column(int k) const { return along(width, k); }
  double row(int k) const { return along(height, k); }
  double column_step() const { return column(1) - column(0); }
  double row_step() const { return row(1) - row(0); }

  void choose_operation();
  void find_grid();
  void measure();
};

/// The operation of PROJ from the raster's coordinates to degrees.
void RasterProjection::State::choose_operation() {
  const Context context = new_context();
  const Operation crs(proj_create(context.get(), reference.crs.c_str()));
  if (!crs) refuse("its coordinate reference system '" + reference.crs_name + "' is not understood");
  if (!is_on_a_planet(proj_get_type(crs.get())))
    refuse("its coordinate reference system '" + reference.crs_name + "' does not lie on a planet");
  const Operation geographic(proj_crs_get_geodetic_crs(context.get(), crs.get()));
  if (!geographic) refuse("its coordinate reference system '" + reference.crs_name + "' has no latitudes");
  const Operation unbound(proj_get_type(crs.get()) == PJ_TYPE_BOUND_CRS
                              ? proj_get_source_crs(context.get(), crs.get())
                              : nullptr);
  is_geographic = proj_get_type(unbound ? unbound.get() : crs.get()) == PJ_TYPE_GEOGRAPHIC_2D_CRS;

  const double a = semi_major_axis(context.get(), geographic.get());
  const bool on_earth = frame.ellipsoid == globe::geo::kWgs84 && std::abs(a / frame.ellipsoid.a - 1.0) < 0.01;
  const Operation wgs84(on_earth ? proj_create(context.get(), "OGC:CRS84") : nullptr);
  const PJ* target = on_earth ? wgs84.get() : geographic.get();
  Operation all(target == nullptr
                    ? nullptr
                    : proj_create_crs_to_crs_from_pj(context.get(), crs.get(), target, nullptr, nullptr));
  if (all) all.reset(proj_normalize_for_visualization(context.get(), all.get()));
  if (!all)
    refuse("there is no way from its coordinate reference system '" + reference.crs_name + "' to latitudes");

  std::vector<double> x{0.5 * width}, y{0.5 * height};
  take()->grid->to_coordinates(x, y);
  proj_trans(all.get(), PJ_FWD, proj_coord(x[0], y[0], 0, 0));
  const Operation one(proj_trans_get_last_used_operation(all.get()));
  const char* text = one ? proj_as_proj_string(context.get(), one.get(), PJ_PROJ_5, nullptr) : nullptr;
  if (text == nullptr)
    refuse("its coordinate reference system '" + reference.crs_name + "' is not understood");
  pipeline = text;
  idle.clear();
}

/// Where kGridSide x kGridSide places lie, and the cap of the sphere that holds them.
void RasterProjection::State::find_grid() {
  std::vector<double> x, y;
  for (int b = 0; b < kGridSide; ++b) {
    for (int a = 0; a < kGridSide; ++a) {
      x.push_back(column(a));
      y.push_back(row(b));
    }
  }
  std::unique_ptr<Worker> worker = take();
  worker->grid->to_coordinates(x, y);
  middle_x = x[x.size() / 2];
  worker->transform(PJ_FWD, x, y);
  give(std::move(worker));
  grid_lon = x;
  grid_lat = y;
  const double stretch = frame.latitude == Latitude::kGeocentric
                             ? 1.0 / ((1.0 - frame.ellipsoid.f) * (1.0 - frame.ellipsoid.f))
                             : 1.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const bool good = is_number(x[k]) && is_number(y[k]) && std::abs(y[k]) <= 90.0 + 1e-6;
    const double lat = std::clamp(y[k], -90.0, 90.0);
    const double geodetic = stretch == 1.0 || std::abs(lat) == 90.0
                                ? lat
                                : std::atan(std::tan(lat * kDegree) * stretch) / kDegree;
    grid.push_back(good ? globe::geo::normal_from_degrees(geodetic, x[k]) : dvec3(0.0));
  }
}

/// The cap that holds the raster, and how dense its samples are.
void RasterProjection::State::measure() {
  dvec3 sum(0.0);
  int found = 0;
  for (const dvec3& u : grid) {
    sum += u;
    found += u != dvec3(0.0) ? 1 : 0;
  }
  if (found == 0) refuse("its georeferencing leads nowhere on the planet");
  const auto angle = [](const dvec3& a, const dvec3& b) {
    return a == dvec3(0.0) || b == dvec3(0.0) ? 0.0
                                              : 2.0 * std::asin(std::min(1.0, 0.5 * glm::length(a - b)));
  };
  double gap = 0;  // between neighbours of the grid
  for (int b = 0; b < kGridSide; ++b) {
    for (int a = 0; a < kGridSide; ++a) {
      const auto k = static_cast<std::size_t>(b * kGridSide + a);
      if (a > 0) gap = std::max(gap, angle(grid[k], grid[k - 1]));
      if (b > 0) gap = std::max(gap, angle(grid[k], grid[k - kGridSide]));
    }
  }
  if (glm::length(sum) > 0.1 * found) {
    cap_middle = glm::normalize(sum);
    double radius = 0;
    for (const dvec3& u : grid) radius = std::max(radius, angle(u, cap_middle));
    constexpr double kSamplesBeyond = 4.0;
    cap_radius = radius + gap * (1.0 + kSamplesBeyond / std::min(column_step(), row_step()));
  }
  // At the middle, or where else the raster lies on the planet.
  double finest = 0;
  std::vector<double> across, down;
  for (int b = 1; b < kGridSide; ++b) {
    for (int a = 1; a < kGridSide; ++a) {
      const auto k = static_cast<std::size_t>(b * kGridSide + a);
      const double x = angle(grid[k], grid[k - 1]), y = angle(grid[k], grid[k - kGridSide]);
      if (x > 0.0) across.push_back(column_step() / x);
      if (y > 0.0) down.push_back(row_step() / y);
    }
  }
  for (std::vector<double>* densities : {&across, &down}) {
    if (densities->empty()) continue;
    const auto middle = densities->begin() + static_cast<std::ptrdiff_t>(densities->size() / 2);
    std::nth_element(densities->begin(), middle, densities->end());
    finest = std::max(finest, *middle);
  }
  per_quadrant = std::max(1.0, finest * std::numbers::pi / 2.0);
}

RasterProjection::RasterProjection(const std::string& path, int width, int height,
                                   const Georeference& reference, const PlanetFrame& frame)
    : state_(std::make_unique<State>()) {
  state_->path = path;
  state_->width = width;
  state_->height = height;
  state_->reference = reference;
  state_->frame = frame;
  if (reference.crs.empty()) {
    state_->is_geographic = true;
  } else {
    state_->choose_operation();
  }
  state_->find_grid();
  state_->measure();
}

RasterProjection::~RasterProjection() = default;

void RasterProjection::find(const dvec3* directions, std::size_t count, double reach,
                            SamplePoint* out) const {
  const State& state = *state_;
  const double radius = state.cap_radius + reach;
  const double cosine = radius < std::numbers::pi ? std::cos(radius) : -2.0;
  std::vector<std::size_t> near;
  std::vector<double> x, y;
  const double squared = (1.0 - state.frame.ellipsoid.f) * (1.0 - state.frame.ellipsoid.f);
  const double stretch = state.frame.latitude == Latitude::kGeocentric ? squared : 1.0;
  for (std::size_t k = 0; k < count; ++k) {
    const dvec3& u = directions[k];
    out[k] = SamplePoint::nowhere();
    if (glm::dot(u, state.cap_middle) < cosine) continue;
    near.push_back(k);
    x.push_back(std::atan2(u.y, u.x) / kDegree);
    y.push_back(std::atan2(u.z * stretch, std::sqrt(u.x * u.x + u.y * u.y)) / kDegree);
  }
  if (near.empty()) return;
  std::unique_ptr<Worker> worker = state.take();
  worker->transform(PJ_INV, x, y);
  if (state.is_geographic) {
    for (double& lon : x) lon += 360.0 * std::round((state.middle_x - lon) / 360.0);
  }
  for (std::size_t k = 0; k < near.size(); ++k) {
    if (!is_number(x[k]) || !is_number(y[k])) x[k] = y[k] = HUGE_VAL;
  }
  worker->grid->to_samples(x, y);
  for (std::size_t k = 0; k < near.size(); ++k) {
    if (is_number(x[k]) && is_number(y[k])) out[near[k]] = {x[k] - 0.5, y[k] - 0.5};
  }
  state.give(std::move(worker));
}

double RasterProjection::samples_per_quadrant() const { return state_->per_quadrant; }

double RasterProjection::turn() const {
  const auto& transform = state_->reference.transform;
  if (!state_->is_geographic || !transform || (*transform)[2] != 0.0 || (*transform)[4] != 0.0) return 0.0;
  return 360.0 / std::abs((*transform)[1]);
}

std::optional<Extent> RasterProjection::as_extent() const {
  const State& state = *state_;
  const auto& transform = state.reference.transform;
  if (!transform || (*transform)[2] != 0.0 || (*transform)[4] != 0.0 || (*transform)[1] <= 0.0 ||
      (*transform)[5] >= 0.0)
    return std::nullopt;
  const auto& t = *transform;
  const Extent plain{t[0], t[3] + t[5] * state.height, t[0] + t[1] * state.width, t[3]};
  std::vector<double> lon = state.grid_lon;
  const std::vector<double>& lat = state.grid_lat;
  double from_coordinates = 0;  // how far longitudes and latitudes are from the raster's own coordinates
  for (int b = 0; b < kGridSide; ++b) {
    for (int a = 0; a < kGridSide; ++a) {
      const auto k = static_cast<std::size_t>(b * kGridSide + a);
      if (!is_number(lon[k]) || !is_number(lat[k])) return std::nullopt;
      // Eastwards along rows, and each row from where the one above it begins.
      if (a > 0) lon[k] += 360.0 * std::ceil((lon[k - 1] - lon[k]) / 360.0 - 1e-9);
      if (a == 0 && b > 0) lon[k] += 360.0 * std::round((lon[k - kGridSide] - lon[k]) / 360.0);
      const double x = t[0] + t[1] * state.column(a), y = t[3] + t[5] * state.row(b);
      from_coordinates =
          std::max({from_coordinates, std::abs(std::remainder(lon[k] - x, 360.0)), std::abs(lat[k] - y)});
    }
  }
  if (state.is_geographic && from_coordinates < kEqualDegrees) return plain;
  const std::size_t last = lon.size() - 1;
  const double step_x = (lon[last] - lon[0]) / (state.column(kGridSide - 1) - state.column(0));
  const double step_y = (lat[0] - lat[last]) / (state.row(kGridSide - 1) - state.row(0));
  if (!(step_x > 0.0 && step_y > 0.0)) return std::nullopt;
  const double west = lon[0] - step_x * state.column(0), north = lat[0] + step_y * state.row(0);
  for (int b = 0; b < kGridSide; ++b) {
    for (int a = 0; a < kGridSide; ++a) {
      const auto k = static_cast<std::size_t>(b * kGridSide + a);
      const double x = west + step_x * state.column(a), y = north - step_y * state.row(b);
      if (std::abs(lon[k] - x) > kStraightSamples * step_x ||
          std::abs(lat[k] - y) > kStraightSamples * step_y)
        return std::nullopt;
    }
  }
  return Extent{west, north - step_y * state.height, west + step_x * state.width, north};
}

}  // namespace converters
