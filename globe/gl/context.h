#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "globe/gl/debug_log.h"

namespace globe::gl {

/// One way to an EGL display.
struct DisplayAttempt {
  enum class Accept { kAny, kHardware, kSoftware };

  std::string name;  ///< "EGL device 0", for messages
  std::function<void*()>
      open;  ///< returns an EGLDisplay, not yet initialised; throws or returns null on refusal
  Accept accept = Accept::kAny;  ///< what kind of renderer will do once the context is there
};

/// The ways in their order: EGL devices (hardware first, the software device last), surfaceless Mesa, the
/// default display.
///
/// @param device  "auto"; "software": only what draws on the CPU; "N": the EGL device of that number alone.
/// Throws UsageError for another word.
std::vector<DisplayAttempt> display_attempts(const std::string& device);

/// A headless OpenGL 4.5 core context, current on the thread that made it.
///
/// It has no surface: draw into a Framebuffer. It is a debug context, and asks to be told of a reset, so that
/// a lost context can be noticed and rebuilt. Destroy it after every object made in it.
class Context {
 public:
  /// The first of display_attempts(device) that gives a context. Throws Error, with every refusal named, when
  /// none does.
  explicit Context(const std::string& device = "auto");
  explicit Context(const std::vector<DisplayAttempt>& attempts);

  void make_current() const;

  /// GL_RENDERER and GL_VERSION.
  const std::string& renderer() const { return renderer_; }
  const std::string& version() const { return version_; }
  /// Name of the attempt that worked.
  const std::string& display_name() const { return display_name_; }
  /// The attempts that came before it and why they failed, one line each.
  const std::vector<std::string>& refusals() const { return refusals_; }
  bool is_software() const;

  /// The driver's complaints so far (see DebugLog).
  const std::vector<std::string>& errors() const { return log_->messages(); }
  void clear_errors() { log_->clear(); }

  /// True after the GPU was reset: every object is gone and the context must be made anew.
  bool is_lost() const;

 private:
  struct Handles {
    void* display = nullptr;
    void* context = nullptr;
  };
  struct Destroy {
    void operator()(Handles* handles) const;
  };

  static std::unique_ptr<Handles, Destroy> open(const DisplayAttempt& attempt);
  void try_attempt(const DisplayAttempt& attempt);

  std::unique_ptr<Handles, Destroy> handles_;
  std::unique_ptr<DebugLog> log_;
  std::string renderer_;
  std::string version_;
  std::string display_name_;
  std::vector<std::string> refusals_;
};

/// Whether a GL_RENDERER string names a rasteriser that runs on the CPU.
bool is_software_renderer(const std::string& renderer);

}  // namespace globe::gl
