#pragma once

#include <cstddef>
#include <memory>

#include <plexway/executors/gl_executor.hpp>
#include <plexway/solve.hpp>

/// @file
/// The component `gl`: link plexway::gl.
namespace plexway {

/// All that a propagation keeps on the device: the domain, labels, queues. Belongs to one domain
/// and one thread at a time; the domain is copied to the device when it is first met, so that a
/// workspace that is kept makes the second solve cheaper. Movable.
class GLWorkspace {
 public:
  GLWorkspace();
  ~GLWorkspace();
  /// Moves what it holds; what is left may be assigned to or destroyed, no more.
  GLWorkspace(GLWorkspace&&) noexcept;
  /// Likewise.
  GLWorkspace& operator=(GLWorkspace&&) noexcept;

  /// Bytes on the device.
  [[nodiscard]] std::size_t bytes() const;
  /// How often the queues had to grow during the last solve.
  [[nodiscard]] std::size_t growths() const;
  /// Rounds of the last solve: one launch each.
  [[nodiscard]] std::size_t rounds() const;

  struct Implementation;
  /// For the library's own use.
  [[nodiscard]] Implementation& implementation() { return *implementation_; }

 private:
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace plexway
