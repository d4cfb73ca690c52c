#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "executors/gl/front.hpp"
#include "labels/workspace_state.hpp"

namespace plexway {

/// What a solve keeps on the device. Domains bring their own buffers.
struct GLWorkspace::Implementation {
  struct DomainBuffers {
    virtual ~DomainBuffers() = default;
    [[nodiscard]] virtual std::vector<detail::gl::Buffer*> all() = 0;
  };

  Implementation();
  ~Implementation();
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  /// Everything goes to another device.
  void use(const std::shared_ptr<detail::gl::Context>& wanted);
  void release(const detail::gl::Session& session);
  void release_domain(const detail::gl::Session& session);
  [[nodiscard]] std::size_t bytes();

  /// The buffers of a domain, made by `make` unless those that are there have this `identity`.
  template <class Buffers, class Make>
  Buffers& domain_buffers(const detail::gl::Session& session, std::uint64_t identity, Make make) {
    // Domains of two types have no identity in common.
    if (domain && domain_identity == identity) return static_cast<Buffers&>(*domain);
    release_domain(session);
    domain_identity = 0;  // until all of the new one has arrived
    auto fresh = std::make_unique<Buffers>();
    Buffers& buffers = *fresh;
    domain = std::move(fresh);
    make(buffers);
    domain_identity = identity;
    return buffers;
  }

  std::shared_ptr<detail::gl::Context> context;
  detail::gl::Front front;
  std::unique_ptr<DomainBuffers> domain;
  std::uint64_t domain_identity = 0;
  detail::gl::Buffer vertex_best, vertex_source, distances, sources, small;
  detail::WorkspaceState<float> host;  // for seeds
  std::size_t rounds = 0;
};

}  // namespace plexway
