#pragma once

#include <cmath>
#include <limits>

/// Floor 0: the geometry of one update, by hinge dimension K and number type Real. No dependency.
namespace plexway::detail::kernel {

// The GLSL built-ins the kernel text uses. As in shaders, a NaN in the second argument of max is
// dropped. A SIMD Real brings its own, found by argument-dependent lookup.
constexpr float max(float a, float b) { return b > a ? b : a; }
constexpr double max(double a, double b) { return b > a ? b : a; }
constexpr float min(float a, float b) { return b < a ? b : a; }
constexpr double min(double a, double b) { return b < a ? b : a; }
constexpr float select(bool condition, float yes, float no) { return condition ? yes : no; }
constexpr double select(bool condition, double yes, double no) { return condition ? yes : no; }
inline float sqrt(float a) { return std::sqrt(a); }
inline double sqrt(double a) { return std::sqrt(a); }
inline float abs(float a) { return std::abs(a); }
inline double abs(double a) { return std::abs(a); }

#include "kernel/text_begin.inl"

/// Updates over an intersection of dimension K (0 a vertex, 1 an edge, 2 a triangle, 3 a
/// tetrahedron) in float, double, or a SIMD type with their operators, numeric_limits and the
/// built-ins above (down to `distance_squared`; what follows branches). All functions are static
/// and pure, allocate nothing and throw nothing. Lengths go in and come out squared unless named
/// `h`, `sigma`, `walked` or `total`; for float choose a unit in which edges are about 1.
///
/// A step in full: `make_pose`, `locate` S (from U) and the probe and vertices of T (from T),
/// `carry`, `distance_squared`.
///
/// The virtual sources are those of Trettner, Bommes, Kobbelt: Geodesic Distance Computation via
/// Virtual Source Propagation, SGP 2021, doi 10.1111/cgf.14371, there for triangles.
template <class Real_, int K_>
struct HingeKernel {
  static_assert(K_ >= 0 && K_ <= 3, "hinges have dimension 0, 1, 2 or 3");
  using Real = Real_;
  static constexpr int K = K_;
#include "kernel/hinge_kernel.inl"
};

#include "kernel/text_end.inl"

}  // namespace plexway::detail::kernel
