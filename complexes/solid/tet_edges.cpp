#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <tuple>
#include <utility>

#include "complexes/common/building_blocks.hpp"
#include "complexes/common/disjoint_sets.hpp"
#include "complexes/solid/tet_edges.hpp"

namespace plexway::detail {

namespace {

using SolidCorners = TetSolid::Corners;

class Finder {
 public:
  Finder(SolidCorners corner, SolidCorners across, const TetCorners& corners,
         const TetPlaces& places, int threads)
      : solid_{corner, across, corners, places, {}},
        vertices_(corners.vertices()),
        threads_(threads),
        on_reflex_(vertices_, 0),
        on_boundary_(vertices_, 0) {}

  TetTopology find() {
    mark_boundary();
    solid_.on_boundary = on_boundary_;
    look_around_edges();
    find_vertices();
    return std::move(found_);
  }

 private:
  void mark_boundary() {
    over_blocks(solid_.corner.size(), threads_, [&](std::size_t first, std::size_t last) {
      for (std::size_t t = first; t < last; ++t)
        if (has_boundary(solid_.across[t]))
          for (std::size_t k = 0; k < 4; ++k)
            if (solid_.across[t][k] == none)
              for (std::size_t i = 0; i < 4; ++i)
                if (i != k) set_mark(on_boundary_[solid_.corner[t][i]]);
    });
  }

  // In ascending order of their ends.
  void look_around_edges() {
    const std::size_t size = vertex_part(vertices_, threads_);
    std::vector<TetEdgeFans::Found> parts((vertices_ + size - 1) / size);
    for_blocks(vertices_, size, threads_, {}, [&](std::size_t first, std::size_t last) {
      parts[first / size] =
          TetEdgeFans(solid_).look(static_cast<Index>(first), static_cast<Index>(last));
    });
    for (const TetEdgeFans::Found& own : parts) {
      const auto tets = static_cast<Index>(found_.pinched_edge_tets.size());
      for (const auto& e : own.pinched)
        found_.pinched_edges.push_back({e.vertex, e.begin + tets, e.end + tets});
      for (const auto& e : own.reflex)
        for (const Index v : e.vertex) on_reflex_[v] = 1;
      found_.reflex.insert(found_.reflex.end(), own.reflex.begin(), own.reflex.end());
      found_.pinched_edge_tets.insert(found_.pinched_edge_tets.end(), own.pinched_tets.begin(),
                                      own.pinched_tets.end());
    }
  }

  // Are all tetrahedra at a vertex joined by faces there? So they are if each but the lowest leads
  // to a lower one, and most have one behind a face. met[t] is 0 before and after.
  [[nodiscard]] bool is_one_fan(Index v, std::vector<char>& met, std::vector<Index>& queue) const {
    const auto row = solid_.corners_at(v);
    for (const Index c : row.subspan(1)) {
      const auto& across = solid_.across[c / 4];
      unsigned lower = 0;
      for (unsigned k = 0; k < 4; ++k) lower |= unsigned{across[k] < (c & ~Index{3})} << k;
      if ((lower & ~(1u << c % 4)) == 0 && !leads_lower(c, v, met, queue)) return false;
    }
    return true;
  }
  // By faces at the vertex. Cost: the tetrahedra on the way.
  [[nodiscard]] bool leads_lower(Index start, Index v, std::vector<char>& met,
                                 std::vector<Index>& queue) const {
    bool found = false;
    queue.assign(1, start);
    met[start / 4] = 1;
    for (std::size_t head = 0; head < queue.size() && !found; ++head) {
      const Index c = queue[head], own = c % 4;
      for (Index k = 0; k < 4; ++k) {
        const Index o = solid_.across[c / 4][k], t = o / 4;
        if (k == own || o == none) continue;
        found = found || t < start / 4;
        if (met[t]) continue;
        met[t] = 1;
        queue.push_back(4 * t + corner_of(solid_.corner[t], v));
      }
    }
    for (const Index c : queue) met[c / 4] = 0;
    return found;
  }

  // Vertices at the boundary whose tetrahedra are not all joined by faces there, ascending.
  [[nodiscard]] std::vector<Index> torn_vertices() const {
    std::vector<Index> torn;
    std::mutex mutex;
    for_blocks(vertices_, vertex_part(vertices_, threads_), threads_, {},
               [&](std::size_t first, std::size_t last) {
                 std::vector<char> met(solid_.corner.size(), 0);
                 std::vector<Index> queue, own;
                 for (Index v = static_cast<Index>(first); v < last; ++v)
                   if (on_boundary_[v] && !is_one_fan(v, met, queue)) own.push_back(v);
                 const std::lock_guard lock(mutex);
                 torn.insert(torn.end(), own.begin(), own.end());
               });
    std::sort(torn.begin(), torn.end());
    return torn;
  }

  // Tetrahedra at a vertex that are joined neither by faces nor by edges there touch in it only.
  void find_vertices() {
    const std::vector<Index> torn = torn_vertices();
    std::vector<std::pair<Index, std::size_t>> edges_at;  // of vertices: pinched edges
    for (std::size_t e = 0; e < found_.pinched_edges.size(); ++e) {
      const auto& edge = found_.pinched_edges[e];
      for (const Index v : edge.vertex) edges_at.emplace_back(v, e);
    }
    std::sort(edges_at.begin(), edges_at.end());
    auto edge = edges_at.begin();
    for (const Index v : torn) {
      const auto row = solid_.corners_at(v);
      DisjointSets fans(row.size());
      const auto unite = [&](Index t, Index u) {
        const auto place = [&](Index tet) {  // rows are ascending
          return static_cast<Index>(std::lower_bound(row.begin(), row.end(), 4 * tet) -
                                    row.begin());
        };
        fans.unite(place(t), place(u));
      };
      for (const Index c : row) {
        for (Index k = 0; k < 4; ++k)
          if (const Index o = solid_.across[c / 4][k]; o != none && k != c % 4) unite(c / 4, o / 4);
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
  }

  TetSolid solid_;
  std::size_t vertices_;
  int threads_;
  std::vector<char> on_reflex_, on_boundary_;
  TetTopology found_;
};

}  // namespace

TetTopology find_tet_topology(SolidCorners corner, SolidCorners across, const TetCorners& corners,
                              const TetPlaces& places, int threads) {
  return Finder(corner, across, corners, places, threads).find();
}

namespace {

// A path may bend at an edge with more than pi of solid around it (2 pi inside a metric that is not
// flat). The excess is rounding on flat boundaries of files with seven digits.
constexpr double angle_tolerance = 1e-5;

double dihedral(const TetPoints& p, Index i, Index j, Index k, Index l) {
  const auto edge = p[j] - p[i];
  const auto a = cross(edge, p[k] - p[i]), b = cross(edge, p[l] - p[i]);
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

Vector3<double> inward_normal(const TetPoints& p, Index face) {
  const auto& [a, b, c] = tet_faces[face];
  const auto n = cross(p[c] - p[a], p[b] - p[a]);
  const double length = norm(n);
  return length > 0 ? 1 / length * n : n;
}

}  // namespace

TetEdgeFans::Found TetEdgeFans::look(Index first, Index last) {
  found_ = {};
  for (Index v = first; v < last; ++v)
    if (!embedded_ || solid_.on_boundary[v]) look_at(v);
  return std::move(found_);
}

// Where one fan is at each edge of the boundary, which is so but at pinched ones: a fan begins
// where its edge ascends along the boundary's faces as seen from inside and ends where it descends,
// and all tetrahedra at the edge are in it. False, and nothing is found, where it is not so.
bool TetEdgeFans::look_at_boundary(Index v) {
  constexpr auto& turn = tet_faces_inside;
  constexpr Index begins = 1, ends = 2;
  const auto row = solid_.corners_at(v);
  starts_.clear();
  bool clear = true;
  const auto mark = [&](Index w, Index side) {
    if (degree_[w] == 0) ends_.push_back(w);
    clear = clear && (degree_[w] & side) == 0;
    degree_[w] |= side;
  };
  ends_.clear();
  for (const Index c : row) {
    const Index t = c / 4, own = c % 4;
    const auto& across = solid_.across[t];
    if (!has_boundary(across)) continue;
    for (Index n = 0; n < 3; ++n) {
      const Index k = turn[own][n], from = turn[own][(n + 1) % 3], to = turn[own][(n + 2) % 3];
      if (across[k] != none) continue;
      const Index w = solid_.corner[t][from], x = solid_.corner[t][to];
      if (w > v) {
        mark(w, begins);
        starts_.push_back({w, t, k, to});
      }
      if (x > v) mark(x, ends);
    }
  }
  for (const Index w : ends_) clear = clear && degree_[w] == (begins | ends);
  std::size_t tets = 0;  // at those edges
  for (const Index c : row)
    for (const Index w : solid_.corner[c / 4]) tets += degree_[w] != 0;
  for (const Index w : ends_) degree_[w] = 0;
  std::sort(starts_.begin(), starts_.end(),
            [](const Start& a, const Start& b) { return a.end < b.end; });
  const std::size_t reflex = found_.reflex.size();
  for (std::size_t n = 0; clear && n < starts_.size(); ++n)
    tets -= walk(starts_[n], v, starts_[n].end);
  if (clear && tets == 0) return true;
  found_.reflex.resize(reflex);
  return false;
}

void TetEdgeFans::look_at(Index v) {
  if (embedded_ && look_at_boundary(v)) return;
  starts_.clear();
  ends_.clear();
  for (const Index c : solid_.corners_at(v)) {
    const Index t = c / 4, own = c % 4;
    const auto& corner = solid_.corner[t];
    const auto& across = solid_.across[t];
    for (Index i = 0; i < 4; ++i) {
      const Index w = corner[i];
      if (w <= v) continue;
      if (degree_[w]++ == 0) ends_.push_back(w);
      for (Index k = 0; k < 4; ++k)
        if (k != i && k != own && across[k] == none) starts_.push_back({w, t, k, 6 - i - own - k});
    }
  }
  std::sort(starts_.begin(), starts_.end(), [](const Start& a, const Start& b) {
    return std::tie(a.end, a.tet, a.enter) < std::tie(b.end, b.tet, b.enter);
  });
  const std::span<const Start> starts = starts_;
  std::size_t first = 0;
  const auto look_at_edge = [&](Index w) {
    std::size_t last = first;
    while (last != starts.size() && starts[last].end == w) ++last;
    around_edge(v, w, starts.subspan(first, last - first));
    first = last;
  };
  if (embedded_) {
    while (first != starts.size()) look_at_edge(starts[first].end);
  } else {
    std::sort(ends_.begin(), ends_.end());
    for (const Index w : ends_) look_at_edge(w);
  }
  for (const Index w : ends_) degree_[w] = 0;
}

// The fans of tetrahedra around one edge, each from boundary to boundary or closed.
void TetEdgeFans::around_edge(Index a, Index b, std::span<const Start> starts) {
  const std::size_t tets = degree_[b];
  std::size_t fans = 0, seen = 0;
  fan_ends_.clear();
  for (const Start& s : starts) {  // a fan is seen from both its ends and counts from the first
    if (std::find(fan_ends_.begin(), fan_ends_.end(), 4 * s.tet + s.enter) != fan_ends_.end())
      continue;
    seen += walk(s, a, b);
    ++fans;
  }
  if (seen == tets && fans == 1) return;
  const auto around = tets_around(a, b);
  if (seen < tets) {
    fans += 1;  // what is left is closed; more than one such fan only under a strange metric
    if (!embedded_) closed(a, b, around);
  }
  if (fans > 1) {
    const Index begin = static_cast<Index>(found_.pinched_tets.size());
    found_.pinched_tets.insert(found_.pinched_tets.end(), around.begin(), around.end());
    found_.pinched.push_back({{a, b}, begin, static_cast<Index>(found_.pinched_tets.size())});
  }
}

std::vector<Index> TetEdgeFans::tets_around(Index a, Index b) const {
  std::vector<Index> around;
  for (const Index c : solid_.corners_at(a)) {
    const auto& corner = solid_.corner[c / 4];
    if (std::find(corner.begin(), corner.end(), b) != corner.end()) around.push_back(c / 4);
  }
  return around;
}

std::size_t TetEdgeFans::walk(const Start& start, Index a, Index b) {
  Index t = start.tet, k = start.enter, l = start.leave;
  fan_.clear();
  apexes_.assign(1, solid_.corner[t][l]);
  for (;;) {
    fan_.push_back(t);
    const Index o = solid_.across[t][l], shared = solid_.corner[t][k];
    apexes_.push_back(shared);
    if (o == none) break;
    t = o / 4;
    k = o % 4;
    l = corner_of(solid_.corner[t], shared);
  }
  // From the lower of both its ends, whichever it was walked from.
  Index from = 4 * start.tet + start.enter, to = 4 * t + l;
  if (to < from) {
    std::swap(from, to);
    std::reverse(apexes_.begin(), apexes_.end());
  }
  fan_ends_.push_back(from);
  fan_ends_.push_back(to);
  if (!is_reflex(a, b)) return fan_.size();
  TetTopology::Reflex& edge = found_.reflex.emplace_back();
  edge.vertex = {a, b};
  edge.crack = embedded_ && is_crack(from, to);
  if (!embedded_)
    for (const Index in : fan_) edge.angle += dihedral_at(in, a, b);
  return fan_.size();
}

// Does the fan just walked span more than pi? In one frame a look at each of its faces mostly
// tells, on which side of the first they are; only what is neither clear nor nearly straight is
// summed.
bool TetEdgeFans::is_reflex(Index a, Index b) const {
  constexpr double clear = 1e-3;  // of a sine
  if (embedded_) {
    const Vector3<double> origin = solid_.places.vertex[a], edge = solid_.places.vertex[b] - origin;
    const Vector3<double> normal = cross(edge, solid_.places.vertex[apexes_[0]] - origin);
    const double least = clear * clear * dot(normal, normal);
    double side = 0;  // of the first face after it
    for (std::size_t n = 1;; ++n) {
      if (n == apexes_.size()) return false;
      const Vector3<double> y = solid_.places.vertex[apexes_[n]] - origin;
      const double height = dot(normal, y);
      if (height * height > least * dot(y, y)) {
        if (side == 0) side = height;
        if ((height < 0) != (side < 0)) return true;
        continue;
      }
      const Vector3<double> other = cross(edge, y);
      if (side == 0 || n + 1 < apexes_.size() || !(dot(normal, other) < 0)) break;
      const double beyond = (side < 0 ? height : -height) * norm(edge);
      return beyond > angle_tolerance * norm(normal) * norm(other);
    }
  }
  double angle = 0;
  for (const Index t : fan_) angle += dihedral_at(t, a, b);
  return angle > std::numbers::pi + angle_tolerance;
}

double TetEdgeFans::dihedral_at(Index t, Index a, Index b) const {
  const Index i = corner_of(solid_.corner[t], a), j = corner_of(solid_.corner[t], b);
  Index k = 0;
  while (k == i || k == j) ++k;
  return dihedral(solid_.points(t), i, j, k, 6 - i - j - k);
}

void TetEdgeFans::closed(Index a, Index b, std::span<const Index> around) {
  double angle = 0;
  for (const Index t : around) angle += dihedral_at(t, a, b);
  if (angle > 2 * std::numbers::pi + angle_tolerance) found_.reflex.emplace_back().vertex = {a, b};
}

// Do two boundary faces, 4 t + k, at one edge lie on each other?
bool TetEdgeFans::is_crack(Index from, Index to) const {
  const auto normal = [&](Index face) { return inward_normal(solid_.points(face / 4), face % 4); };
  return dot(normal(from), normal(to)) < -1 + 1e-6;
}

}  // namespace plexway::detail
