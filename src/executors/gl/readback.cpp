#include "executors/gl/readback.hpp"

#include <cstring>

#include <plexway/error.hpp>

namespace plexway::gl {

Readback::Readback(const Session& session, GLuint buffer, std::size_t bytes)
    : gl_(session.gl), buffer_(buffer), bytes_(bytes) {
  if (gl_.BufferStorage == nullptr || gl_.MapBufferRange == nullptr) return;
  const auto all = static_cast<GLsizeiptr>(fences_.size() * bytes_);
  constexpr GLbitfield flags = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  gl_.GenBuffers(1, &copies_);
  gl_.BindBuffer(GL_COPY_WRITE_BUFFER, copies_);
  gl_.BufferStorage(GL_COPY_WRITE_BUFFER, all, nullptr, flags);
  mapped_ =
      static_cast<const unsigned char*>(gl_.MapBufferRange(GL_COPY_WRITE_BUFFER, 0, all, flags));
}

Readback::~Readback() {
  for (const GLsync fence : fences_)
    if (fence != nullptr) gl_.DeleteSync(fence);
  if (copies_ != 0) gl_.DeleteBuffers(1, &copies_);
}

bool Readback::next(const Session&, void* values) {
  if (mapped_ == nullptr) {
    gl_.BindBuffer(GL_COPY_READ_BUFFER, buffer_);
    gl_.GetBufferSubData(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(bytes_), values);
    return true;
  }
  const std::size_t slot = started_++ % fences_.size(), last = 1 - slot;
  gl_.BindBuffer(GL_COPY_READ_BUFFER, buffer_);
  gl_.BindBuffer(GL_COPY_WRITE_BUFFER, copies_);
  gl_.CopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0,
                        static_cast<GLintptr>(slot * bytes_), static_cast<GLsizeiptr>(bytes_));
  fences_[slot] = gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  gl_.Flush();
  if (fences_[last] == nullptr) return false;
  GLenum waited = GL_TIMEOUT_EXPIRED;
  while (waited == GL_TIMEOUT_EXPIRED)
    waited = gl_.ClientWaitSync(fences_[last], 0, GLuint64{1000000000});
  gl_.DeleteSync(fences_[last]);
  fences_[last] = nullptr;
  if (waited == GL_WAIT_FAILED) throw Error("the GL device was lost while it worked");
  std::memcpy(values, mapped_ + last * bytes_, bytes_);
  return true;
}

void Readback::finish(const Session&) {
  gl_.Finish();
  for (GLsync& fence : fences_) {
    if (fence != nullptr) gl_.DeleteSync(fence);
    fence = nullptr;
  }
}

}  // namespace plexway::gl
