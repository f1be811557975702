#include "app/view/overlay.h"

#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <imgui.h>
#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_opengl3.h>
#include <imgui_internal.h>

#include <filesystem>
#include <variant>

namespace app::view {
namespace {

namespace gl = globe::gl;

constexpr float kTextSize = 15.0f;
constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

void set_style(float scale) {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 6.0f;
  style.FrameRounding = style.GrabRounding = 3.0f;
  style.WindowBorderSize = 0.0f;
  style.ItemSpacing = {7.0f, 5.0f};
  ImVec4* colors = style.Colors;
  colors[ImGuiCol_WindowBg] = {0.06f, 0.07f, 0.09f, 0.82f};
  colors[ImGuiCol_Header] = {0.20f, 0.27f, 0.36f, 0.65f};
  colors[ImGuiCol_TitleBgActive] = colors[ImGuiCol_TitleBg] = {0.09f, 0.13f, 0.19f, 0.92f};
  style.ScaleAllSizes(scale);
}

void load_font(float scale) {
  ImGuiIO& io = ImGui::GetIO();
  // Latin, Greek and Cyrillic, and what units and arrows take.
  static const ImWchar ranges[] = {0x20,   0x24f,  0x370,  0x4ff,  0x2010, 0x2044,
                                   0x2070, 0x209f, 0x2190, 0x2193, 0};
  if (std::filesystem::exists(kFont)) io.Fonts->AddFontFromFileTTF(kFont, kTextSize * scale, nullptr, ranges);
}

int action(bool down) { return down ? GLFW_PRESS : GLFW_RELEASE; }

int bits(const gl::Modifiers& held) {
  return (held.shift ? GLFW_MOD_SHIFT : 0) | (held.control ? GLFW_MOD_CONTROL : 0) |
         (held.alt ? GLFW_MOD_ALT : 0);
}

}  // namespace

void Overlay::Destroy::operator()(ImGuiContext* context) const {
  ImGui::SetCurrentContext(context);
  if (ImGui::GetIO().BackendRendererUserData != nullptr) ImGui_ImplOpenGL3_Shutdown();
  if (ImGui::GetIO().BackendPlatformUserData != nullptr) ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext(context);
}

std::unique_ptr<Overlay> Overlay::start(const globe::gl::Window& window) {
  std::unique_ptr<Overlay> overlay(new Overlay);
  overlay->context_.reset(ImGui::CreateContext());
  ImGui::GetIO().IniFilename = nullptr;  // where its windows lie is not worth a file
  if (!ImGui_ImplGlfw_InitForOpenGL(window.handle(), false)) return nullptr;
  if (!ImGui_ImplOpenGL3_Init("#version 450 core")) return nullptr;
  set_style(window.content_scale());
  load_font(window.content_scale());
  return overlay;
}

Overlay::~Overlay() = default;

void Overlay::hear(const gl::Window& window, const gl::WindowEvent& event) {
  GLFWwindow* handle = window.handle();
  if (const auto* button = std::get_if<gl::ButtonChanged>(&event)) {
    const int number = button->button == gl::MouseButton::kLeft    ? GLFW_MOUSE_BUTTON_LEFT
                       : button->button == gl::MouseButton::kRight ? GLFW_MOUSE_BUTTON_RIGHT
                                                                   : GLFW_MOUSE_BUTTON_MIDDLE;
    ImGui_ImplGlfw_MouseButtonCallback(handle, number, action(button->down), bits(button->modifiers));
  } else if (const auto* wheel = std::get_if<gl::Scrolled>(&event)) {
    ImGui_ImplGlfw_ScrollCallback(handle, wheel->by.x, wheel->by.y);
  } else if (const auto* key = std::get_if<gl::KeyChanged>(&event)) {
    ImGui_ImplGlfw_KeyCallback(handle, key->key, key->scancode,
                               key->repeated ? GLFW_REPEAT : action(key->down), bits(key->modifiers));
  } else if (const auto* typed = std::get_if<gl::CharacterTyped>(&event)) {
    ImGui_ImplGlfw_CharCallback(handle, typed->code);
  } else if (const auto* entered = std::get_if<gl::PointerEntered>(&event)) {
    ImGui_ImplGlfw_CursorEnterCallback(handle, entered->inside ? GLFW_TRUE : GLFW_FALSE);
  } else if (const auto* focus = std::get_if<gl::FocusChanged>(&event)) {
    ImGui_ImplGlfw_WindowFocusCallback(handle, focus->focused ? GLFW_TRUE : GLFW_FALSE);
  }
}

void Overlay::begin() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Overlay::end(const globe::gl::Window& window) {
  ImGui::Render();
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, window.size().x, window.size().y);
  // ImGui knows nothing of clip control and restores what it knows of.
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

bool Overlay::has_pointer(const globe::gl::Window& window, glm::dvec2 pixel) const {
  if (ImGui::IsAnyItemActive()) return true;
  const ImGuiIO& io = ImGui::GetIO();
  const ImVec2 at(static_cast<float>(pixel.x) * io.DisplaySize.x / static_cast<float>(window.size().x),
                  static_cast<float>(pixel.y) * io.DisplaySize.y / static_cast<float>(window.size().y));
  for (const ImGuiWindow* drawn : ImGui::GetCurrentContext()->Windows) {
    if (drawn->WasActive && !drawn->Hidden && (drawn->Flags & ImGuiWindowFlags_NoMouseInputs) == 0 &&
        drawn->Rect().Contains(at))
      return true;
  }
  return false;
}

bool Overlay::has_keyboard() const { return ImGui::GetIO().WantTextInput; }

}  // namespace app::view
