#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "globe/scene/scene.h"

namespace app {

/// People's own marks on a planet: --shapes, --graticule and --labels as they are written.
struct MarkOptions {
  std::vector<std::string> shapes;
  std::optional<std::string> graticule;  ///< a step in degrees; empty: by what is in view
  std::string labels;                    ///< on, off, or empty: on for what the other two ask for

  /// Any of them was given.
  bool any() const { return !shapes.empty() || graticule || !labels.empty(); }
};

void add_mark_options(CLI::App& command, MarkOptions& options);

/// Adds to a scene the effects that the options ask for, beside those it names itself, or takes its labels
/// out.
///
/// @param labels_fit  the picture is one that labels can be written in: else they are, unless asked for, left
/// out
/// Throws UsageError.
void add_marks(const MarkOptions& options, bool labels_fit, globe::scene::Scene& scene);

}  // namespace app
