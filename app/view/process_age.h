#pragma once

namespace app::view {

/// Seconds since the program was started, its libraries' loading included; exact to a hundredth.
double process_age_s();

}  // namespace app::view
