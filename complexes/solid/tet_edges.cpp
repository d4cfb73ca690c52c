#include "complexes/solid/tet_edges.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

#include "complexes/common/building_blocks.hpp"
#include "complexes/common/disjoint_sets.hpp"
#include "complexes/solid/tet_edge_fans.hpp"

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

}  // namespace plexway::detail
