#pragma once

#include <memory>
#include <vector>

#include "app/accuracy/remade.h"
#include "app/accuracy/samples.h"
#include "app/accuracy/study.h"
#include "globe/planet/surface.h"

namespace app::accuracy {

/// Answers about a planet's ground against those of level `finest`, over whichever places: what
/// question_studies() is made of.

/// The built-in planet, with all of its ground that the questions of a study need.
struct AskedGround {
  std::shared_ptr<const globe::planet::Surface> surface =
      globe::planet::Surface::builtin(1, globe::planet::Surface::kDefaultCache / 2);
};
using Ground = std::shared_ptr<Remade<AskedGround>>;  ///< released between passes

/// The highest place in cones of half kConeRadius_deg, by the level whose nodes are looked at.
Study summary_study(const Ground& ground, const std::vector<globe::htm::dvec3>& centres, int finest);

/// How far lines of sight clear the ground, by its level, from kEye_m over one place of a pair to the other.
Study sight_study(const Ground& ground, const std::vector<PlacePair>& pairs, int finest);

/// The highest place on the way between two, by the number of samples.
Study profile_study(const Ground& ground, const std::vector<PlacePair>& pairs, int finest);

}  // namespace app::accuracy
