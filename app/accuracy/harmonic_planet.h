#pragma once

#include <filesystem>
#include <memory>

#include "converters/harmonics.h"
#include "globe/planet/surface.h"

namespace app::accuracy {

/// A planet on disk whose heights are known everywhere: the harmonics at its nodes, rounded to float. Lies in
/// a scratch folder that goes away with the object.
class HarmonicPlanet {
 public:
  HarmonicPlanet(const converters::Harmonics& harmonics, int level);
  HarmonicPlanet(const HarmonicPlanet&) = delete;
  HarmonicPlanet& operator=(const HarmonicPlanet&) = delete;
  ~HarmonicPlanet();

  const std::shared_ptr<const globe::planet::Surface>& surface() const { return surface_; }

 private:
  std::filesystem::path folder_;
  std::shared_ptr<const globe::planet::Surface> surface_;
};

}  // namespace app::accuracy
