#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <string_view>

#include "app/accuracy/study.h"

// Which test measures the errors of which study of `globe accuracy` again, by a second method, and which are
// not measured again, and why.

namespace {

namespace fs = std::filesystem;

struct Again {
  std::string_view study;  ///< how its name begins
  std::string_view test;   ///< that measures it again, to 5 % but where the reason says otherwise; or none
  std::string_view reason;
};

constexpr std::array kAgain{
    Again{"geometry.sine_cosine", "DirectionsAndLongitudesInFiftyDigits", ""},
    Again{"geometry.arctangent", "DirectionsAndLongitudesInFiftyDigits", ""},
    Again{"geometry.midpoints", "", "halvings in long double are the second method; no other is known"},
    Again{"geodesics.ellipsoid", "DistancesOnTheEllipsoidByBoostAndTheSeriesOfGeographicLib", ""},
    Again{"geodesics.sphere", "DistancesOnTheSphereByHalfAngles", ""},
    Again{"geodesics.shape", "PlacesOnTheSphereByGeographicLib", ""},
    Again{"heights.interpolation", "HeightsBetweenNodesFromTheFunctionAtTheCornersOfHtm", "at one level"},
    Again{"storage.heights", "StoredHeightsByImathAndInLongDouble", ""},
    Again{"conversion.filter", "RoundTripsOfAMapByTheTextbook",
          "at the map's own level; not --as-thesis, whose places are its own"},
    Again{"conversion.level", "RoundTripsOfAMapByTheTextbook", "bilinear, at the map's own level"},
    Again{"questions.summary", "HighestPlacesByLookingAtAllNodes", ""},
    Again{"questions.sight", "LinesOfSightByPlacesAlongThem", ""},
    Again{"questions.profile", "ProfilesByTheExactGeodesicOfGeographicLib", ""},
    Again{"covers", "CoversByDistancesAndLHuilier",
          "which ranges a limited cover is made of is taken as found, their area is not"},
    Again{"positions.1000km.yardsticks", "YardsticksErrByWhatTheirArithmeticDoesOnTheCpu", ""},
    Again{"positions.100m.yardsticks", "YardsticksErrByWhatTheirArithmeticDoesOnTheCpu", ""},
    Again{"positions.10km.yardsticks", "YardsticksErrByWhatTheirArithmeticDoesOnTheCpu", ""},
    Again{"positions.eye.yardsticks", "YardsticksErrByWhatTheirArithmeticDoesOnTheCpu", ""},
    Again{"positions.orbit.yardsticks", "YardsticksErrByWhatTheirArithmeticDoesOnTheCpu", ""},
    Again{
        "positions", "ChordsAndParabolasErrByWhatTheirFormulasSay",
        "parabolas from 1000 km up. What is left of exact places, of float32 and of parabolas lower down is "
        "what a GPU's arithmetic rounds: nothing but that arithmetic says how much"},
    Again{"detail", "DetailErrsByWhatRaysThroughTheTrianglesOfTheGpuSay", ""},
    Again{"morph.pop", "", "read back from the GPU; what morphing allows is held to by H17"},
    Again{"depth", "TellsApartWhatAWalkThroughAllFloatsSaysWithinFivePercent", ""},
    Again{"windows", "", "pictures are compared byte by byte: the error is 0"},
    Again{"sky.columns", "ColumnsAreThoseOfThePlainTrapezoidalRule",
          "the reference is measured again, to 1e-5; so are those of the other studies of the sky"},
    Again{"sky", "IsWhatTheShadersCodeComesToWithVeryManySteps", "the reference is, to half a percent"},
    Again{"atmosphere", "ReferenceOfOneLookComesOutAsCommitted",
          "the reference is drawn by lot, hours of it: one look is made again"},
    Again{"shading.tone", "ToneCurveIsTheFilmicOneInSrgb", "to 0.9 steps of 255"},
    Again{"shading.texels", "", "the ground lit in double is the second method"},
    Again{"shading.normals", "", "as many bits' rounding in double"},
    Again{"samples.edges", "SamplesErrByWhatTheirPlacesInThePixelSay", ""},
    Again{"domes.faces", "DomesErrByWhatPicturesOfAPinholeCameraSay", ""},
    Again{"flat.levels", "LevelsOfARegionErrByWhatTheDepthOfPicturesSays", ""},
    Again{"flat.morph", "LeapsOfARegionsLevelsAreThoseOfTheTrianglesBeforeAndAfter", ""},
    Again{"flat.spacing", "PostsOfAPlanetsPartErrByWhatGeographicLibsFrameSays", ""},
    Again{"flat.endless", "EndlessGroundErrsByWhatTheDepthOfPicturesSays", ""},
    Again{"marks.lines", "", "places of the edge by the definition are the second method"}};

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(AccuracyRemeasuredList, HasEveryStudyOfTheReport) {
  std::ifstream report(fs::path(GLOBE_SOURCE_DIR) / "tests/bench/results/accuracy-amd-epyc.csv");
  std::set<std::string> families;
  std::string row;
  std::getline(report, row);  // names of the columns
  while (std::getline(report, row)) {
    const std::string study = row.substr(0, row.find(','));
    if (study == "pace") continue;
    families.insert(study.substr(0, study.find('.')));
    EXPECT_TRUE(std::any_of(kAgain.begin(), kAgain.end(), [&](const Again& again) {
      return study.starts_with(again.study);
    })) << study;
  }
  for (const app::accuracy::Family& family : app::accuracy::families())
    EXPECT_TRUE(families.contains(family.name)) << family.name << " is not in the report that is committed";
}

TEST(AccuracyRemeasuredList, NamesTestsThatThereAreOrSaysWhyThereIsNone) {
  std::string tests;
  for (const char* folder : {"tests/unit", "tests/render"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(GLOBE_SOURCE_DIR) / folder))
      if (entry.path().extension() == ".cpp") tests += text_of(entry.path());
  }
  for (const Again& again : kAgain) {
    EXPECT_TRUE(again.test.empty() || tests.find(", " + std::string(again.test) + ")") != std::string::npos)
        << again.test;
    EXPECT_FALSE(again.test.empty() && again.reason.empty()) << again.study;
  }
}

}  // namespace
