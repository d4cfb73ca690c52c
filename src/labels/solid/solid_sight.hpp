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
