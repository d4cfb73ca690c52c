#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include <plexway/propagate/workspace.hpp>

#include "executors/gl/front.hpp"

namespace plexway {

/// What a solve keeps on the device. Domains bring their own buffers.
struct GLWorkspace::Implementation {
  struct DomainBuffers {
    virtual ~DomainBuffers() = default;
    virtual void release(const gl::Session& session) = 0;
    [[nodiscard]] virtual std::size_t bytes() const = 0;
  };

  Implementation();
  ~Implementation();
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  /// Everything goes to another device.
  void use(const std::shared_ptr<gl::Context>& wanted);
  void release(const gl::Session& session);
  [[nodiscard]] std::size_t bytes() const;

  /// The buffers of a domain, made by `make` unless those that are there have this `identity`.
  template <class Buffers, class Make>
  Buffers& domain_buffers(const gl::Session& session, std::size_t identity, Make make) {
    if (domain && domain_identity == identity)
      if (auto* known = dynamic_cast<Buffers*>(domain.get())) return *known;
    if (domain) domain->release(session);
    domain.reset();
    auto fresh = std::make_unique<Buffers>();
    Buffers& buffers = *fresh;
    domain = std::move(fresh);
    make(buffers);
    domain_identity = identity;
    return buffers;
  }

  std::shared_ptr<gl::Context> context;
  gl::Front front;
  std::unique_ptr<DomainBuffers> domain;
  std::size_t domain_identity = 0;
  gl::Buffer vertex_best, vertex_source, distances, sources, small;
  Workspace<float> host;  // for seeds
  std::size_t rounds = 0;
};

namespace gl {

/// A number that tells domains apart: from their sizes and a sample of their content.
class Identity {
 public:
  void add(std::size_t value) { hash_ = (hash_ ^ value) * 1099511628211u; }
  template <class T>
  void add_sample(std::span<const T> values) {
    add(values.size());
    const auto* words = reinterpret_cast<const unsigned char*>(values.data());
    const std::size_t step = values.size() / 4096 + 1;
    for (std::size_t i = 0; i < values.size(); i += step)
      for (std::size_t b = 0; b < sizeof(T); b += 4) {
        std::uint32_t word = 0;
        std::memcpy(&word, words + i * sizeof(T) + b, 4);
        add(word);
      }
  }
  [[nodiscard]] std::size_t value() const { return hash_; }

 private:
  std::size_t hash_ = 14695981039346656037u;
};

}  // namespace gl
}  // namespace plexway
