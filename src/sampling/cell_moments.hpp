#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "executors/solid_growth.hpp"
#include "executors/surface_growth.hpp"

namespace plexway::detail {

/// What cells are around their seeds: content, energy, and the mean of the vectors from the seed.
template <class Complex>
class CellMoments;

/// On a surface vectors are polar: the direction at the seed of the path to a triangle's centre,
/// and its length. Directions are known in the frame of the edge that a label came in by; frames
/// are carried from triangle to triangle along the way that labels took.
template <class Real>
class CellMoments<TriangleMesh<Real>> {
 public:
  using Vector = std::array<double, 2>;  ///< in the frame of edge 0 of the seed's triangle
  using Place = std::pair<Index, Weights>;

  CellMoments(const TriangleMesh<Real>& mesh, Growth<TriangleMesh<Real>>& field)
      : triangles_(mesh.triangles()), field_(field), frame_(mesh.face_count()) {
    still_.reserve(frame_.size());
    for (Index f = 0; f < frame_.size(); ++f) {
      Real sides = 0;
      for (const Real l : triangles_[f].length) sides += l * l;
      still_.push_back({field_.measure(f), sides / 36});
    }
  }

  /// `add(cell, content, vector, squared length, own)`: own is the triangle's share of the energy
  /// about its own centre.
  template <class Add>
  void each(std::span<const Place> seeds, Add add) {
    std::fill(frame_.begin(), frame_.end(), Frame{0, 0, unknown, 0});
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const Index f = seeds[i].first;
      if (field_.reached(f) && field_.source(f) == i) frame_[f] = {1, 0, known, 0};
    }
    for (Index f = 0; f < frame_.size(); ++f) {
      if (!field_.reached(f)) continue;
      resolve(f);
      const Frame& frame = frame_[f];
      const double d = static_cast<double>(field_.distance(f));
      Vector vector = {0, 0};
      if (frame.state == known || frame.state == bent) {
        const auto [x, y] = direction(f);
        vector = {d * x, d * y};
      }
      add(field_.source(f), static_cast<double>(still_[f].content), vector, d * d,
          static_cast<double>(still_[f].own));
    }
  }

  /// Straight ahead from a seed; stops at a boundary.
  Place walk(Place from, Vector way) const {
    auto [f, w] = from;
    double left = std::hypot(way[0], way[1]);
    if (!(left > 0)) return from;
    double ux = way[0] / left, uy = way[1] / left;
    std::size_t base = 0;  // the frame's edge
    std::size_t in = 3;    // the edge it came by
    for (int steps = 0; steps < 100000; ++steps) {
      const auto& t = triangles_[f];
      const std::size_t second = edge_after(base), third = edge_before(base);
      const double ax = static_cast<double>(t.apex_x(base)),
                   ah = static_cast<double>(t.apex_h(base));
      const double length = static_cast<double>(t.length[base]);
      const double cx[3] = {0, length, ax}, cy[3] = {0, 0, ah};
      const std::size_t corner[3] = {base, second, third};
      double x = 0, y = 0;
      for (std::size_t i = 0; i < 3; ++i) x += w[corner[i]] * cx[i], y += w[corner[i]] * cy[i];
      // The edge it leaves by.
      double nearest = std::numeric_limits<double>::infinity(), at = 0;
      std::size_t exit = 3;
      for (std::size_t i = 0; i < 3; ++i) {
        if (corner[i] == in) continue;
        const std::size_t j = (i + 1) % 3;
        const double ex = cx[j] - cx[i], ey = cy[j] - cy[i];
        const double across = ux * ey - uy * ex;
        if (!(across > 0)) continue;
        const double s = ((cx[i] - x) * ey - (cy[i] - y) * ex) / across;
        if (s < nearest) {
          nearest = std::max(s, 0.), exit = i;
          at = std::clamp(((cx[i] - x) * uy - (cy[i] - y) * ux) / across, 0., 1.);
        }
      }
      const double step = std::min(left, nearest);
      if (exit == 3 || !(nearest < left)) {
        x += step * ux, y += step * uy;
        const double b2 = ah > 0 ? y / ah : 0, b1 = length > 0 ? (x - b2 * ax) / length : 0;
        w = {};
        w[corner[0]] = 1 - b1 - b2, w[corner[1]] = b1, w[corner[2]] = b2;
        return {f, inside(w)};
      }
      const Index across = t.across[corner[exit]];
      const Index g = across >> Across::face_shift;
      Weights on{};
      on[corner[exit]] = 1 - at, on[edge_after(corner[exit])] = at;
      if (g == field_.simplices()) return {f, inside(on)};
      left -= step;
      const std::size_t k = across & Across::edge_mask;
      // Along the edge from its first corner, and off it, into g.
      const std::size_t j = (exit + 1) % 3;
      const double ex = (cx[j] - cx[exit]), ey = (cy[j] - cy[exit]), e = std::hypot(ex, ey);
      const double along = e > 0 ? (ux * ex + uy * ey) / e : 1,
                   off = e > 0 ? (ux * ey - uy * ex) / e : 0;
      const bool flip = (across & Across::flip) != 0;
      ux = flip ? along : -along, uy = off;
      w = {};
      w[k] = flip ? 1 - at : at, w[edge_after(k)] = flip ? at : 1 - at;
      f = g, base = in = k;
    }
    return {f, inside(w)};
  }

  /// Off the corners and edges, so that a seed's triangle has a label of its own.
  static Weights inside(Weights w) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += w[i] = std::max(w[i], 1e-4);
    for (std::size_t i = 0; i < 3; ++i) w[i] /= sum;
    return w;
  }

 private:
  enum State : std::uint8_t { unknown, busy, known, bent, lost };
  // The x axis of the edge a label came in by, in the seed's frame; where paths bend, the direction
  // at the seed instead.
  struct Frame {
    float x, y;
    State state;
    std::uint8_t unused;
  };

  // Where a label's path did not bend yet, S is the seed itself.
  [[nodiscard]] bool straight(Index f) const { return !(field_.label(f).sigma() > 0); }

  std::array<double, 2> direction(Index f) const {
    const Frame& frame = frame_[f];
    if (frame.state == bent) return {static_cast<double>(frame.x), static_cast<double>(frame.y)};
    const auto& t = triangles_[f];
    const std::size_t in = field_.hinge(f);
    const auto& label = field_.label(f);
    const double x = static_cast<double>((t.length[in] + t.apex_x(in)) / 3 - label.x[0]);
    const double y = static_cast<double>(t.apex_h(in) / 3 + label.h[0]);
    const double length = std::sqrt(x * x + y * y);
    if (!(length > 0)) return {0, 0};
    const double fx = static_cast<double>(frame.x), fy = static_cast<double>(frame.y);
    return {(x * fx - y * fy) / length, (x * fy + y * fx) / length};
  }

  void resolve(Index f) {
    stack_.clear();
    while (frame_[f].state == unknown) {
      frame_[f].state = busy;
      stack_.push_back(f);
      const Index g = triangles_[f].across[field_.hinge(f)] >> Across::face_shift;
      if (g == field_.simplices() || !field_.reached(g) || field_.source(g) != field_.source(f)) {
        // Where it came from belongs to others by now.
        frame_[f].state = lost;
        stack_.pop_back();
        for (std::size_t edge = 0; edge < 3; ++edge) {
          const Index h = triangles_[f].across[edge] >> Across::face_shift;
          if (h != field_.simplices() && field_.reached(h) &&
              field_.source(h) == field_.source(f) && carry(h, f, edge))
            break;
        }
        break;
      }
      f = g;
    }
    while (!stack_.empty()) {
      const Index h = stack_.back();
      stack_.pop_back();
      const std::size_t edge = field_.hinge(h);
      const Index g = triangles_[h].across[edge] >> Across::face_shift;
      if (!carry(g, h, edge)) frame_[h].state = lost;
    }
  }

  /// The frame of f from that of its neighbour g over an edge of f.
  bool carry(Index g, Index f, std::size_t edge) {
    const Frame& from = frame_[g];
    if (from.state != known && from.state != bent) return false;
    if (from.state == bent || !straight(f)) {
      const auto [x, y] = direction(g);
      frame_[f] = {static_cast<float>(x), static_cast<float>(y), bent, 0};
      return true;
    }
    const Index across = triangles_[f].across[edge];
    if (across & Across::special) return false;
    // Axis of g's edge in g's frame, the other way round; then from f's edge to the one it came by.
    auto axis = edge_axis(g, field_.hinge(g), across & Across::edge_mask);
    double x = -(axis[0] * static_cast<double>(from.x) - axis[1] * static_cast<double>(from.y));
    double y = -(axis[0] * static_cast<double>(from.y) + axis[1] * static_cast<double>(from.x));
    axis = edge_axis(f, edge, field_.hinge(f));
    frame_[f] = {static_cast<float>(axis[0] * x - axis[1] * y),
                 static_cast<float>(axis[0] * y + axis[1] * x), known, 0};
    return true;
  }

  /// Direction of an edge in the frame of another of the same triangle.
  [[nodiscard]] std::array<double, 2> edge_axis(Index f, std::size_t frame,
                                                std::size_t edge) const {
    const auto& t = triangles_[f];
    if (edge == frame) return {1, 0};
    const std::size_t corner = edge == edge_after(frame) ? edge : frame;
    const double c = static_cast<double>(t.cosine[corner]), s = static_cast<double>(t.sine(corner));
    return {-c, edge == edge_after(frame) ? s : -s};
  }

  std::span<const TriangleRecord<Real>> triangles_;
  Growth<TriangleMesh<Real>>& field_;
  std::vector<Frame> frame_;
  struct Still {
    Real content, own;
  };
  std::vector<Still> still_;  // what does not change
  std::vector<Index> stack_;
};

/// In a solid vectors are those of space, towards the first bend.
template <class Real>
class CellMoments<TetMesh<Real>> {
 public:
  using Vector = std::array<double, 3>;
  using Place = std::pair<Index, Weights>;

  CellMoments(const TetMesh<Real>& mesh, Growth<TetMesh<Real>>& field)
      : mesh_(mesh), field_(field) {}

  template <class Add>
  void each(std::span<const Place> seeds, Add add) {
    for (Index t = 0; t < field_.simplices(); ++t) {
      if (!field_.reached(t)) continue;
      const auto bend = field_.first_bend(t);
      const auto& seed = seeds[field_.source(t)];
      const auto way = bend - field_.position(seed.first, seed.second);
      const double d = static_cast<double>(field_.distance(t));
      const double length = norm(way);
      const double scale = length > 0 ? d / length : 0;
      const Vector3<double> centre = field_.position(t, {.25, .25, .25, .25});
      double own = 0;
      for (const Index v : mesh_.tets()[t].corner) {
        const Vector3<double> r = mesh_.points()[v] - centre;
        own += dot(r, r) / 20;
      }
      add(field_.source(t), static_cast<double>(field_.measure(t)),
          {scale * way.x, scale * way.y, scale * way.z}, d * d, own);
    }
  }

  Place walk(Place from, Vector way) const {
    auto [t, w] = from;
    double left = 1;
    for (int steps = 0; steps < 100000; ++steps) {
      const auto& record = mesh_.tets()[t];
      const auto gain = rates(t, way);
      double nearest = left;
      std::size_t exit = 4;
      for (std::size_t i = 0; i < 4; ++i)
        if (gain[i] < 0 && w[i] + nearest * gain[i] < 0)
          nearest = std::max(0., -w[i] / gain[i]), exit = i;
      Weights next{};
      for (std::size_t i = 0; i < 4; ++i) next[i] = std::max(0., w[i] + nearest * gain[i]);
      left -= nearest;
      const Index across = exit < 4 ? record.across[exit] : 0;
      const Index u = across >> TetAcross::tet_shift;
      if (exit == 4 || u == field_.simplices()) return {t, inside(next)};
      Weights there{};
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
          if (i != exit && mesh_.tets()[u].corner[j] == record.corner[i]) there[j] = next[i];
      t = u, w = there;
    }
    return {t, inside(w)};
  }

  static Weights inside(Weights w) {
    double sum = 0;
    for (double& x : w) sum += x = std::max(x, 1e-4);
    for (double& x : w) x /= sum;
    return w;
  }

 private:
  // How the weights change along a vector.
  [[nodiscard]] Weights rates(Index t, const Vector& way) const {
    const Index* v = mesh_.tets()[t].corner;
    const auto p = mesh_.points();
    const auto a = p[v[1]] - p[v[0]], b = p[v[2]] - p[v[0]], c = p[v[3]] - p[v[0]];
    const Vector3<double> d = {way[0], way[1], way[2]};
    const double volume = dot(a, cross(b, c));
    if (!(std::abs(volume) > 0)) return {};
    const double x = dot(d, cross(b, c)) / volume, y = dot(a, cross(d, c)) / volume,
                 z = dot(a, cross(b, d)) / volume;
    return {-x - y - z, x, y, z};
  }

  const TetMesh<Real>& mesh_;
  Growth<TetMesh<Real>>& field_;
};

}  // namespace plexway::detail
