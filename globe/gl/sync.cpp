#include "globe/gl/sync.h"

namespace globe::gl {
namespace {

bool is_passed(GLenum status) { return status == GL_ALREADY_SIGNALED || status == GL_CONDITION_SATISFIED; }

}  // namespace

Sync Sync::create() {
  Sync result;
  result.fence_.reset(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
  return result;
}

bool Sync::passed() const { return is_passed(glClientWaitSync(fence_.get(), GL_SYNC_FLUSH_COMMANDS_BIT, 0)); }

void Sync::wait() const {
  constexpr GLuint64 kSecond = 1'000'000'000;
  GLenum status = GL_TIMEOUT_EXPIRED;
  while (status == GL_TIMEOUT_EXPIRED) {
    status = glClientWaitSync(fence_.get(), GL_SYNC_FLUSH_COMMANDS_BIT, kSecond);
  }
}

}  // namespace globe::gl
