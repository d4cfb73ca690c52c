#include "executors/gl/workspace.hpp"

namespace plexway {

GLWorkspace::Implementation::Implementation()
    : vertex_best("vertex distances"),
      vertex_source("vertex labels"),
      distances("distances"),
      sources("labels"),
      small("numbers") {}

GLWorkspace::Implementation::~Implementation() {
  if (!context) return;
  try {
    const gl::Session session(*context);
    release(session);
  } catch (const Error&) {  // the device is gone, and what was on it
  }
}

void GLWorkspace::Implementation::use(const std::shared_ptr<gl::Context>& wanted) {
  if (context == wanted) return;
  if (context) {
    const gl::Session session(*context);
    release(session);
  }
  context = wanted;
}

void GLWorkspace::Implementation::release(const gl::Session& session) {
  front.release(session);
  if (domain) domain->release(session);
  domain.reset();
  for (gl::Buffer* b : {&vertex_best, &vertex_source, &distances, &sources, &small})
    b->release(session);
}

std::size_t GLWorkspace::Implementation::bytes() const {
  std::size_t sum = front.bytes() + (domain ? domain->bytes() : 0);
  for (const gl::Buffer* b : {&vertex_best, &vertex_source, &distances, &sources, &small})
    sum += b->bytes();
  return sum;
}

GLWorkspace::GLWorkspace() : implementation_(std::make_unique<Implementation>()) {}
GLWorkspace::~GLWorkspace() = default;
GLWorkspace::GLWorkspace(GLWorkspace&&) noexcept = default;
GLWorkspace& GLWorkspace::operator=(GLWorkspace&&) noexcept = default;

std::size_t GLWorkspace::bytes() const { return implementation_->bytes(); }
std::size_t GLWorkspace::growths() const { return implementation_->front.growths(); }
std::size_t GLWorkspace::rounds() const { return implementation_->rounds; }

}  // namespace plexway
