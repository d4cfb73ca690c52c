#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <plexway/executors.hpp>
#include <plexway/solve.hpp>

/// @file
/// The component `gl`: link plexway::gl.
namespace plexway {

/// What EGL offers on this machine.
struct GLDevice {
  /// For GL::device.
  int number = 0;
  ///@{
  /// As OpenGL's driver says.
  std::string vendor, renderer, version;
  ///@}
  bool software = false;           ///< computes on the processor
  std::size_t largest_buffer = 0;  ///< bytes a shader can see of one buffer
  std::size_t group_size = 0;      ///< invocations in a work group
  std::string problem;             ///< why it cannot be used; empty if it can
};

/// All devices, also those that cannot be used. Throws NotBuiltError if there is no EGL at all.
[[nodiscard]] std::vector<GLDevice> gl_devices();

/// The one that `executor` runs on.
[[nodiscard]] GLDevice gl_device(const GL& executor);

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
