#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/bench/submission/ground_scene.h"

namespace bench {

/// A way to have a scene drawn: issues everything of a frame after GroundScene::begin_frame(), what it
/// uploads for it included; does not wait for it.
struct DrawWay {
  std::string name;
  std::function<void()> issue;
};

/// Draws by instances, a draw for each look and rim, as the renderer does.
DrawWay instanced(const std::string& name, const GroundScene& scene, const globe::clipmap::PatchMesh& mesh);

/// The same, and indirect draws, a call for each look, and plain draws, one for each patch.
std::vector<DrawWay> draw_ways(const GroundScene& scene);

}  // namespace bench
