#pragma once

#include <functional>
#include <mutex>
#include <string>

#include "converters/convert.h"

namespace converters {

/// Serialises what the listener hears.
class Report {
 public:
  explicit Report(const ConvertListener& listener) : listener_(listener) {}
  void note(const std::string& text) const {
    const std::lock_guard lock(mutex_);
    if (listener_.note) listener_.note(text);
  }
  void warning(const std::string& text) const {
    const std::lock_guard lock(mutex_);
    if (listener_.warning) listener_.warning(text);
  }
  std::function<void(double)> stage(const std::string& name) const {
    return [this, name](double fraction) {
      const std::lock_guard lock(mutex_);
      if (listener_.progress) listener_.progress(name, fraction);
    };
  }

 private:
  const ConvertListener& listener_;
  mutable std::mutex mutex_;
};

}  // namespace converters
