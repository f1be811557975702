#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

namespace {

/// OpenImageIO starts no threads in the process of the tests, which then can fork the program
/// (tests/cli/run_program.h); there it has as many as ever.
class OneThread : public testing::Environment {
  void SetUp() override {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", 1);
  }
};

const auto* const kOneThread = testing::AddGlobalTestEnvironment(new OneThread);

}  // namespace
