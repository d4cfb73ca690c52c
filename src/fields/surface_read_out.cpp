#include "fields/surface_labels.hpp"

#include <algorithm>
#include <cmath>

#include "complexes/common/number_range.hpp"

namespace plexway::detail {
namespace {

using Kernel = kernel::SaddleKernel<double>;

}  // namespace

template <class Real>
bool SurfaceReadOut<Real>::step_over(Index f, std::size_t edge, Step& step) const {
  const Index across = triangles_[f].across[edge];
  step = {f, edge, across & Across::edge_mask, across >> Across::face_shift,
          (across & Across::flip) != 0};
  // Of more than two triangles on an edge any two are flat together, so one of them will do.
  return step.to != mesh_.face_count() && step.to != f;
}

template <class Real>
auto SurfaceReadOut<Real>::point_over(Index f, std::size_t edge,
                                      const std::array<double, 3>& weight) const -> Point {
  const TriangleRecord<Real>& t = triangles_[f];
  const double v = weight[edge_after(edge)], w = weight[edge_before(edge)];
  return {{v * static_cast<double>(t.length[edge]) + w * static_cast<double>(t.apex_x(edge))},
          w * static_cast<double>(t.apex_h(edge))};
}

// From one edge of f to another, as the neighbour beyond sees it.
template <class Real>
auto SurfaceReadOut<Real>::turned(Index f, const Posed& label, std::size_t from, std::size_t to,
                                  int& pivot) const -> Posed {
  const TriangleRecord<Real>& t = triangles_[f];
  const bool left = to == edge_before(from);
  pivot = left ? 0 : 1;
  const std::size_t corner = left ? from : to;
  return Kernel::turn_label(
      label, left, static_cast<double>(t.length[from]), static_cast<double>(t.length[to]),
      static_cast<double>(t.cosine[corner]), static_cast<double>(t.sine(corner)));
}

template <class Real>
double SurfaceReadOut<Real>::own(Index f, const std::array<double, 3>& weight) const {
  const std::size_t in = labels_.hinge(f);
  const Posed label = labels_.posed(f);
  const Point q = point_over(f, in, weight);
  if (label.source.h < 0)  // the source is in f
    return label.sigma + std::hypot(q.x[0] - label.source.x[0], q.h + label.source.h);
  return path_length<double>(label, static_cast<double>(triangles_[f].length[in]), q);
}

// The triangle beyond was reached from here, maybe by a label that is no longer ours: its source
// is on this side.
template <class Real>
double SurfaceReadOut<Real>::from_where_it_came(const Step& step, const Point& q) const {
  const Posed label = labels_.posed(step.to);
  const double length = static_cast<double>(triangles_[step.to].length[step.in]);
  const Point here = {{step.flip ? q.x[0] : length - q.x[0]}, -q.h};
  const auto gap = [](const Point& a, const Point& b) {
    return std::hypot(a.x[0] - b.x[0], a.h - b.h);
  };
  const Point there = {{here.x[0]}, q.h};  // on the source's side
  const double straight = gap(label.source, there);
  for (int side = 0; side < 2; ++side) {
    const Point& limit = label.limit[side];
    const double turn = left_of<double>(label.source, limit, here);
    const double to_limit = gap(label.source, limit);
    if ((side == 0 ? turn > 0 : turn < 0) && to_limit < straight)
      return label.sigma + to_limit + gap(limit, there);
  }
  return label.sigma + straight;
}

// The label at the end of a way of triangles, carried back to its beginning and to q there, which
// is posed on the first edge.
template <class Real>
double SurfaceReadOut<Real>::offered(const Step* steps, int count, const Point& q) const {
  const Step& last = steps[count - 1];
  if (!labels_.reached(last.to)) return infinity;
  Posed p = labels_.posed(last.to);
  std::size_t in = labels_.hinge(last.to);
  const bool inside = p.source.h < 0;
  if (in == last.in && !inside) return count == 1 ? from_where_it_came(last, q) : infinity;
  for (int n = count - 1; n >= 0; --n) {
    const Step& step = steps[n];
    const double length = static_cast<double>(triangles_[step.to].length[step.in]);
    int pivot = -1;
    if (in == step.in) {  // only from a source inside
      p.source = {{length - p.source.x[0]}, -p.source.h};
    } else {
      p = turned(step.to, p, in, step.in, pivot);
    }
    if (n == count - 1 && inside) {
      p.source.h = std::max(p.source.h, 0.);
      p.limit[0] = p.limit[1] = p.source;
      pivot = -1;
    }
    if (step.flip) {
      p = Kernel::mirror_label(p, length);
      if (pivot >= 0) pivot = 1 - pivot;
    }
    const SaddleHinge<double> hinge = labels_.hinge_of(step.from, step.out, pivot);
    if (!(cross_hinge<double>(p, hinge, false) < infinity)) return infinity;
    in = step.out;
  }
  return path_length<double>(p, static_cast<double>(triangles_[steps[0].from].length[in]), q);
}

template <class Real>
double SurfaceReadOut<Real>::at(Index f, const std::array<double, 3>& weight, ReadOut level) const {
  if (windows_) return windows_->at(f, weight);
  double best = labels_.reached(f) ? own(f, weight) : infinity;
  if (level == ReadOut::simplex) return best;
  const TriangleRecord<Real>& t = triangles_[f];
  for (std::size_t i = 0; i < 3; ++i) {
    const Point p = point_over(f, i, weight);
    best = std::min(
        best, static_cast<double>(solved_.workspace.vertex[t.corner[i]]) + std::hypot(p.x[0], p.h));
  }
  constexpr int most = 5;  // triangles to either side of a corner
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const Point q = point_over(f, edge, weight);
    for (const bool about_first : {true, false}) {
      Step steps[most];
      Index from = f;
      std::size_t out = edge;
      bool first = about_first;
      for (int n = 0; n < (level == ReadOut::star ? most : 1); ++n) {
        if (!step_over(from, out, steps[n])) break;
        best = std::min(best, offered(steps, n + 1, q));
        const std::size_t k = steps[n].in;
        out = first == steps[n].flip ? edge_before(k) : edge_after(k);
        first = first != steps[n].flip;
        from = steps[n].to;
        if (from == f) break;
      }
      if (level != ReadOut::star) break;
    }
  }
  return best;
}

template <class Real>
std::optional<std::array<double, 3>> SurfaceReadOut<Real>::towards(
    Index f, const std::array<double, 3>& weight) const {
  if (windows_) {
    const auto sight = windows_->look(f, weight);
    using Over = typename WindowReadOut<Real>::Sight::Over;
    return sight.over == Over::nothing ? std::nullopt : std::optional(sight.place);
  }
  if (!labels_.reached(f)) return std::nullopt;
  const TriangleRecord<Real>& t = triangles_[f];
  const std::size_t in = labels_.hinge(f), after = edge_after(in), apex = edge_before(in);
  const Point p = point_over(f, in, weight);
  const Vector2 q = {p.x[0], p.h};
  const double length = static_cast<double>(t.length[in]);
  const auto [source, nearest] = labels_.sight(f, q);
  auto bend = nearest;
  // What a point off the centre does not see over that edge it sees over another, unless it bends.
  const auto is_at = [&](double x) { return bend.x == x && bend.y == 0; };
  if ((is_at(0) && !t.saddle(in)) || (is_at(length) && !t.saddle(after))) bend = source;
  const Vector2 way = bend - q;
  const double height = static_cast<double>(t.apex_h(in));
  if (!(length > 0) || !(height > 0)) return std::nullopt;
  // As a change of the barycentric coordinates, as far as the rim.
  std::array<double, 3> change{};
  change[apex] = way.y / height;
  change[after] = (way.x - change[apex] * static_cast<double>(t.apex_x(in))) / length;
  change[in] = -change[apex] - change[after];
  double share = 1;
  for (std::size_t i = 0; i < 3; ++i)
    if (change[i] < 0) share = std::min(share, weight[i] / -change[i]);
  std::array<double, 3> place{};
  for (std::size_t i = 0; i < 3; ++i) place[i] = std::max(weight[i] + share * change[i], 0.);
  return place;
}

template class SurfaceReadOut<float>;
template class SurfaceReadOut<double>;

}  // namespace plexway::detail
