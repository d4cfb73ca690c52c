#pragma once

#include <cmath>
#include <limits>

#include <plexway/surface/detail/triangle_record.hpp>

#include "kernel/hinge.hpp"
#include "labels/surface/saddle_label.hpp"

/// One update under Visibility::saddles, hinge by hinge: the text of saddle_step.inl, which shaders
/// compile as well. saddle_step_lanes.hpp does the common case of both hinges of a triangle at
/// once; this is the rule it must agree with.
namespace plexway::detail::kernel {

#include "kernel/text_begin.inl"

template <class Real_>
struct SaddleKernel : HingeKernel<Real_, 1> {
  using Real = Real_;
  using Hinge = HingeKernel<Real_, 1>;
  using Hinge::crossing;
  using Hinge::distance_squared;
  using typename Hinge::HingeCrossing;
  using typename Hinge::HingePoint;
  using typename Hinge::HingePose;
#include "labels/surface/saddle_step.inl"
};

#include "kernel/text_end.inl"

}  // namespace plexway::detail::kernel

namespace plexway::detail {

/// A label under way to the next triangle.
template <class Real>
struct PosedSaddles : kernel::SaddleKernel<Real>::PosedSaddles {
  using Kernel = kernel::HingeKernel<Real, 1>;
  using Point = typename Kernel::HingePoint;
  using Plain = typename kernel::SaddleKernel<Real>::PosedSaddles;

  PosedSaddles() = default;
  PosedSaddles(const Plain& plain) : Plain(plain) {}
};

/// The hinge as the triangle beyond sees it.
template <class Real>
using SaddleHinge = typename kernel::SaddleKernel<Real>::SaddleHinge;

template <class Real>
Real left_of(const typename PosedSaddles<Real>::Point& S,
             const typename PosedSaddles<Real>::Point& p,
             const typename PosedSaddles<Real>::Point& q) {
  return kernel::SaddleKernel<Real>::left_of(S, p, q);
}

template <class Real>
void give_up_source(PosedSaddles<Real>& label, const typename PosedSaddles<Real>::Point& bend) {
  label = kernel::SaddleKernel<Real>::give_up_source(label, bend);
}

/// See saddle_step.inl.
template <class Real>
Real path_length(const PosedSaddles<Real>& label, Real length,
                 const typename PosedSaddles<Real>::Point& q) {
  return kernel::SaddleKernel<Real>::path_length(label, length, q);
}

/// See saddle_step.inl.
template <class Real>
Real cross_hinge(PosedSaddles<Real>& label, const SaddleHinge<Real>& hinge, bool last_resort) {
  const auto crossed = kernel::SaddleKernel<Real>::cross_hinge(label, hinge, last_resort);
  label = crossed.label;
  return crossed.distance;
}

}  // namespace plexway::detail
