#include "complex/tet_edges.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numbers>
#include <tuple>
#include <utility>

#include "complex/building_blocks.hpp"
#include "complex/simplex_gluing.hpp"

namespace plexway {
namespace {

// A path may bend at an edge with more than pi of solid around it (2 pi inside a metric that is not
// flat). The excess is rounding on flat boundaries of files with seven digits.
constexpr double excess = 1e-5;

using Corners = std::span<const std::array<Index, 4>>;

Index corner_of(const std::array<Index, 4>& corner, Index vertex) {
  return static_cast<Index>(std::find(corner.begin(), corner.end(), vertex) - corner.begin());
}

double dihedral(const TetPoints& p, Index i, Index j, Index k, Index l) {
  const auto edge = p[j] - p[i];
  const auto a = cross(edge, p[k] - p[i]), b = cross(edge, p[l] - p[i]);
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

Vector3<double> inward_normal(const TetPoints& p, Index face) {
  constexpr Index order[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};  // seen from outside
  const auto& [a, b, c] = order[face];
  const auto n = cross(p[c] - p[a], p[b] - p[a]);
  const double length = norm(n);
  return length > 0 ? 1 / length * n : n;
}

/// Within a face, from its edge ij and square to that, unit.
Vector3<double> into_face(const TetPoints& p, Index face, Index i, Index j) {
  const auto edge = p[j] - p[i], side = p[6 - face - i - j] - p[i];
  const double square = dot(edge, edge);
  const auto w = square > 0 ? side - dot(side, edge) / square * edge : side;
  const double length = norm(w);
  return length > 0 ? 1 / length * w : w;
}

class Finder {
 public:
  Finder(Corners corner, Corners across, const TetCorners& corners, const TetPlaces& places,
         int threads)
      : vertices_(corners.begin.size() - 1),
        threads_(threads),
        corner_(corner),
        across_(across),
        corners_(corners),
        places_(places),
        embedded_(places.embedded()),
        on_reflex_(vertices_, 0) {}

  TetTopology find() {
    mark_boundary();
    count_edges();
    look_around_edges();
    found_.reflex_edges = found_.reflex.size();
    if (embedded_) merge_straight();
    list_by_tet();
    find_vertices();
    return std::move(found_);
  }

 private:
  [[nodiscard]] TetPoints points(std::size_t t) const { return places_.of(t, corner_[t]); }
  [[nodiscard]] std::span<const Index> corners_at(Index v) const {
    return std::span(corners_.corner)
        .subspan(corners_.begin[v], corners_.begin[v + 1] - corners_.begin[v]);
  }

  void mark_boundary() {
    on_boundary_.assign(vertices_, 0);
    for (std::size_t t = 0; t < corner_.size(); ++t)
      for (std::size_t k = 0; k < 4; ++k)
        if (across_[t][k] == none)
          for (std::size_t i = 0; i < 4; ++i)
            if (i != k) on_boundary_[corner_[t][i]] = 1;
  }

  // Vertices in as few parts as there are threads, and few at most: each has marks for all.
  [[nodiscard]] std::size_t part() const {
    constexpr int most = 16;
    const auto parts = static_cast<std::size_t>(std::min(threads_for(threads_), most));
    return std::max(building_block, (vertices_ + parts - 1) / parts);
  }

  void count_edges() {
    std::atomic<std::size_t> edges = 0;
    for_blocks(vertices_, part(), threads_, {}, [&](std::size_t first, std::size_t last) {
      std::vector<Index> seen(vertices_, none);  // the last vertex that it shared an edge with
      std::size_t own = 0;
      for (Index v = static_cast<Index>(first); v < last; ++v)
        for (const Index c : corners_at(v))
          for (const Index w : corner_[c / 4]) {
            own += static_cast<std::size_t>(w > v) & static_cast<std::size_t>(seen[w] != v);
            seen[w] = v;
          }
      edges += own;
    });
    found_.edges = edges;
  }

  // In ascending order of their ends. Where all is in one frame paths bend at the boundary only.
  void look_around_edges() {
    std::vector<Index> degree(vertices_, 0);  // tetrahedra around the edge to each vertex
    std::vector<Index> ends;
    std::vector<Start> starts;
    for (Index v = 0; v < vertices_; ++v) {
      if (embedded_ && !on_boundary_[v]) continue;
      starts.clear();
      ends.clear();
      for (const Index c : corners_at(v)) {
        const Index t = c / 4, own = c % 4;
        for (Index i = 0; i < 4; ++i) {
          const Index w = corner_[t][i];
          if (w <= v) continue;
          if (degree[w]++ == 0) ends.push_back(w);
          for (Index k = 0; k < 4; ++k)
            if (k != i && k != own && across_[t][k] == none)
              starts.push_back({w, t, k, 6 - i - own - k});
        }
      }
      std::sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) {
        return std::tie(a.end, a.tet, a.enter) < std::tie(b.end, b.tet, b.enter);
      });
      if (!embedded_) std::sort(ends.begin(), ends.end());
      auto first = starts.begin();
      const auto look_at = [&](Index w) {
        auto last = first;
        while (last != starts.end() && last->end == w) ++last;
        around_edge(
            v, w,
            std::span<const Start>(starts).subspan(static_cast<std::size_t>(first - starts.begin()),
                                                   static_cast<std::size_t>(last - first)),
            degree[w]);
        first = last;
      };
      if (embedded_)
        while (first != starts.end()) look_at(first->end);
      else
        for (const Index w : ends) look_at(w);
      for (const Index w : ends) degree[w] = 0;
    }
  }

  // A fan of tetrahedra around an edge to `end` starts at a boundary face of one of them and leaves
  // that by another.
  struct Start {
    Index end, tet, enter, leave;
  };

  // The fans of tetrahedra around one edge, each from boundary to boundary or closed.
  void around_edge(Index a, Index b, std::span<const Start> starts, std::size_t tets) {
    std::size_t fans = 0, seen = 0;
    fan_ends_.clear();
    for (const Start& s : starts) {  // a fan is seen from both its ends and counts from the first
      if (std::find(fan_ends_.begin(), fan_ends_.end(), 4 * s.tet + s.enter) != fan_ends_.end())
        continue;
      seen += walk(s.tet, s.enter, s.leave, a, b);
      ++fans;
    }
    if (seen == tets && fans == 1) return;
    const auto around = tets_around(a, b);
    if (seen < tets) {
      fans += 1;  // what is left is closed; more than one such fan only under a strange metric
      if (!embedded_) closed(a, b, around);
    }
    if (fans > 1) {
      const Index begin = static_cast<Index>(found_.pinched_edge_tets.size());
      found_.pinched_edge_tets.insert(found_.pinched_edge_tets.end(), around.begin(), around.end());
      found_.pinched_edges.push_back(
          {{a, b}, begin, static_cast<Index>(found_.pinched_edge_tets.size())});
    }
  }

  [[nodiscard]] std::vector<Index> tets_around(Index a, Index b) const {
    std::vector<Index> around;
    for (const Index c : corners_at(a))
      if (corner_of(corner_[c / 4], b) < 4) around.push_back(c / 4);
    return around;
  }

  // Starts at boundary face k of tetrahedron t and leaves by face l.
  std::size_t walk(Index t, Index k, Index l, Index a, Index b) {
    const Index first_tet = t, first_face = k, first_apex = corner_[t][l];
    fan_.clear();
    apexes_.clear();
    for (;;) {
      const Index i = corner_of(corner_[t], a), j = corner_of(corner_[t], b);
      fan_.push_back({t, tet_edge(i, j)});
      const Index o = across_[t][l], shared = corner_[t][k];
      apexes_.push_back(shared);
      if (o == none) break;
      t = o / 4;
      k = o % 4;
      l = corner_of(corner_[t], shared);
    }
    fan_ends_.push_back(4 * t + l);
    if (is_reflex(a, b, first_apex)) add_reflex(a, b, first_tet, first_face, t, l);
    return fan_.size();
  }

  // Does the fan just walked span more than pi? In one frame a look at each of its faces mostly
  // tells, on which side of the first they are; only what is neither clear nor nearly straight is
  // summed.
  [[nodiscard]] bool is_reflex(Index a, Index b, Index first_apex) const {
    constexpr double clear = 1e-3;  // of a sine
    if (embedded_) {
      const Vector3<double> origin = places_.vertex[a], edge = places_.vertex[b] - origin;
      const Vector3<double> normal = cross(edge, places_.vertex[first_apex] - origin);
      const double least = clear * clear * dot(normal, normal);
      double side = 0;  // of the first face after it
      for (std::size_t n = 0;; ++n) {
        if (n == apexes_.size()) return false;
        const Vector3<double> y = places_.vertex[apexes_[n]] - origin;
        const double height = dot(normal, y);
        if (height * height > least * dot(y, y)) {
          if (side == 0) side = height;
          if ((height < 0) != (side < 0)) return true;
          continue;
        }
        const Vector3<double> other = cross(edge, y);
        if (side == 0 || n + 1 < apexes_.size() || !(dot(normal, other) < 0)) break;
        const double beyond = (side < 0 ? height : -height) * norm(edge);
        return beyond > excess * norm(normal) * norm(other);
      }
    }
    double angle = 0;
    for (const auto& [t, slot] : fan_) angle += dihedral_at(t, a, b);
    return angle > std::numbers::pi + excess;
  }

  [[nodiscard]] double dihedral_at(Index t, Index a, Index b) const {
    const Index i = corner_of(corner_[t], a), j = corner_of(corner_[t], b);
    Index k = 0;
    while (k == i || k == j) ++k;
    return dihedral(points(t), i, j, k, 6 - i - j - k);
  }

  void closed(Index a, Index b, std::span<const Index> around) {
    double angle = 0;
    for (const Index t : around) angle += dihedral_at(t, a, b);
    if (angle > 2 * std::numbers::pi + excess) {
      on_reflex_[a] = on_reflex_[b] = 1;
      found_.reflex.emplace_back();
    }
  }

  void add_reflex(Index a, Index b, Index t, Index k, Index u, Index l) {
    const Index edge = static_cast<Index>(found_.reflex.size());
    const TetPoints p = points(t), q = points(u);
    const Index i = corner_of(corner_[t], a), j = corner_of(corner_[t], b);
    const Vector3<double> normal[2] = {inward_normal(p, k), inward_normal(q, l)};
    // At the end of a crack, whose faces lie on each other, normals leave nothing.
    constexpr double closed_crack = 1e-3;
    Vector3<double> solid = normal[0] + normal[1];
    if (dot(solid, solid) < closed_crack * closed_crack)
      solid = -0.5 * (into_face(p, k, i, j) +
                      into_face(q, l, corner_of(corner_[u], a), corner_of(corner_[u], b)));
    found_.reflex.push_back({{p[i], p[j]}, {normal[0], normal[1]}, {a, b}, solid});
    on_reflex_[a] = on_reflex_[b] = 1;
    for (const auto& [tet, slot] : fan_)
      entries_.push_back({tet, edge << ReflexEntry::edge_shift | slot << ReflexEntry::slot_shift});
  }

  // Edges in a straight row, between the same planes, are one to a path.
  void merge_straight() {
    std::vector<std::pair<Index, Index>> ends;
    for (Index e = 0; e < found_.reflex.size(); ++e)
      for (const Index v : found_.reflex[e].vertex) ends.push_back({v, e});
    std::sort(ends.begin(), ends.end());
    DisjointSets rows(found_.reflex.size());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const Index v = ends[i].first;
      if (ends[i + 1].first != v || (i > 0 && ends[i - 1].first == v) ||
          (i + 2 < ends.size() && ends[i + 2].first == v))
        continue;
      const TetTopology::Reflex &a = found_.reflex[ends[i].second],
                                &b = found_.reflex[ends[i + 1].second];
      if (in_a_row(a, b, v)) rows.unite(ends[i].second, ends[i + 1].second);
    }
    std::vector<Index> merged(found_.reflex.size());
    std::vector<TetTopology::Reflex> kept;
    for (Index e = 0; e < found_.reflex.size(); ++e) {
      if (rows.find(e) == e) {  // roots are the lowest of their row
        merged[e] = static_cast<Index>(kept.size());
        kept.push_back(found_.reflex[e]);
        continue;
      }
      merged[e] = merged[rows.find(e)];
      TetTopology::Reflex& row = kept[merged[e]];
      const TetTopology::Reflex& edge = found_.reflex[e];
      const auto u = row.end[1] - row.end[0];
      for (std::size_t i = 0; i < 2; ++i) {
        const double along = dot(edge.end[i] - row.end[0], u) / dot(u, u);
        if (along >= 0 && along <= 1) continue;
        const std::size_t side = along < 0 ? 0 : 1;
        row.end[side] = edge.end[i], row.vertex[side] = edge.vertex[i];
      }
    }
    found_.reflex = std::move(kept);
    for (auto& [tet, packed] : entries_)
      packed = merged[packed >> ReflexEntry::edge_shift] << ReflexEntry::edge_shift |
               (packed & ((1u << ReflexEntry::edge_shift) - 1));
  }

  static bool in_a_row(const TetTopology::Reflex& a, const TetTopology::Reflex& b, Index v) {
    const std::size_t i = a.vertex[0] == v ? 0 : 1, j = b.vertex[0] == v ? 0 : 1;
    const auto u = a.end[i] - a.end[1 - i], w = b.end[1 - j] - b.end[j];
    constexpr double near = 1e-6;
    if (!(dot(u, w) > 0) || !(norm(cross(u, w)) < near * dot(u, w))) return false;
    if (!(dot(a.solid, b.solid) > 0)) return false;  // cracks on either side of a line
    const auto same = [](const Vector3<double>& m, const Vector3<double>& n) {
      return norm(m - n) < near;
    };
    return (same(a.normal[0], b.normal[0]) && same(a.normal[1], b.normal[1])) ||
           (same(a.normal[0], b.normal[1]) && same(a.normal[1], b.normal[0]));
  }

  void list_by_tet() {
    std::sort(entries_.begin(), entries_.end());
    found_.first_reflex.assign(corner_.size(), none);
    for (std::size_t e = 0; e < entries_.size(); ++e) {
      const auto [tet, packed] = entries_[e];
      if (e == 0 || entries_[e - 1].first != tet) found_.first_reflex[tet] = static_cast<Index>(e);
      const bool last = e + 1 == entries_.size() || entries_[e + 1].first != tet;
      found_.reflex_list.push_back(packed | (last ? ReflexEntry::last : 0));
    }
  }

  // Are all tetrahedra at a vertex joined by faces there? met[t] is 0 before and after.
  [[nodiscard]] bool is_one_fan(Index v, std::vector<char>& met, std::vector<Index>& stack) const {
    const auto row = corners_at(v);
    stack.resize(std::max(stack.size(), row.size() + 1));
    std::size_t top = 0, count = 0;
    stack[top++] = row[0];
    met[row[0] / 4] = 1;
    while (top > 0) {
      const Index c = stack[--top], own = c % 4;
      ++count;
      for (Index k = 0; k < 4; ++k) {
        const Index o = across_[c / 4][k];
        if (k == own || o == none) continue;
        const auto& corner = corner_[o / 4];
        const Index i = static_cast<Index>(corner[1] == v) |
                        static_cast<Index>(corner[2] == v) * 2 |
                        static_cast<Index>(corner[3] == v) * 3;
        stack[top] = o - o % 4 + i;
        top += met[o / 4] == 0;
        met[o / 4] = 1;
      }
    }
    for (const Index c : row) met[c / 4] = 0;
    return count == row.size();
  }

  // Vertices at the boundary whose tetrahedra are not all joined by faces there, ascending.
  [[nodiscard]] std::vector<Index> torn_vertices() const {
    std::vector<Index> torn;
    std::mutex mutex;
    for_blocks(vertices_, part(), threads_, {}, [&](std::size_t first, std::size_t last) {
      std::vector<char> met(corner_.size(), 0);
      std::vector<Index> stack, own;
      for (Index v = static_cast<Index>(first); v < last; ++v)
        if (on_boundary_[v] && !is_one_fan(v, met, stack)) own.push_back(v);
      const std::lock_guard lock(mutex);
      torn.insert(torn.end(), own.begin(), own.end());
    });
    std::sort(torn.begin(), torn.end());
    return torn;
  }

  // Tetrahedra at a vertex that are joined neither by faces nor by edges there touch in it only.
  void find_vertices() {
    const std::vector<Index> torn = torn_vertices();
    DisjointSets solids(corner_.size());
    for (Index t = 0; t < corner_.size(); ++t)
      for (const Index o : across_[t])
        if (o != none) solids.unite(t, o / 4);
    std::vector<std::pair<Index, std::size_t>> edges_at;  // of vertices: pinched edges
    for (std::size_t e = 0; e < found_.pinched_edges.size(); ++e) {
      const auto& edge = found_.pinched_edges[e];
      for (const Index v : edge.vertex) edges_at.emplace_back(v, e);
      for (Index n = edge.begin + 1; n < edge.end; ++n)
        solids.unite(found_.pinched_edge_tets[n - 1], found_.pinched_edge_tets[n]);
    }
    std::sort(edges_at.begin(), edges_at.end());
    auto edge = edges_at.begin();
    for (const Index v : torn) {
      const auto row = corners_at(v);
      DisjointSets fans(row.size());
      const auto unite = [&](Index t, Index u) {
        const auto place = [&](Index tet) {  // rows are ascending
          return static_cast<Index>(std::lower_bound(row.begin(), row.end(), 4 * tet) -
                                    row.begin());
        };
        fans.unite(place(t), place(u));
      };
      for (const Index c : row) {
        solids.unite(c / 4, row[0] / 4);
        for (Index k = 0; k < 4; ++k)
          if (const Index o = across_[c / 4][k]; o != none && k != c % 4) unite(c / 4, o / 4);
      }
      while (edge != edges_at.end() && edge->first < v) ++edge;
      for (; edge != edges_at.end() && edge->first == v; ++edge) {
        const auto& pinched = found_.pinched_edges[edge->second];
        for (Index n = pinched.begin + 1; n < pinched.end; ++n)
          unite(found_.pinched_edge_tets[n - 1], found_.pinched_edge_tets[n]);
      }
      for (Index n = 0; n < row.size(); ++n)
        if (fans.find(n) != fans.find(0)) {
          found_.pinched_vertices.push_back(v);
          found_.reflex_vertices += !on_reflex_[v];
          break;
        }
    }
    for (const char on : on_reflex_) found_.reflex_vertices += on != 0;
    for (Index t = 0; t < corner_.size(); ++t) found_.components += solids.find(t) == t;
  }

  std::size_t vertices_;
  int threads_;
  Corners corner_, across_;
  const TetCorners& corners_;
  const TetPlaces& places_;
  bool embedded_;
  std::vector<char> on_reflex_, on_boundary_;
  std::vector<Index> fan_ends_;  // of the fans around an edge, boundary faces 4 t + k
  std::vector<Index> apexes_;    // vertices around the edge, of the fan being walked
  std::vector<std::pair<Index, Index>> fan_, entries_;
  TetTopology found_;
};

}  // namespace

TetCorners corners_of_vertices(std::size_t vertices, Corners corner,
                               std::span<const Index> first_use, int threads) {
  TetCorners rows;
  rows.begin.assign(vertices + 1, 0);
  const auto tell_corners = [&](std::size_t first, std::size_t last, const auto& tell) {
    for (std::size_t t = first; t < last; ++t)
      for (std::size_t i = 0; i < 4; ++i) tell(corner[t][i], static_cast<Index>(4 * t + i));
  };
  tell_vertices<Index>(first_use, corner.size(), threads, tell_corners,
                       [&](Index v, Index) { ++rows.begin[v + 1]; });
  for (std::size_t v = 0; v < vertices; ++v) rows.begin[v + 1] += rows.begin[v];
  rows.corner.resize(4 * corner.size());
  std::vector<Index> cursor(rows.begin.begin(), rows.begin.end() - 1);
  tell_vertices<Index>(first_use, corner.size(), threads, tell_corners,
                       [&](Index v, Index c) { rows.corner[cursor[v]++] = c; });
  return rows;
}

TetTopology find_tet_topology(Corners corner, Corners across, const TetCorners& corners,
                              const TetPlaces& places, int threads) {
  return Finder(corner, across, corners, places, threads).find();
}

}  // namespace plexway
