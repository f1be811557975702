#include "globe/gl/context.h"

#include <epoxy/egl.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <stdexcept>

#include "globe/base/error.h"

namespace globe::gl {
namespace {

using Accept = DisplayAttempt::Accept;

std::string egl_error(const char* call) {
  char code[16];
  std::snprintf(code, sizeof code, "0x%04X", static_cast<unsigned>(eglGetError()));
  return std::string(call) + " failed (" + code + ")";
}

bool has_client_extension(const char* name) { return epoxy_has_egl_extension(EGL_NO_DISPLAY, name); }

std::vector<EGLDeviceEXT> query_devices() {
  if (!has_client_extension("EGL_EXT_device_enumeration") && !has_client_extension("EGL_EXT_device_base"))
    return {};
  EGLint count = 0;
  if (!eglQueryDevicesEXT(0, nullptr, &count) || count <= 0) return {};
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (!eglQueryDevicesEXT(count, devices.data(), &count)) return {};
  devices.resize(static_cast<std::size_t>(count));
  return devices;
}

bool is_software_device(EGLDeviceEXT device) {
  const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
  return extensions != nullptr && epoxy_extension_in_string(extensions, "EGL_MESA_device_software");
}

EGLDisplay open_platform(EGLenum platform, void* native, const char* extension) {
  if (!has_client_extension(extension)) throw std::runtime_error(std::string("no ") + extension);
  return eglGetPlatformDisplayEXT(platform, native, nullptr);
}

DisplayAttempt device_attempt(EGLDeviceEXT device, std::size_t number, Accept accept) {
  const bool software = is_software_device(device);
  return {"EGL device " + std::to_string(number) + (software ? " (software)" : ""),
          [device] { return open_platform(EGL_PLATFORM_DEVICE_EXT, device, "EGL_EXT_platform_device"); },
          accept};
}

/// @param reset_notice  ask to be told of a reset, which some drivers refuse
EGLContext create_context(EGLDisplay display, EGLConfig config, bool reset_notice) {
  std::vector<EGLint> attributes;
  const auto set = [&](EGLint name, EGLint value) { attributes.insert(attributes.end(), {name, value}); };
  set(EGL_CONTEXT_MAJOR_VERSION, 4);
  set(EGL_CONTEXT_MINOR_VERSION, 5);
  set(EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT);
  set(EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE);
  if (reset_notice) set(EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET);
  attributes.push_back(EGL_NONE);
  return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
}

EGLConfig choose_config(EGLDisplay display) {
  if (epoxy_has_egl_extension(display, "EGL_KHR_no_config_context")) return EGL_NO_CONFIG_KHR;
  const std::array<EGLint, 5> wanted = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
  EGLConfig config = EGL_NO_CONFIG_KHR;
  EGLint count = 0;
  if (!eglChooseConfig(display, wanted.data(), &config, 1, &count) || count == 0) {
    throw std::runtime_error("no EGL configuration for OpenGL");
  }
  return config;
}

std::string gl_string(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text == nullptr ? std::string() : reinterpret_cast<const char*>(text);
}

std::string joined(const std::vector<std::string>& lines) {
  std::string result;
  for (const std::string& line : lines) result += (result.empty() ? "" : ", ") + line;
  return result;
}

}  // namespace

bool is_software_renderer(const std::string& renderer) {
  const std::array<const char*, 5> names = {"llvmpipe", "softpipe", "swrast", "SwiftShader",
                                            "Software Rasterizer"};
  return std::any_of(names.begin(), names.end(),
                     [&](const char* name) { return renderer.find(name) != std::string::npos; });
}

std::vector<DisplayAttempt> display_attempts(const std::string& device) {
  const std::vector<EGLDeviceEXT> devices = query_devices();
  std::size_t number = 0;
  const auto [end, failure] = std::from_chars(device.data(), device.data() + device.size(), number);
  if (failure == std::errc() && end == device.data() + device.size()) {
    if (number >= devices.size()) {
      throw Error("graphics device " + device, "there are " + std::to_string(devices.size()) + " EGL devices",
                  "give a number below that, or auto, or software");
    }
    return {device_attempt(devices[number], number, Accept::kAny)};
  }
  if (device != "auto" && device != "software") {
    throw UsageError("graphics device '" + device + "'", "unknown word", "give auto, software or a number");
  }

  std::vector<DisplayAttempt> attempts;
  const bool software_only = device == "software";
  for (std::size_t i = 0; i < devices.size() && !software_only; ++i) {
    // A driver may answer a hardware device with its software rasteriser: that comes last, not here.
    if (!is_software_device(devices[i])) attempts.push_back(device_attempt(devices[i], i, Accept::kHardware));
  }
  const Accept rest = software_only ? Accept::kSoftware : Accept::kAny;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (is_software_device(devices[i])) attempts.push_back(device_attempt(devices[i], i, rest));
  }
  attempts.push_back({"surfaceless Mesa",
                      [] {
                        return open_platform(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY,
                                             "EGL_MESA_platform_surfaceless");
                      },
                      rest});
  attempts.push_back({"default display", [] { return eglGetDisplay(EGL_DEFAULT_DISPLAY); }, rest});
  return attempts;
}

void Context::Destroy::operator()(Handles* handles) const {
  if (eglGetCurrentContext() == handles->context) {
    eglMakeCurrent(handles->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  eglDestroyContext(handles->display, handles->context);
  // The display stays initialised: EGL hands the same one to everybody who asks for the device, without
  // counting.
  delete handles;
}

std::unique_ptr<Context::Handles, Context::Destroy> Context::open(const DisplayAttempt& attempt) {
  EGLDisplay display = attempt.open();
  if (display == EGL_NO_DISPLAY) throw std::runtime_error("no display");
  if (!eglInitialize(display, nullptr, nullptr)) throw std::runtime_error(egl_error("eglInitialize"));
  if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context")) {
    throw std::runtime_error("no EGL_KHR_surfaceless_context");
  }
  if (!eglBindAPI(EGL_OPENGL_API)) throw std::runtime_error("no desktop OpenGL");
  EGLConfig config = choose_config(display);
  EGLContext context = create_context(display, config, true);
  if (context == EGL_NO_CONTEXT) context = create_context(display, config, false);
  if (context == EGL_NO_CONTEXT)
    throw std::runtime_error("no OpenGL 4.5 core, " + egl_error("eglCreateContext"));
  return std::unique_ptr<Handles, Destroy>(new Handles{display, context});
}

void Context::try_attempt(const DisplayAttempt& attempt) {
  auto handles = open(attempt);
  if (!eglMakeCurrent(handles->display, EGL_NO_SURFACE, EGL_NO_SURFACE, handles->context)) {
    throw std::runtime_error(egl_error("eglMakeCurrent"));
  }
  const std::string renderer = gl_string(GL_RENDERER);
  if (attempt.accept != Accept::kAny &&
      is_software_renderer(renderer) != (attempt.accept == Accept::kSoftware)) {
    throw std::runtime_error("draws with " + renderer);
  }
  handles_ = std::move(handles);
  renderer_ = renderer;
  version_ = gl_string(GL_VERSION);
  display_name_ = attempt.name;
  log_->listen();
}

Context::Context(const std::string& device) : Context(display_attempts(device)) {}

Context::Context(const std::vector<DisplayAttempt>& attempts) : log_(std::make_unique<DebugLog>()) {
  for (const DisplayAttempt& attempt : attempts) {
    try {
      try_attempt(attempt);
      return;
    } catch (const std::exception& refusal) {
      refusals_.push_back(attempt.name + ": " + refusal.what());
    }
  }
  throw Error(
      "no OpenGL 4.5 context", joined(refusals_),
      "install a driver (Debian: libegl-mesa0 and libgl1-mesa-dri draw on the CPU) or try --device software");
}

void Context::make_current() const {
  if (!eglMakeCurrent(handles_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, handles_->context)) {
    throw Error("OpenGL context on " + display_name_, egl_error("eglMakeCurrent"), "start the program again");
  }
}

bool Context::is_software() const { return is_software_renderer(renderer_); }

bool Context::is_lost() const { return glGetGraphicsResetStatus() != GL_NO_ERROR; }

}  // namespace globe::gl
