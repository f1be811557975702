#pragma once

#include <memory>

#include "app/accuracy/study.h"

namespace app::accuracy {

/// Fixed work that is measured beside the studies (measure_beside), so that two reports show whether the
/// machine itself was as fast: 100,000 numbers sorted and, where there is a context (current, and stays so),
/// eight planes filled. It errs by nothing.
Study pace_of_machine(const std::shared_ptr<globe::gl::Context>& context);

}  // namespace app::accuracy
