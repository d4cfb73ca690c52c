#include "complexes/surface/face_layout.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <plexway/surface/detail/triangle_record.hpp>

#include "complexes/surface/gluing.hpp"
#include "complexes/surface/shape_blocks.hpp"

namespace plexway::detail {
namespace {

Index pack(Index face, Index edge) { return face << Across::face_shift | edge; }

// Which lie anywhere in memory: asked for some faces ahead.
void take_corners(std::span<const Index> order, Faces faces, int threads,
                  FaceLayout::Triples& corners) {
  constexpr std::size_t ahead = 16;
  corners.resize(order.size());
  over_blocks(order.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
#ifdef __GNUC__
      if (k + ahead < order.size()) __builtin_prefetch(&faces[order[k + ahead]]);
#endif
      corners[k] = faces[order[k]];
    }
  });
}

}  // namespace

FaceLayout::FaceLayout(std::size_t vertices, Faces faces, std::vector<Index> order, int threads,
                       bool may_turn)
    : face(std::move(order)) {
  number_faces(threads);
  take_corners(face, faces, threads, corner);
  across.resize(faces.size());  // side by side with the corners, so both leave one large room
  name_vertices(vertices);
  const auto number = [&](const EdgeSide& s) {  // the caller's: cycles are in its order
    return std::pair(face[s.halfedge >> Across::face_shift], s.halfedge & Across::edge_mask);
  };
  struct Glue {
    FaceLayout& layout;
    Index sentinel;
    bool turns = false, flips = false;
    std::size_t single_edges = 0, inner_edges = 0, cycles = 0;
    void set(Index from, Index to) const {
      layout.across[from >> Across::face_shift][from & Across::edge_mask] = to;
    }
    // Both run up or both run down: the same way.
    static Index flip(Index a, Index b) { return ~(a ^ b) & Across::flip; }
    void single(Index, const EdgeSide& s) {
      set(s.halfedge, sentinel);
      ++single_edges;
    }
    void pair(const EdgeSide& a, const EdgeSide& b) {
      const Index same = flip(a.halfedge, b.halfedge);
      turns |= same != 0;
      set(a.halfedge, (b.halfedge & ~Across::flip) | same);
      set(b.halfedge, (a.halfedge & ~Across::flip) | same);
      ++inner_edges;
    }
    void cycle(Index, std::span<const EdgeSide> sides) {
      ++cycles;
      for (std::size_t k = 0; k < sides.size(); ++k) {
        const Index h = sides[k].halfedge, o = sides[k + 1 == sides.size() ? 0 : k + 1].halfedge;
        set(h, (o & ~Across::flip) | flip(h, o) | Across::fan);
        flips |= flip(h, o) != 0;
      }
    }
    void take(const Glue& other) {
      turns |= other.turns;
      flips |= other.flips;
      single_edges += other.single_edges;
      inner_edges += other.inner_edges;
      cycles += other.cycles;
    }
  };
  Glue glue{*this, pack(static_cast<Index>(faces.size()), 0)};
  match_edges(
      named, corner, first_use, threads,
      [&](const EdgeSide& a, const EdgeSide& b) { return number(a) < number(b); }, glue);
  flips = glue.flips;
  boundary_edges = glue.single_edges;
  non_manifold_edges = glue.cycles;
  edges = glue.inner_edges + boundary_edges + non_manifold_edges;
  if (!may_turn)
    flips |= glue.turns;
  else if (glue.turns)
    orient();
}

FaceLayout::FaceLayout(std::size_t vertices, Faces faces, std::vector<Index> order,
                       std::span<const std::array<Index, 3>> gluing, int threads)
    : face(std::move(order)) {
  number_faces(threads);
  take_corners(face, faces, threads, corner);
  across.resize(face.size());
  over_blocks(face.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t inside = first; inside < last; ++inside)
      for (std::size_t i = 0; i < 3; ++i) {
        const Index h = gluing[face[inside]][i];
        across[inside][i] = h == none ? none : pack(face_to_inside[h / 3], h % 3);
      }
  });
  take_gluing(vertices, threads);
}

FaceLayout::FaceLayout(std::size_t vertices, std::vector<Index> order, Triples corners,
                       Triples gluing, int threads)
    : face(std::move(order)), corner(std::move(corners)), across(std::move(gluing)) {
  number_faces(threads);
  take_gluing(vertices, threads);
}

// Marks the gluing and counts its edges.
void FaceLayout::take_gluing(std::size_t vertices, int threads) {
  name_vertices(vertices);
  const Index sentinel = pack(static_cast<Index>(face.size()), 0);
  const auto over = [&](Index h) { return across[h >> Across::face_shift][h & Across::edge_mask]; };
  struct Count {
    bool turns = false, flips = false;
    std::size_t in_pairs = 0, single = 0, cycles = 0;
  };
  // The marks are read where faces are another block's: they are made once all are known.
  Unfilled<std::array<unsigned char, 3>> marks(face.size());
  Count all;
  gather_blocks<Count>(
      face.size(), threads,
      [&](std::size_t first, std::size_t last, Count& count) {
        for (Index f = static_cast<Index>(first); f < last; ++f)
          for (Index i = 0; i < 3; ++i) {
            const Index o = across[f][i], own = pack(f, i);
            marks[f][i] = 0;
            if (o == none) {
              ++count.single;
              continue;
            }
            // Opposite unless the vertices say otherwise. In a loop (both ends one vertex) they do
            // not tell directions apart.
            const Index v = corner[f][i];
            const bool loop = v == corner[f][edge_after(i)];
            const bool same_way =
                !loop && v == corner[o >> Across::face_shift][o & Across::edge_mask];
            if (same_way) marks[f][i] |= Across::flip;
            if (over(o) == own) {
              count.turns |= same_way;
              ++count.in_pairs;
              continue;
            }
            marks[f][i] |= Across::fan;
            count.flips |= same_way;
            bool lowest = true;
            for (Index k = o; k != own; k = over(k)) lowest &= own < k;
            count.cycles += lowest;
          }
      },
      [&](const Count& count) {
        all.turns |= count.turns;
        all.flips |= count.flips;
        all.in_pairs += count.in_pairs;
        all.single += count.single;
        all.cycles += count.cycles;
      });
  over_blocks(face.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f)
      for (std::size_t i = 0; i < 3; ++i)
        across[f][i] = across[f][i] == none ? sentinel : across[f][i] | marks[f][i];
  });
  flips = all.flips;
  boundary_edges = all.single;
  non_manifold_edges = all.cycles;
  edges = all.in_pairs / 2 + boundary_edges + non_manifold_edges;
  if (all.turns) orient();
}

void FaceLayout::number_faces(int threads) {
  face_to_inside.resize(face.size());
  over_blocks(face.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t inside = first; inside < last; ++inside)
      face_to_inside[face[inside]] = static_cast<Index>(inside);
  });
}

// Replaces the caller's vertices at the corners.
void FaceLayout::name_vertices(std::size_t vertices) {
  vertex_to_inside.assign(vertices, none);
  named = detail::name_vertices(corner, vertex_to_inside, first_use);
}

std::vector<Index> FaceLayout::vertices_outside(int threads) const {
  std::vector<Index> outside(vertex_to_inside.size());
  over_blocks(outside.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) outside[vertex_to_inside[v]] = static_cast<Index>(v);
  });
  return outside;
}

// Edges with more than two triangles do not count.
void FaceLayout::orient() {
  const Index sentinel = static_cast<Index>(face.size());
  constexpr char unseen = 2;
  turned.assign(face.size(), unseen);
  std::vector<Index> queue;
  for (const Index seed : face_to_inside) {
    if (turned[seed] != unseen) continue;
    turned[seed] = 0;
    queue.assign(1, seed);
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const Index f = queue[head];
      for (const Index o : across[f]) {
        const Index g = o >> Across::face_shift;
        if (g == sentinel || (o & Across::fan) != 0) continue;
        const char wanted = turned[f] ^ static_cast<char>((o & Across::flip) != 0);
        if (turned[g] == unseen) {
          turned[g] = wanted;
          queue.push_back(g);
        } else if (turned[g] != wanted) {
          orientable = false;
        }
      }
    }
  }
  // Corner and edge numbers of a turned face: corners 0 2 1, edges 2 1 0.
  flips = false;
  for (Index f = 0; f < face.size(); ++f) {
    for (Index& o : across[f]) {
      const Index g = o >> Across::face_shift;
      if (g == sentinel) continue;
      if (turned[g]) o = pack(g, 2 - (o & Across::edge_mask)) | (o & Across::special);
      if (turned[g] != turned[f]) o ^= Across::flip;
      flips |= (o & Across::flip) != 0;
    }
    if (!turned[f]) continue;
    std::swap(across[f][0], across[f][2]);
    std::swap(corner[f][1], corner[f][2]);
  }
}

std::size_t FaceLayout::mark_refraction(const TriangleShapes& shapes, RefractionCheck check,
                                        int threads) {
  Unfilled<std::array<double, 3>> lengths(face.size());  // edges as the caller numbers them
  over_blocks(face.size(), threads, [&](std::size_t begin, std::size_t end) {
    ShapeBlock block{};
    for (std::size_t first = begin; first < end; first += ShapeBlock::size) {
      const std::size_t count = std::min(ShapeBlock::size, end - first);
      shapes.look_up(std::span(face).subspan(first, count), block);
      for (std::size_t k = 0; k < count; ++k)
        for (std::size_t i = 0; i < 3; ++i) lengths[first + k][i] = block.length[i][k];
    }
  });
  const auto length = [&](Index f, Index edge) {
    return lengths[f][is_turned(f) ? 2 - edge : edge];
  };
  const auto aspect = [&](Index f) {
    const auto [least, most] = std::minmax_element(lengths[f].begin(), lengths[f].end());
    return *most / *least;
  };
  std::size_t all = 0;
  gather_blocks<std::size_t>(
      face.size(), threads,
      [&](std::size_t first, std::size_t last, std::size_t& count) {
        for (Index f = static_cast<Index>(first); f < last; ++f)
          for (Index i = 0; i < 3; ++i) {
            Index& o = across[f][i];
            const Index g = o >> Across::face_shift, j = o & Across::edge_mask;
            if (g == face.size()) continue;
            const double own = length(f, i), other = length(g, j);
            if (!(std::abs(own - other) > 1e-9 * std::max(own, other))) continue;
            check(face[f], face[g], own, other, std::max(aspect(f), aspect(g)));
            count += (o & Across::fan) != 0 || pack(f, i) < pack(g, j);
            o |= Across::fan;
          }
      },
      [&](std::size_t count) { all += count; });
  return all;
}

}  // namespace plexway::detail
