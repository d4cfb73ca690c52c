#pragma once

#include <cmath>
#include <limits>

#include <plexway/solid/detail/tet_record.hpp>

#include "kernel/hinge.hpp"

namespace plexway::kernel {

// As GLSL has it.
constexpr float clamp(float a, float least, float most) {
  return a < least ? least : most < a ? most : a;
}
constexpr double clamp(double a, double least, double most) {
  return a < least ? least : most < a ? most : a;
}

#include "kernel/text_begin.inl"

/// What reflex edges hide from where: the text of solid_sight.inl, which shaders compile as well.
template <class Real_>
struct SolidSight {
  using Real = Real_;
  using Point = Vector3<Real>;
  using Edge = ReflexEdge<Real>;
#include "labels/solid/solid_sight.inl"
};

#include "kernel/text_end.inl"

}  // namespace plexway::kernel

namespace plexway {

/// Where the segment from `eye` to q crosses the plane of a, b, c, or the end nearest to it.
template <class Real>
Vector3<Real> plane_crossing(const Vector3<Real>& eye, const Vector3<Real>& q,
                             const Vector3<Real>& a, const Vector3<Real>& b,
                             const Vector3<Real>& c) {
  const Vector3<Real> normal = cross(b - a, c - a);
  const Real from = dot(normal, eye - a), to = dot(normal, q - a);
  const Real share = from == to ? Real(0.5) : kernel::clamp(from / (from - to), Real(0), Real(1));
  return eye + share * (q - eye);
}

}  // namespace plexway
