#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include <plexway/error.hpp>

#include "executors/gl/context.hpp"

namespace plexway::detail::gl {

/// A storage buffer. Its owner releases it within a Session.
class Buffer {
 public:
  explicit Buffer(const char* what) : what_(what) {}
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  [[nodiscard]] GLuint name() const { return name_; }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] const char* what() const { return what_; }

  /// Room for at least so many bytes; what was there is lost if it has to grow. Throws
  /// NotBuiltError if a shader could not see them all, or the device has no room.
  void reserve(const Session& session, std::size_t bytes) {
    if (name_ != 0 && bytes_ >= bytes) return;
    release(session);
    check(session, bytes);
    while (session.gl.GetError() != GL_NO_ERROR) {
    }
    session.gl.GenBuffers(1, &name_);
    session.gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, name_);
    const std::size_t wanted = bytes < 16 ? 16 : bytes;
    const auto size = static_cast<GLsizeiptr>(wanted);
    // Immutable storage stays on the device; the other kind some drivers move to where the
    // processor reads it.
    if (session.gl.BufferStorage != nullptr)
      session.gl.BufferStorage(GL_SHADER_STORAGE_BUFFER, size, nullptr, GL_DYNAMIC_STORAGE_BIT);
    else
      session.gl.BufferData(GL_SHADER_STORAGE_BUFFER, size, nullptr, GL_DYNAMIC_COPY);
    if (session.gl.GetError() != GL_NO_ERROR) {
      release(session);
      throw NotBuiltError("the GL device has no room for " + size_of(bytes) + " of " + what_);
    }
    bytes_ = wanted;
  }

  /// Copies bytes of another buffer into this one.
  void copy(const Session& session, const Buffer& from, std::size_t at, std::size_t to,
            std::size_t bytes) {
    session.gl.BindBuffer(GL_COPY_READ_BUFFER, from.name_);
    session.gl.BindBuffer(GL_COPY_WRITE_BUFFER, name_);
    session.gl.CopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER,
                                 static_cast<GLintptr>(at), static_cast<GLintptr>(to),
                                 static_cast<GLsizeiptr>(bytes));
  }
  void swap(Buffer& other) {
    std::swap(name_, other.name_);
    std::swap(bytes_, other.bytes_);
  }

  void release(const Session& session) {
    if (name_ != 0) session.gl.DeleteBuffers(1, &name_);
    name_ = 0, bytes_ = 0;
  }

  /// Throws NotBuiltError if a shader could not see so many bytes.
  void check(const Session& session, std::size_t bytes) const {
    if (bytes > session.limits().block)
      throw NotBuiltError(size_of(bytes) + " of " + what_ +
                          " are more than a shader can see of one buffer on this GL device: " +
                          size_of(session.limits().block) +
                          " (GL_MAX_SHADER_STORAGE_BLOCK_SIZE); use another executor");
  }

  template <class T>
  void write(const Session& session, std::span<const T> values, std::size_t first = 0) {
    if (values.empty()) return;
    session.gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, name_);
    session.gl.BufferSubData(GL_SHADER_STORAGE_BUFFER, static_cast<GLintptr>(first * sizeof(T)),
                             static_cast<GLsizeiptr>(values.size_bytes()), values.data());
  }
  /// Room for all of them, and they are written.
  template <class T>
  void upload(const Session& session, std::span<const T> values) {
    reserve(session, values.size_bytes());
    write(session, values);
  }
  template <class T>
  void read(const Session& session, std::span<T> values, std::size_t first = 0) const {
    if (values.empty()) return;
    session.gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, name_);
    session.gl.GetBufferSubData(GL_SHADER_STORAGE_BUFFER, static_cast<GLintptr>(first * sizeof(T)),
                                static_cast<GLsizeiptr>(values.size_bytes()), values.data());
  }
  /// The first `count` numbers all become `value`.
  void fill(const Session& session, GLuint value, std::size_t count) {
    if (count == 0) return;
    session.gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, name_);
    session.gl.ClearBufferSubData(GL_SHADER_STORAGE_BUFFER, GL_R32UI, 0,
                                  static_cast<GLsizeiptr>(count * sizeof(GLuint)), GL_RED_INTEGER,
                                  GL_UNSIGNED_INT, &value);
  }
  void bind(const Session& session, GLuint binding) const {
    session.gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name_);
  }

 private:
  static std::string size_of(std::size_t bytes) {
    return std::to_string((bytes + 1048575) / 1048576) + " MiB";
  }

  const char* what_;
  GLuint name_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace plexway::detail::gl
