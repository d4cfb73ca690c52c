#pragma once

#include <cstdint>
#include <limits>

#if defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

#include "kernel/hinge.hpp"

#pragma GCC diagnostic push
// Vectors of four doubles never cross a function boundary here: everything is inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

/// Four numbers at once, as a Real for the hinge kernel. Vector extensions of gcc and clang, so one
/// text serves every processor they know.
namespace plexway::detail::kernel {

template <class Real>
struct LaneTypes;
template <>
struct LaneTypes<float> {
  using Integer = std::int32_t;
  typedef float Vector __attribute__((vector_size(16)));
  typedef std::int32_t Mask __attribute__((vector_size(16)));
};
template <>
struct LaneTypes<double> {
  using Integer = std::int64_t;
  typedef double Vector __attribute__((vector_size(32)));
  typedef std::int64_t Mask __attribute__((vector_size(32)));
};

template <class Real>
struct Lanes {
  using Integer = typename LaneTypes<Real>::Integer;
  using Vector = typename LaneTypes<Real>::Vector;
  using Mask = typename LaneTypes<Real>::Mask;

  Vector v;

  Lanes() = default;
  [[gnu::always_inline]] Lanes(Vector vector) : v(vector) {}
  [[gnu::always_inline]] Lanes(Real all) : v{all, all, all, all} {}
  [[gnu::always_inline]] Lanes(Real a, Real b, Real c, Real d) : v{a, b, c, d} {}
  [[gnu::always_inline]] Real operator[](int i) const { return v[i]; }

  [[gnu::always_inline]] friend Lanes operator+(Lanes a, Lanes b) { return a.v + b.v; }
  [[gnu::always_inline]] friend Lanes operator-(Lanes a, Lanes b) { return a.v - b.v; }
  [[gnu::always_inline]] friend Lanes operator*(Lanes a, Lanes b) { return a.v * b.v; }
  [[gnu::always_inline]] friend Lanes operator/(Lanes a, Lanes b) { return a.v / b.v; }
  [[gnu::always_inline]] friend Lanes operator-(Lanes a) { return -a.v; }
  [[gnu::always_inline]] friend Lanes& operator+=(Lanes& a, Lanes b) { return a = a + b; }
  [[gnu::always_inline]] friend Mask operator>(Lanes a, Lanes b) { return a.v > b.v; }
  [[gnu::always_inline]] friend Mask operator<(Lanes a, Lanes b) { return a.v < b.v; }
  [[gnu::always_inline]] friend Lanes abs(Lanes a) {
    constexpr Integer rest = std::numeric_limits<Integer>::max();
    return (Vector)((Mask)a.v & Mask{rest, rest, rest, rest});
  }
  [[gnu::always_inline]] friend Lanes max(Lanes a, Lanes b) {
#if defined(__SSE2__)
    if constexpr (sizeof(Real) == 4) return __builtin_ia32_maxps(b.v, a.v);
#elif defined(__wasm_simd128__)
    if constexpr (sizeof(Real) == 4) return (Vector)wasm_f32x4_pmax((v128_t)a.v, (v128_t)b.v);
#endif
    return b.v > a.v ? b.v : a.v;
  }
  [[gnu::always_inline]] friend Lanes min(Lanes a, Lanes b) {
#if defined(__SSE2__)
    if constexpr (sizeof(Real) == 4) return __builtin_ia32_minps(b.v, a.v);
#elif defined(__wasm_simd128__)
    if constexpr (sizeof(Real) == 4) return (Vector)wasm_f32x4_pmin((v128_t)a.v, (v128_t)b.v);
#endif
    return b.v < a.v ? b.v : a.v;
  }
  [[gnu::always_inline]] friend Lanes select(Mask condition, Lanes a, Lanes b) {
#if defined(__wasm_simd128__)
    if constexpr (sizeof(Real) == 4)
      return (Vector)wasm_v128_bitselect((v128_t)a.v, (v128_t)b.v, (v128_t)condition);
#endif
    return condition ? a.v : b.v;
  }
  [[gnu::always_inline]] friend Lanes sqrt(Lanes a) {
#if defined(__wasm_simd128__)
    if constexpr (sizeof(Real) == 4) return (Vector)wasm_f32x4_sqrt((v128_t)a.v);
#endif
    for (int i = 0; i < 4; ++i) a.v[i] = kernel::sqrt(a.v[i]);
    return a;
  }
};

/// Bit i is set where lane i of `mask` is (all its bits or none).
template <class Mask>
[[gnu::always_inline]] inline int lane_bits(Mask mask) {
#if defined(__SSE2__)
  if constexpr (sizeof(Mask) == 16) {
    typedef float Vector __attribute__((vector_size(16)));
    return __builtin_ia32_movmskps((Vector)mask);
  } else {
    typedef double Half __attribute__((vector_size(16)));
    const auto low = __builtin_shufflevector(mask, mask, 0, 1);
    const auto high = __builtin_shufflevector(mask, mask, 2, 3);
    return __builtin_ia32_movmskpd((Half)low) | __builtin_ia32_movmskpd((Half)high) << 2;
  }
#else
#if defined(__wasm_simd128__)
  if constexpr (sizeof(Mask) == 16) return static_cast<int>(wasm_i32x4_bitmask((v128_t)mask));
#endif
  int bits = 0;
  for (int i = 0; i < 4; ++i) bits |= mask[i] ? 1 << i : 0;
  return bits;
#endif
}

}  // namespace plexway::detail::kernel

template <class Real>
struct std::numeric_limits<plexway::detail::kernel::Lanes<Real>> : std::numeric_limits<Real> {};

#pragma GCC diagnostic pop
