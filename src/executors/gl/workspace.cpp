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
    const detail::gl::Session session(*context);
    release(session);
  } catch (const Error&) {  // the device is gone, and what was on it
  }
}

void GLWorkspace::Implementation::use(const std::shared_ptr<detail::gl::Context>& wanted) {
  if (context == wanted) return;
  if (context) {
    const detail::gl::Session session(*context);
    release(session);
  }
  context = wanted;
}

void GLWorkspace::Implementation::release(const detail::gl::Session& session) {
  front.release(session);
  release_domain(session);
  for (detail::gl::Buffer* b : {&vertex_best, &vertex_source, &distances, &sources, &small})
    b->release(session);
}

void GLWorkspace::Implementation::release_domain(const detail::gl::Session& session) {
  if (domain)
    for (detail::gl::Buffer* b : domain->all()) b->release(session);
  domain.reset();
}

std::size_t GLWorkspace::Implementation::bytes() {
  std::size_t sum = front.bytes();
  if (domain)
    for (const detail::gl::Buffer* b : domain->all()) sum += b->bytes();
  for (const detail::gl::Buffer* b : {&vertex_best, &vertex_source, &distances, &sources, &small})
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
