#include "complexes/solid/shared_faces.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace plexway::detail {
namespace {

struct Record {
  std::array<Index, 3> key;  // places of the pairs, ascending; the third is none for an edge
  SharedMember member;
};

// Every edge or triangle of a simplex whose corners are all welded, by the places of the pairs.
void collect(Index simplex, std::span<const Index> corners,
             const std::vector<std::vector<Index>>& places, std::vector<Record>& edges,
             std::vector<Record>& faces) {
  const auto at = [&](std::size_t i) -> const std::vector<Index>& { return places[corners[i]]; };
  const auto sorted = [&](std::array<std::pair<Index, std::uint8_t>, 3> p, std::size_t n) {
    std::sort(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(n));
    Record r{{p[0].first, p[1].first, none}, {simplex, {p[0].second, p[1].second, 0}}};
    if (n == 3) r.key[2] = p[2].first, r.member.corner[2] = p[2].second;
    return r;
  };
  const auto with = [](Index place, std::size_t i) {
    return std::pair(place, static_cast<std::uint8_t>(i));
  };
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = i + 1; j < corners.size(); ++j)
      for (const Index p : at(i))
        for (const Index q : at(j)) {
          if (p == q) continue;
          edges.push_back(sorted({with(p, i), with(q, j), {}}, 2));
          for (std::size_t k = j + 1; k < corners.size(); ++k)
            for (const Index r : at(k))
              if (r != p && r != q)
                faces.push_back(sorted({with(p, i), with(q, j), with(r, k)}, 3));
        }
}

template <class Complex>
void collect_all(const Complex& complex, std::size_t side,
                 std::span<const std::array<Index, 2>> pairs, std::vector<Record>& edges,
                 std::vector<Record>& faces) {
  std::vector<std::vector<Index>> places(complex.vertex_count());
  for (std::size_t p = 0; p < pairs.size(); ++p)
    places[pairs[p][side]].push_back(static_cast<Index>(p));
  const auto records = [&] {
    if constexpr (requires { complex.triangles(); })
      return complex.triangles();
    else
      return complex.tets();
  }();
  for (Index s = 0; s + 1 < records.size(); ++s)  // without the sentinel
    collect(s, records[s].corner, places, edges, faces);
  const auto by_key = [](const Record& r, const Record& t) {
    return r.key != t.key ? r.key < t.key : r.member.simplex < t.member.simplex;
  };
  std::sort(edges.begin(), edges.end(), by_key);
  std::sort(faces.begin(), faces.end(), by_key);
}

// What both lists have.
template <class Found>
void match(const std::vector<Record>& one, const std::vector<Record>& other, Found found) {
  for (std::size_t i = 0, j = 0; i < one.size() && j < other.size();) {
    if (one[i].key < other[j].key) {
      ++i;
    } else if (other[j].key < one[i].key) {
      ++j;
    } else {
      const auto key = one[i].key;
      std::vector<SharedMember> members[2];
      for (; i < one.size() && one[i].key == key; ++i) members[0].push_back(one[i].member);
      for (; j < other.size() && other[j].key == key; ++j) members[1].push_back(other[j].member);
      found(key, std::move(members[0]), std::move(members[1]));
    }
  }
}

}  // namespace

template <class A, class B>
std::vector<SharedFace> find_shared_faces(const A& a, const B& b,
                                          std::span<const std::array<Index, 2>> pairs) {
  std::vector<SharedFace> shared;
  constexpr bool wires = requires(const A& x) { x.arcs(); }
  || requires(const B& x) { x.arcs(); };
  if constexpr (!wires) {
    std::vector<Record> edges[2], faces[2];
    collect_all(a, 0, pairs, edges[0], faces[0]);
    collect_all(b, 1, pairs, edges[1], faces[1]);
    std::vector<std::array<Index, 2>> inner;  // edges of shared triangles
    match(faces[0], faces[1], [&](const auto& key, auto one, auto other) {
      inner.insert(inner.end(), {{key[0], key[1]}, {key[0], key[2]}, {key[1], key[2]}});
      shared.push_back({false, key, {std::move(one), std::move(other)}});
    });
    std::sort(inner.begin(), inner.end());
    match(edges[0], edges[1], [&](const auto& key, auto one, auto other) {
      const bool is_inner =
          std::binary_search(inner.begin(), inner.end(), std::array<Index, 2>{key[0], key[1]});
      shared.push_back({is_inner, key, {std::move(one), std::move(other)}});
    });
  }
  return shared;
}

#define PLEXWAY_SHARED(A, B)                                                                 \
  template std::vector<SharedFace> find_shared_faces(const A<float>&, const B<float>&,       \
                                                     std::span<const std::array<Index, 2>>); \
  template std::vector<SharedFace> find_shared_faces(const A<double>&, const B<double>&,     \
                                                     std::span<const std::array<Index, 2>>);
PLEXWAY_SHARED(TriangleMesh, TriangleMesh)
PLEXWAY_SHARED(TriangleMesh, TetMesh)
PLEXWAY_SHARED(TriangleMesh, Wireframe)
PLEXWAY_SHARED(TetMesh, TriangleMesh)
PLEXWAY_SHARED(TetMesh, TetMesh)
PLEXWAY_SHARED(TetMesh, Wireframe)
PLEXWAY_SHARED(Wireframe, TriangleMesh)
PLEXWAY_SHARED(Wireframe, TetMesh)
PLEXWAY_SHARED(Wireframe, Wireframe)
#undef PLEXWAY_SHARED

}  // namespace plexway::detail
