/// Pictures of the ground, made on the CPU, to judge what a person will see:
///
///   ground_preview (SEED | FOLDER) OUT.png top LAT LON LEVEL
///   ground_preview (SEED | FOLDER) OUT.png view LAT LON HEIGHT_ABOVE_GROUND_M HEADING [PITCH]
///   ground_preview (SEED | FOLDER) OUT.png orbit LAT LON
///   ground_preview (SEED | FOLDER) - scenic 0 0

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iostream>
#include <numbers>
#include <string>

#include "globe/base/angles.h"
#include "globe/planet/scenic.h"
#include "sampler.h"

namespace globe::preview {
namespace {

struct Image {
  int width, height;
  std::vector<vec3> pixels;
  Image(int w, int h)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  vec3& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

float tone(float v) {
  const float mapped = 1.0f - std::exp(-1.7f * std::max(0.0f, v));
  return mapped <= 0.0031308f ? 12.92f * mapped : 1.055f * std::pow(mapped, 1.0f / 2.4f) - 0.055f;
}

void write(const Image& image, const std::string& path) {
  std::vector<unsigned char> bytes;
  for (const vec3& p : image.pixels)
    for (const float v : {p.x, p.y, p.z})
      bytes.push_back(static_cast<unsigned char>(255.0f * tone(v) + 0.5f));
  auto out = OIIO::ImageOutput::create(path);
  out->open(path, OIIO::ImageSpec(image.width, image.height, 3, OIIO::TypeDesc::UINT8));
  out->write_image(OIIO::TypeDesc::UINT8, bytes.data());
  out->close();
}

vec3 lit(const Sample& s, const vec3& sun, const vec3& up, const vec3& eye) {
  const vec3 sun_light(2.9f, 2.7f, 2.4f);
  const vec3 sky_light(0.22f, 0.30f, 0.42f);
  const float direct =
      std::max(0.0f, glm::dot(s.normal, sun)) * glm::smoothstep(-0.05f, 0.1f, glm::dot(up, sun));
  vec3 color = s.albedo * (sun_light * direct + sky_light * (0.5f + 0.5f * glm::dot(s.normal, up)));
  if (s.water) {
    const float facing = 1.0f - std::max(0.0f, glm::dot(up, eye));
    color += vec3(0.30f, 0.42f, 0.60f) * (0.02f + 0.6f * std::pow(facing, 5.0f));
  }
  return color;
}

/// Sun at an elevation and heading of a place.
vec3 sun_over(const geo::LocalFrame& frame, double elevation_deg, double heading_deg) {
  return vec3(geo::look_direction(frame, heading_deg, elevation_deg));
}

Image top_view(Sampler& sampler, double lat, double lon, int level) {
  constexpr int kSide = 512;
  const geo::LocalFrame frame = geo::local_frame(lat, lon);
  const double step = std::ldexp(std::numbers::pi / 2.0, -level);
  const vec3 sun = sun_over(frame, 35.0, 315.0);
  Image image(kSide, kSide);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const dvec3 u = glm::normalize(frame.up + frame.east * (step * (x - kSide / 2 + 0.37)) -
                                     frame.north * (step * (y - kSide / 2 + 0.37)));
      const Sample s = sampler.at(u, level);
      image.at(x, y) = lit(s, sun, vec3(u), vec3(u));
    }
  }
  return image;
}

Image orbit_view(Sampler& sampler, double lat, double lon) {
  constexpr int kSide = 600;
  const geo::LocalFrame frame = geo::local_frame(lat, lon);
  const vec3 sun = sun_over(frame, 55.0, 300.0);
  Image image(kSide, kSide);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double px = (x - kSide / 2 + 0.5) / (kSide * 0.49);
      const double py = -(y - kSide / 2 + 0.5) / (kSide * 0.49);
      const double r2 = px * px + py * py;
      if (r2 >= 1.0) continue;
      const double z = std::sqrt(1.0 - r2);
      const dvec3 u = frame.east * px + frame.north * py + frame.up * z;
      const Sample s = sampler.at(u, 8);
      const auto haze = static_cast<float>(0.06 + 0.5 * std::pow(1.0 - z, 3.0));
      const float day = glm::smoothstep(-0.1f, 0.3f, glm::dot(vec3(u), sun));
      image.at(x, y) = glm::mix(lit(s, sun, vec3(u), vec3(frame.up)), vec3(0.35f, 0.5f, 0.8f) * day, haze);
    }
  }
  return image;
}

/// Columns of ground from the camera to the horizon, near to far, each sample at the level its distance asks
/// for.
Image perspective_view(Sampler& sampler, double lat, double lon, double above_m, double heading,
                       double pitch) {
  constexpr int kWidth = 640;
  constexpr int kHeight = 360;
  constexpr double kFieldOfView = 60.0;
  constexpr double kStep = 1.003;
  const geo::LocalFrame frame = geo::local_frame(lat, lon);
  const double radius = sampler.surface().ellipsoid().mean_radius();
  const double root = sampler.surface().root_edge();
  const bool air = sampler.surface().info().body != "moon";
  const double focal = 0.5 * kWidth / std::tan(0.5 * kFieldOfView * kDegree);
  const auto level_for = [&](double distance) {
    const double wanted = std::max(0.02, distance / focal);
    return std::clamp(static_cast<int>(std::ceil(std::log2(root / wanted))), 7, 28);
  };
  const double camera = sampler.at(frame.up, 24).height_m + above_m;
  const vec3 sun = sun_over(frame, 35.0, heading + 65.0);
  const double horizon = std::sqrt(2.0 * radius * (above_m + 100.0)) + std::sqrt(2.0 * radius * 7000.0);
  Image image(kWidth, kHeight);
  for (int x = 0; x < kWidth; ++x) {
    const double yaw = heading + std::atan((x - kWidth / 2 + 0.5) / focal) / kDegree;
    const dvec3 ahead = geo::look_direction(frame, yaw, 0.0);
    const double cos_off = std::cos((yaw - heading) * kDegree);
    int filled = kHeight;  // rows below are done
    const double lowest = 0.5 * above_m;
    for (double distance = lowest; distance < horizon && filled > 0; distance *= kStep) {
      const double angle = distance / radius;
      const dvec3 u = frame.up * std::cos(angle) + ahead * std::sin(angle);
      const Sample s = sampler.at(u, level_for(distance));
      const double forward = (radius + s.height_m) * std::sin(angle);
      const double rise = (radius + s.height_m) * std::cos(angle) - (radius + camera);
      const double tilt = std::atan2(rise, forward * cos_off) - pitch * kDegree;
      if (tilt < -1.4) continue;
      const int row =
          std::clamp(static_cast<int>(std::lround(kHeight / 2.0 - focal * std::tan(tilt))), 0, kHeight);
      if (row >= filled) continue;
      vec3 color = lit(s, sun, vec3(u), glm::normalize(vec3(frame.up * -rise) - vec3(ahead * forward)));
      if (air) {
        const double thin = std::exp(-0.5 * (camera + s.height_m) / 8000.0);
        const auto haze = static_cast<float>(1.0 - std::exp(-distance * thin / 90000.0));
        color = glm::mix(color, vec3(0.42f, 0.55f, 0.75f), haze);
      }
      for (int y = row; y < filled; ++y) image.at(x, y) = color;
      filled = row;
    }
    for (int y = 0; y < filled; ++y) {
      const auto t = static_cast<float>(y) / kHeight;
      image.at(x, y) = air ? glm::mix(vec3(0.13f, 0.25f, 0.55f), vec3(0.42f, 0.55f, 0.75f), t) : vec3(0.0f);
    }
  }
  return image;
}

std::shared_ptr<const planet::Surface> open(const std::string& what) {
  if (what.find_first_not_of("0123456789") == std::string::npos)
    return planet::Surface::builtin(std::stoull(what));
  const std::size_t cache = std::size_t{256} << 20;
  return planet::Surface::from_dataset(
      std::make_shared<const planet::Dataset>(planet::Dataset::open(what, cache)), cache);
}

int run(const std::vector<std::string>& args) {
  if (args.size() < 6) {
    std::cerr << "ground_preview (SEED | FOLDER) OUT.png (top LAT LON LEVEL | view LAT LON HEIGHT HEADING "
                 "[PITCH] | orbit LAT LON)\n";
    return 2;
  }
  const std::shared_ptr<const planet::Surface> surface = open(args[1]);
  const auto number = [&](std::size_t k) { return std::stod(args.at(k)); };
  Sampler sampler(surface);
  if (args[3] == "top") {
    write(top_view(sampler, number(4), number(5), static_cast<int>(number(6))), args[2]);
  } else if (args[3] == "view") {
    const double pitch = args.size() > 8 ? number(8) : -6.0;
    write(perspective_view(sampler, number(4), number(5), number(6), number(7), pitch), args[2]);
  } else if (args[3] == "scenic") {
    const planet::ScenicView view = planet::scenic_place(*surface);
    std::cout << view.place.lat_deg << ' ' << view.place.lon_deg << ' ' << view.place.h_m << ' '
              << view.heading_deg << '\n';
  } else {
    write(orbit_view(sampler, number(4), number(5)), args[2]);
  }
  return 0;
}

}  // namespace
}  // namespace globe::preview

int main(int argc, char** argv) { return globe::preview::run({argv, argv + argc}); }
