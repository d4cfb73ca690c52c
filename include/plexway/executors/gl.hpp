#pragma once

#include <cstddef>
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

}  // namespace plexway
