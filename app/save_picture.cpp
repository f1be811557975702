#include "app/save_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "app/image_file.h"

namespace app {
namespace {

void write_depth(const ViewOptions& options, int width, int height, const std::vector<float>& depth,
                 double near_m) {
  std::vector<float> metres(depth.size());
  std::transform(depth.begin(), depth.end(), metres.begin(), [&](float d) {
    return d > 0.0f ? static_cast<float>(near_m / static_cast<double>(d)) : 0.0f;
  });
  if (options.output.size() > 4 && options.output.ends_with(".exr")) {
    write_image(options.output, width, height, {"Z"}, metres, options.overwrite);
    return;
  }
  // A picture of depth: nearest white, farthest black, by the logarithm of the distance.
  float nearest = 3e38f;
  float farthest = 0.0f;
  for (const float z : metres) {
    if (z <= 0.0f) continue;
    nearest = std::min(nearest, z);
    farthest = std::max(farthest, z);
  }
  const float span = std::max(std::log(std::max(farthest, 1e-6f) / std::max(nearest, 1e-6f)), 1e-6f);
  std::vector<std::uint8_t> rgba(metres.size() * 4, 255);
  for (std::size_t k = 0; k < metres.size(); ++k) {
    const float t = metres[k] > 0.0f ? 1.0f - std::log(metres[k] / nearest) / span : 0.0f;
    std::fill_n(rgba.begin() + static_cast<std::ptrdiff_t>(4 * k), 3,
                static_cast<std::uint8_t>(std::clamp(t, 0.0f, 1.0f) * 255.0f));
  }
  write_image(options.output, {width, height, rgba}, options.overwrite);
}

}  // namespace

void save_picture(const ViewOptions& options, const globe::gl::Framebuffer& picture, double near_m) {
  const int width = picture.width();
  const int height = picture.height();
  if (options.show == "depth") {
    write_depth(options, width, height, picture.read_depth(), near_m);
  } else if (options.output.ends_with(".exr")) {
    write_image(options.output, width, height, {"R", "G", "B", "A"}, picture.read_rgba_float(),
                options.overwrite);
  } else {
    const std::vector<std::uint8_t> rgba = picture.read_rgba8();
    write_image(options.output, {width, height, rgba}, options.overwrite);
  }
}

}  // namespace app
