#include "paths/wire_trace.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "paths/edge_descent.hpp"
#include "paths/infinity.hpp"

namespace plexway {
namespace {

template <class Real>
class WireTrace {
 public:
  WireTrace(const Wireframe<Real>& wireframe, const Solved<Real>& solved)
      : wireframe_(wireframe), solved_(solved) {}

  Path trace(const PointSource& point) const {
    // A source inside an edge is reached from the edge's ends.
    struct End {
      double left = infinity;
      Index number = none;
    };
    std::unordered_map<Index, End> ends;
    const auto offer = [&](Index v, double left, std::size_t n) {
      End& known = ends[v];
      if (left < known.left) known = {left, static_cast<Index>(n)};
    };
    for (std::size_t n = 0; n < solved_.sources.size(); ++n) {
      const PointSource& s = solved_.sources[n];
      if (s.vertex != none) {
        offer(wireframe_.inside_vertex(s.vertex), s.offset, n);
        continue;
      }
      const auto edge = wireframe_.inside_edge(s.simplex);
      offer(edge.from, s.offset + s.barycentric[1] * length(s.simplex), n);
      offer(edge.to, s.offset + s.barycentric[0] * length(s.simplex), n);
    }
    const auto end = [&](Index v) {
      const auto found = ends.find(v);
      return found == ends.end() ? infinity : found->second.left;
    };
    const auto distance = [&](Index v) {
      return static_cast<double>(solved_.field.distance[solved_.outer[v]]);
    };
    const auto edges = [&](Index v, auto visit) {
      for (Index k = wireframe_.begin()[v]; k < wireframe_.begin()[v + 1]; ++k) {
        const auto& arc = wireframe_.arcs()[k];
        visit(arc.to, static_cast<double>(arc.length) * wireframe_.unit());
      }
    };

    // By either end of the target's edge, or straight to a source in it.
    Path best;
    const auto from = [&](Index v, const PointSource* inside, std::size_t corner) {
      if (!(distance(v) < infinity)) return;
      const std::vector<Index> way = descend_edges(v, distance, end, edges);
      if (way.empty()) return;
      const End& last = ends.at(way.back());
      Path path;
      path.length = 0;
      path.source = last.number;
      if (inside != nullptr) along_part(path, *inside, corner, false);
      for (std::size_t i = 0; i + 1 < way.size(); ++i) along_edge(path, way[i], way[i + 1]);
      const PointSource& source = solved_.sources[last.number];
      if (source.vertex == none) {
        const auto edge = wireframe_.inside_edge(source.simplex);
        const bool loop = edge.from == edge.to;  // the shorter way around
        const bool first =
            loop ? source.barycentric[1] <= source.barycentric[0] : edge.from == way.back();
        along_part(path, source, first ? 0 : 1, true);
      } else {
        finish(path, way.back());
      }
      keep(best, std::move(path));
    };
    if (point.vertex != none) {
      from(wireframe_.inside_vertex(point.vertex), nullptr, 0);
    } else {
      const auto edge = wireframe_.inside_edge(point.simplex);
      from(edge.from, &point, 0);
      from(edge.to, &point, 1);
      for (std::size_t n = 0; n < solved_.sources.size(); ++n) {
        const PointSource& s = solved_.sources[n];
        if (s.vertex != none || s.simplex != point.simplex) continue;
        Path path;
        path.source = static_cast<Index>(n);
        path.length = std::abs(s.barycentric[0] - point.barycentric[0]) * length(s.simplex);
        push(path, s.simplex, point.barycentric);
        push(path, s.simplex, s.barycentric);
        keep(best, std::move(path));
      }
    }
    place(best);
    return best;
  }

 private:
  [[nodiscard]] double length(Index edge) const {
    const auto ends = wireframe_.inside_edge(edge);
    if (solved_.positions.empty()) return static_cast<double>(ends.length) * wireframe_.unit();
    const auto &a = solved_.positions[solved_.outer[ends.from]],
               &b = solved_.positions[solved_.outer[ends.to]];
    return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  }

  static void push(Path& path, Index edge, const std::array<double, 4>& b) {
    path.points.push_back({edge, b});
  }

  /// From a point of an edge to its end, or from the end to the point.
  void along_part(Path& path, const PointSource& in, std::size_t corner, bool to_point) const {
    std::array<double, 4> end = {};
    end[corner] = 1;
    path.length += in.barycentric[1 - corner] * length(in.simplex);
    push(path, in.simplex, to_point ? end : in.barycentric);
    if (to_point && in.barycentric != end) push(path, in.simplex, in.barycentric);
  }

  /// Over the shortest edge between two vertices.
  void along_edge(Path& path, Index v, Index w) const {
    const Index edge = edge_between(v, w);
    path.length += length(edge);
    std::array<double, 4> b = {};
    b[wireframe_.inside_edge(edge).from == v ? 0 : 1] = 1;
    push(path, edge, b);
  }

  /// The vertex it ends at, as a point of the last edge.
  void finish(Path& path, Index v) const {
    const Index edge = path.points.empty() ? solved_.outer_simplices[wireframe_.begin()[v]]
                                           : path.points.back().simplex;
    std::array<double, 4> b = {};
    b[wireframe_.inside_edge(edge).from == v ? 0 : 1] = 1;
    push(path, edge, b);
  }

  [[nodiscard]] Index edge_between(Index v, Index w) const {
    Index best = none;
    double shortest = infinity;
    for (Index k = wireframe_.begin()[v]; k < wireframe_.begin()[v + 1]; ++k) {
      const auto& arc = wireframe_.arcs()[k];
      if (arc.to != w || !(static_cast<double>(arc.length) < shortest)) continue;
      shortest = static_cast<double>(arc.length);
      best = solved_.outer_simplices[k];
    }
    return best;
  }

  void keep(Path& best, Path&& path) const {
    const auto whole = [&](const Path& p) { return p.length + solved_.sources[p.source].offset; };
    if (best.source == none || whole(path) < whole(best)) best = std::move(path);
  }

  void place(Path& path) const {
    if (solved_.positions.empty()) return;
    for (const PathPoint& p : path.points) {
      const auto ends = wireframe_.inside_edge(p.simplex);
      const auto &a = solved_.positions[solved_.outer[ends.from]],
                 &b = solved_.positions[solved_.outer[ends.to]];
      std::array<double, 3> at;
      for (std::size_t i = 0; i < 3; ++i) at[i] = p.barycentric[0] * a[i] + p.barycentric[1] * b[i];
      path.positions.push_back(at);
    }
  }

  const Wireframe<Real>& wireframe_;
  const Solved<Real>& solved_;
};

}  // namespace

template <class Real>
Path trace_wire(const Wireframe<Real>& wireframe, const Solved<Real>& solved,
                const PointSource& point) {
  return WireTrace<Real>(wireframe, solved).trace(point);
}

template Path trace_wire(const Wireframe<float>&, const Solved<float>&, const PointSource&);
template Path trace_wire(const Wireframe<double>&, const Solved<double>&, const PointSource&);

}  // namespace plexway
