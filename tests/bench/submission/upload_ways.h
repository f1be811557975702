#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "globe/clipmap/level_data.h"
#include "globe/clipmap/settings.h"

namespace bench {

/// A way to get the blocks of a level's update into textures of the clipmap's formats and sizes.
struct UploadWay {
  std::string name;
  std::function<void()> upload;
  std::function<std::vector<std::uint8_t>()> read;  ///< what came in, to compare
};

/// From the blocks themselves, through a pixel buffer written anew for each, and through a persistently
/// mapped one.
std::vector<UploadWay> upload_ways(const globe::clipmap::Settings& settings,
                                   std::shared_ptr<const globe::clipmap::LevelUpdate> update);

}  // namespace bench
