// Errors of drawing that `globe accuracy` reports, measured anew by other means.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "app/accuracy/air_reference.h"
#include "app/accuracy/depth_scheme.h"
#include "app/accuracy/study.h"
#include "globe/render/air.h"

namespace app::accuracy {
namespace {

/// Walks through every float of a range and gives the widest stretch that one depth is stored for.
double widest_depth(DepthScheme scheme, float from, float to) {
  double widest = 0, before = stored_depth(scheme, static_cast<double>(from)), since = -1;
  for (float w = from; w < to; w = std::nextafter(w, to)) {
    const double depth = stored_depth(scheme, static_cast<double>(w));
    if (!(depth > before)) continue;
    if (since >= 0) widest = std::max(widest, static_cast<double>(w) - since);
    since = static_cast<double>(w);
    before = depth;
  }
  return widest;
}

TEST(DepthScheme, TellsApartWhatAWalkThroughAllFloatsSaysWithinFivePercent) {
  for (const DepthScheme scheme : kDepthSchemes) {
    for (const double distance : {1.0, 100.0, 1e4}) {
      const double walked =
          widest_depth(scheme, static_cast<float>(distance), static_cast<float>(1.1 * distance));
      double reported = 0;
      for (const double at : depth_sample(distance))
        reported = std::max(reported, smallest_separation(scheme, at));
      if (walked == 0) {
        EXPECT_GT(reported, 0.05 * distance) << name_of(scheme) << " at " << distance;
        continue;
      }
      EXPECT_NEAR(reported, walked, 0.05 * walked) << name_of(scheme) << " at " << distance;
    }
  }
}

TEST(DepthScheme, ReversedFloatIsAsFineEverywhereAsTheDistanceItselfInFloats) {
  for (const double distance : {1.0, 1e4, 1e8})
    EXPECT_LT(smallest_separation(DepthScheme::kReversedFloat, distance), distance * 0x1p-21);
}

/// The same column by the trapezoidal rule along the path, in long double; within 4e-6, its step's error
/// where the air is thinnest.
double plain_column(double height, double cos_zenith, double ground, double scale) {
  constexpr int kSteps = 400000;
  constexpr long double kLength = 3000.0L;
  long double sum = 0;
  for (int k = 0; k <= kSteps; ++k) {
    const long double t = kLength * k / kSteps;
    const long double r0 = static_cast<long double>(ground + height);
    const long double radius =
        std::sqrt(r0 * r0 + t * t + 2.0L * r0 * t * static_cast<long double>(cos_zenith));
    sum += (k == 0 || k == kSteps ? 0.5L : 1.0L) *
           std::exp(-(radius - static_cast<long double>(ground)) / static_cast<long double>(scale));
  }
  return static_cast<double>(sum * kLength / kSteps);
}

TEST(AirReference, ColumnsAreThoseOfThePlainTrapezoidalRule) {
  for (const double scale : {8.0, 1.2}) {
    for (const double height : {0.0, 5.0, 40.0}) {
      for (const double cos_zenith : {1.0, 0.3, 0.01, 0.0, -0.01, -0.03}) {
        const double plain = plain_column(height, cos_zenith, 6371.0, scale);
        EXPECT_NEAR(air_column(Columns::kIntegrated, height, cos_zenith, 6371.0, scale), plain, 1e-5 * plain)
            << scale << ' ' << height << ' ' << cos_zenith;
      }
    }
  }
}

TEST(AirReference, IsWhatTheShadersCodeComesToWithVeryManySteps) {
  for (const double eye_km : {0.002, 12.0}) {
    for (const double sun_z : {0.7, 0.05, -0.03}) {
      for (const double look_z : {0.9, 0.05}) {
        const ReferenceRay ray{{0, 0, 6371.0 + eye_km},
                               {std::sqrt(1 - look_z * look_z), 0, look_z},
                               0.0,
                               600.0,
                               {std::sqrt(1 - sun_z * sun_z), 0, sun_z},
                               6371.0};
        const glm::dvec3 truth = sky_parts(Columns::kApproximate, ray).tinted_sum();
        const glm::dvec3 seen(globe::render::sky_light(
            {glm::vec3(ray.eye), glm::vec3(ray.direction), 0.0f, 600.0f, glm::vec3(ray.sun), 6371.0f}, 4000));
        EXPECT_LT(glm::length(seen - truth), 0.005 * glm::length(truth))
            << eye_km << ' ' << sun_z << ' ' << look_z;
      }
    }
  }
}

}  // namespace
}  // namespace app::accuracy
