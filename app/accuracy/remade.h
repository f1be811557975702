#pragma once

#include <functional>
#include <memory>
#include <utility>

namespace app::accuracy {

/// Something large that a cost needs: made when it is asked for, and made anew when it is asked for after it
/// was released.
template <class Thing>
class Remade {
 public:
  explicit Remade(std::function<std::unique_ptr<Thing>()> make) : make_(std::move(make)) {}

  Thing& get() {
    if (!thing_) thing_ = make_();
    return *thing_;
  }
  void release() { thing_ = nullptr; }

 private:
  std::function<std::unique_ptr<Thing>()> make_;
  std::unique_ptr<Thing> thing_;
};

/// Nothing yet; to be made of copies of these arguments.
template <class Thing, class... Arguments>
std::shared_ptr<Remade<Thing>> remade(const Arguments&... arguments) {
  return std::make_shared<Remade<Thing>>([=] { return std::make_unique<Thing>(arguments...); });
}

/// For Setting::release.
template <class Thing>
std::function<void()> release_of(const std::shared_ptr<Remade<Thing>>& thing) {
  return [thing] { thing->release(); };
}

}  // namespace app::accuracy
