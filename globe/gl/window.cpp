#include "globe/gl/window.h"

#include <GLFW/glfw3.h>
#include <epoxy/gl.h>

#include <utility>

#include "globe/base/error.h"
#include "globe/gl/context.h"

namespace globe::gl {
namespace {

/// GLFW's last complaint, to be part of a message.
std::string last_complaint() {
  const char* text = nullptr;
  if (glfwGetError(&text) == GLFW_NO_ERROR || text == nullptr) return "no reason given";
  return text;
}

Window& window_of(GLFWwindow* handle) { return *static_cast<Window*>(glfwGetWindowUserPointer(handle)); }

Modifiers modifiers_of(int bits) {
  return {(bits & GLFW_MOD_SHIFT) != 0, (bits & (GLFW_MOD_CONTROL | GLFW_MOD_SUPER)) != 0,
          (bits & GLFW_MOD_ALT) != 0};
}

Modifiers held_modifiers(GLFWwindow* window) {
  const auto held = [&](int left, int right) {
    return glfwGetKey(window, left) == GLFW_PRESS || glfwGetKey(window, right) == GLFW_PRESS;
  };
  return {held(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT),
          held(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL), held(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT)};
}

constexpr const char* kInstead = "globe shot and globe fly draw without a screen";

}  // namespace

Window::Library::Library() {
  if (!glfwInit()) throw Error("no window", "there is no screen here (" + last_complaint() + ")", kInstead);
}

Window::Library::~Library() { glfwTerminate(); }

void Window::Destroy::operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }

std::unique_ptr<GLFWwindow, Window::Destroy> Window::open(const std::string& title, int width, int height) {
  std::string why;
  for (const int api : {GLFW_NATIVE_CONTEXT_API, GLFW_EGL_CONTEXT_API}) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, api);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "globe");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "globe");
    if (GLFWwindow* window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr))
      return std::unique_ptr<GLFWwindow, Destroy>(window);
    why += (why.empty() ? "" : ", ") + last_complaint();
  }
  throw Error("no window", "OpenGL 4.5 core is not to be had on this screen (" + why + ")", kInstead);
}

Window::Window(const std::string& title, int width, int height)
    : library_(std::make_unique<Library>()),
      window_(open(title, width, height)),
      log_(std::make_unique<DebugLog>()) {
  glfwMakeContextCurrent(window_.get());
  glfwSwapInterval(1);
  log_->listen();
  const auto text = [](GLenum name) {
    const GLubyte* found = glGetString(name);
    return found == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(found));
  };
  renderer_ = text(GL_RENDERER);
  version_ = text(GL_VERSION);
  listen();
  double x = 0, y = 0;
  glfwGetCursorPos(window_.get(), &x, &y);
  pointer_ = pixel_at({x, y});
}

Window::~Window() = default;

void Window::listen() {
  glfwSetWindowUserPointer(window_.get(), this);
  glfwSetCursorPosCallback(window_.get(), [](GLFWwindow* handle, double x, double y) {
    Window& window = window_of(handle);
    window.pointer_ = window.pixel_at({x, y});
    window.events_.emplace_back(PointerMoved{window.pointer_, glfwGetTime()});
  });
  glfwSetMouseButtonCallback(window_.get(), [](GLFWwindow* handle, int button, int action, int modifiers) {
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    Window& window = window_of(handle);
    const MouseButton which = button == GLFW_MOUSE_BUTTON_LEFT    ? MouseButton::kLeft
                              : button == GLFW_MOUSE_BUTTON_RIGHT ? MouseButton::kRight
                                                                  : MouseButton::kMiddle;
    window.events_.emplace_back(
        ButtonChanged{which, action == GLFW_PRESS, modifiers_of(modifiers), window.pointer_, glfwGetTime()});
  });
  glfwSetScrollCallback(window_.get(), [](GLFWwindow* handle, double x, double y) {
    Window& window = window_of(handle);
    window.events_.emplace_back(Scrolled{{x, y}, held_modifiers(handle), window.pointer_});
  });
  glfwSetKeyCallback(window_.get(), [](GLFWwindow* handle, int key, int scancode, int action, int modifiers) {
    window_of(handle).events_.emplace_back(
        KeyChanged{key, scancode, action != GLFW_RELEASE, action == GLFW_REPEAT, modifiers_of(modifiers)});
  });
  glfwSetCharCallback(window_.get(), [](GLFWwindow* handle, unsigned code) {
    window_of(handle).events_.emplace_back(CharacterTyped{code});
  });
  glfwSetCursorEnterCallback(window_.get(), [](GLFWwindow* handle, int entered) {
    window_of(handle).events_.emplace_back(PointerEntered{entered == GLFW_TRUE});
  });
  glfwSetWindowFocusCallback(window_.get(), [](GLFWwindow* handle, int focused) {
    window_of(handle).events_.emplace_back(FocusChanged{focused == GLFW_TRUE});
  });
}

void Window::poll() { glfwPollEvents(); }
void Window::wait(double seconds) { glfwWaitEventsTimeout(seconds); }
std::vector<WindowEvent> Window::take_events() { return std::exchange(events_, {}); }

glm::ivec2 Window::size() const {
  glm::ivec2 size{0};
  glfwGetFramebufferSize(window_.get(), &size.x, &size.y);
  return size;
}

float Window::content_scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_.get(), &x, &y);
  return y;
}

glm::dvec2 Window::pixel_at(glm::dvec2 place) const {
  glm::ivec2 units{0};
  glfwGetWindowSize(window_.get(), &units.x, &units.y);
  if (units.x <= 0 || units.y <= 0) return place;
  // GLFW names a pixel by its upper left corner: its middle is meant.
  return (place + 0.5) * glm::dvec2(size()) / glm::dvec2(units);
}

bool Window::close_requested() const { return glfwWindowShouldClose(window_.get()) == GLFW_TRUE; }
void Window::request_close() { glfwSetWindowShouldClose(window_.get(), GLFW_TRUE); }

void Window::set_full_screen(bool on) {
  if (on == is_full_screen()) return;
  if (on) {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
    if (mode == nullptr) return;
    glfwGetWindowPos(window_.get(), &windowed_.x, &windowed_.y);
    glfwGetWindowSize(window_.get(), &windowed_.width, &windowed_.height);
    windowed_.has_size = true;
    glfwSetWindowMonitor(window_.get(), monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
  } else {
    glfwSetWindowMonitor(window_.get(), nullptr, windowed_.x, windowed_.y, windowed_.width, windowed_.height,
                         GLFW_DONT_CARE);
    windowed_.has_size = false;
  }
  glfwSwapInterval(1);  // some drivers forget it
}

void Window::set_title(const std::string& title) { glfwSetWindowTitle(window_.get(), title.c_str()); }
void Window::set_clipboard(const std::string& text) { glfwSetClipboardString(window_.get(), text.c_str()); }

void Window::show(unsigned framebuffer, glm::ivec2 picture) const {
  const int height = size().y;
  glBlitNamedFramebuffer(framebuffer, 0, 0, 0, picture.x, picture.y, 0, height - picture.y, picture.x, height,
                         GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Window::swap() { glfwSwapBuffers(window_.get()); }

bool Window::is_software() const { return is_software_renderer(renderer_); }

}  // namespace globe::gl
