#pragma once

#include <string>
#include <vector>

namespace app::view {

/// Words as a person types them in a shell: those with other than letters, digits and _./:,+=%@- stand in
/// single quotes.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace app::view
