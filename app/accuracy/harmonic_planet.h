#pragma once

#include <memory>

#include "converters/harmonics.h"
#include "globe/base/temporary_folder.h"
#include "globe/planet/surface.h"

namespace app::accuracy {

/// A planet on disk whose heights are known everywhere: the harmonics at its nodes, rounded to float. Lies in
/// a scratch folder that goes away with the object.
class HarmonicPlanet {
 public:
  HarmonicPlanet(const converters::Harmonics& harmonics, int level);

  const std::shared_ptr<const globe::planet::Surface>& surface() const { return surface_; }

 private:
  globe::TemporaryFolder folder_;
  std::shared_ptr<const globe::planet::Surface> surface_;
};

}  // namespace app::accuracy
