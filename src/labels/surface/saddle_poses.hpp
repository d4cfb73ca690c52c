#pragma once

#include <cstddef>

#include <plexway/surface/detail/triangle_record.hpp>

#include "labels/surface/saddle_label.hpp"
#include "labels/surface/saddle_step.hpp"

namespace plexway::detail {

/// Labels of triangles under Visibility::saddles as the step takes them, and back.
template <class Real>
struct SaddlePoses {
  using Label = SaddleLabel<Real>;
  using Posed = PosedSaddles<Real>;
  using Point = typename Posed::Point;

  [[nodiscard]] static Posed posed(const Label& label) {
    Posed p;
    p.source = {{label.x[0]}, label.h[0]};
    p.limit[0] = {{label.x[0] + label.x[2]}, label.h[0] + label.h[2]};
    p.limit[1] = {{label.x[0] + label.x[3]}, label.h[0] + label.h[3]};
    p.sigma = label.sigma();
    return p;
  }

  [[nodiscard]] static Label packed(const Posed& label, Real d) {
    const Point &S = label.source, &l = label.limit[0], &r = label.limit[1];
    return {kernel::Lanes<Real>(S.x[0], label.sigma, l.x[0] - S.x[0], r.x[0] - S.x[0]),
            kernel::Lanes<Real>(S.h, d, l.h - S.h, r.h - S.h)};
  }

  /// A path of length sigma ends at the first corner of the edge.
  [[nodiscard]] static Posed at_corner(Real sigma) {
    Posed p;
    p.source = p.limit[0] = p.limit[1] = {{Real(0)}, Real(0)};
    p.sigma = sigma;
    return p;
  }

  /// A label posed on edge `in` of a triangle, posed on another edge, as a neighbour there that
  /// runs the other way sees it; and which end of that edge the two share.
  [[nodiscard]] static Posed turned(const TriangleRecord<Real>& t, Posed p, std::size_t in,
                                    std::size_t edge, int& pivot) {
    if (edge == in) {  // only from a source inside
      p.source = {{t.length[in] - p.source.x[0]}, -p.source.h};
      p.limit[0] = p.limit[1] = p.source;
      pivot = -1;
      return p;
    }
    const bool left = edge == (in == 0 ? 2 : in - 1);
    pivot = left ? 0 : 1;
    const std::size_t corner = left ? in : edge;
    return kernel::SaddleKernel<Real>::turn_label(p, left, t.length[in], t.length[edge],
                                                  t.cosine[corner], t.sine(corner));
  }

  /// Edge k of a triangle, as those who come in by it see it.
  template <class Number = Real>
  [[nodiscard]] static SaddleHinge<Number> hinge_of(const TriangleRecord<Real>& t, std::size_t k,
                                                    int pivot) {
    SaddleHinge<Number> hinge;
    hinge.extent = static_cast<Number>(t.length[k]);
    hinge.apex = {{static_cast<Number>(t.apex_x(k))}, static_cast<Number>(t.apex_h(k))};
    hinge.saddle[0] = t.saddle(k);
    hinge.saddle[1] = t.saddle(k == 2 ? 0 : k + 1);
    hinge.pivot = pivot;
    return hinge;
  }
};

}  // namespace plexway::detail
