#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <plexway/executors.hpp>

namespace plexway {

class GLWorkspace;

/// OpenGL compute shaders, on a graphics processor or on Mesa's software renderer; no window.
///
/// A context and the shaders it has compiled are made at first use, once a process and device, and
/// then kept (some 0.1 to 1 s). Any thread may call; calls on one device take turns, and what
/// context was current in the thread is so again afterwards.
///
/// Everything here throws NotBuiltError, saying what is missing, where the machine has no EGL, no
/// OpenGL 4.3, or too small a buffer for the domain.
///
/// A solve (solve.hpp) is as by Serial with these differences. Many labels are expanded at once, in
/// rounds, with the same bits each time. They differ from Serial's as those of two schedules of
/// Serial do, 2e-4 to 1e-3 in the mean and 1e-2 at worst, and are as near to the exact ones
/// (docs/contributing/methods/executors.md). On wireframes they are those of Serial to the bit.
/// Numbers are single precision; UsageError for more than 2^27 sources. Progress is reported every
/// few rounds. A bounded search costs memory and time for the whole domain. For many fields
/// `solve_each` is what a graphics processor does best. Source: Trettner, Bommes, Kobbelt: Geodesic
/// Distance Computation via Virtual Source Propagation, SGP 2021, section 5.
struct GL {
  /// Its rows in the table of support.hpp.
  static constexpr ExecutorKind kind = ExecutorKind::gl;
  /// Its state from call to call.
  using Workspace = GLWorkspace;

  /// Its number in gl_devices(); -1: the first that is not software, or the first.
  int device = -1;
  /// Room for so many waiting labels at first; 0: chosen by the domain. It grows when needed.
  std::size_t queue = 0;
  /// Bytes on the device that the fields of one launch may take together (`solve_each`).
  std::size_t batch_bytes = std::size_t{1} << 30;
};

/// The devices that EGL offers on this machine.
struct GLDevice {
  /// For GL::device.
  int number = 0;
  ///@{
  /// As OpenGL's driver reports it.
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
