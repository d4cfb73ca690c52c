#include "complexes/mixed/joined_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <plexway/error.hpp>

#include "complexes/common/arrays.hpp"
#include "complexes/common/disjoint_sets.hpp"

namespace plexway::detail {
namespace {

using Pairs = std::vector<std::array<Index, 2>>;

// Pieces measure what they share alike up to this share of its length.
constexpr double alike = 1e-6;

template <class Real>
class Joiner {
 public:
  using Domain = MixedComplex<Real>;
  using Surface = TriangleMesh<Real>;
  using Solid = TetMesh<Real>;

  Joiner(const Domain& given, const std::vector<std::vector<Point3>>& positions)
      : given_(given), positions_(positions), sets_(given.pieces().size()) {
    for (const auto& weld : given.welds())
      inside_[{weld.piece[0], weld.piece[1]}].push_back({weld.vertex[0], weld.vertex[1]});
    for (auto& [pieces, pairs] : inside_) {
      std::sort(pairs.begin(), pairs.end());
      pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    }
    parts_.resize(given.pieces().size());
    for (Index p = 0; p < parts_.size(); ++p) parts_[p] = {p};
  }

  /// True if any are joined.
  bool find_parts() {
    for (const auto& hinge : given_.hinges())
      if (get<Surface>(hinge.piece[0]) && get<Surface>(hinge.piece[1]))
        sets_.unite(hinge.piece[0], hinge.piece[1]);
    std::map<Index, std::vector<Index>> parts;
    for (Index p = 0; p < given_.pieces().size(); ++p)
      if (!get<Solid>(p)) parts[sets_.find(p)].push_back(p);
    find_solid_parts(parts);
    parts_.clear();
    bool any = false;
    for (auto& [first, pieces] : parts) {
      any |= pieces.size() > 1;
      parts_.push_back(pieces);
    }
    return any;
  }

  std::shared_ptr<const JoinedPieces<Real>> build() {
    auto joined = std::make_shared<JoinedPieces<Real>>();
    joined->vertex.resize(given_.vertex_count());
    joined->simplex.resize(given_.simplex_count());
    std::vector<Index> part_of(given_.pieces().size());
    std::vector<typename Domain::Piece> made;
    for (const auto& pieces : parts_) {
      const Index part = static_cast<Index>(made.size());
      for (const Index p : pieces) part_of[p] = part;
      made.push_back(add(pieces, *joined));
      Index simplex = made.back().first_simplex;
      for (const Index p : pieces)
        for (Index s = 0; s < given_.pieces()[p].simplices; ++s)
          joined->simplex[given_.pieces()[p].first_simplex + s] = simplex++;
    }
    std::map<std::pair<Index, Index>, Pairs> welds;  // what is welded still
    for (const auto& [v, w] : given_.outer_welds()) {
      const Index a = part_of[piece_of(v)], b = part_of[piece_of(w)];
      if (a == b) continue;
      std::array<Index, 2> pair = {joined->vertex[v] - made[a].first_vertex,
                                   joined->vertex[w] - made[b].first_vertex};
      if (a > b) std::swap(pair[0], pair[1]);
      welds[{std::min(a, b), std::max(a, b)}].push_back(pair);
    }
    for (const auto& [parts, pairs] : welds)
      joined->domain.weld(made[parts.first], made[parts.second], pairs);
    return joined;
  }

 private:
  template <class Complex>
  [[nodiscard]] const Complex* get(Index piece) const {
    return std::get_if<Complex>(&given_.complex(given_.pieces()[piece]));
  }
  [[nodiscard]] Index piece_of(Index vertex) const {
    return detail::piece_of(given_, vertex).number;
  }

  // Solids are joined one after the other, each placed by a face that it shares with what is there
  // already.
  void find_solid_parts(std::map<Index, std::vector<Index>>& parts) {
    std::vector<std::vector<Index>> shared(given_.pieces().size());  // hinges
    for (Index n = 0; n < given_.hinges().size(); ++n) {
      const auto& hinge = given_.hinges()[n];
      if (hinge.dimension != 2) continue;
      if (get<Solid>(hinge.piece[0]) && get<Solid>(hinge.piece[1]))
        for (const Index p : hinge.piece) shared[p].push_back(n);
    }
    places_.resize(given_.pieces().size());
    inside_to_given_.resize(given_.pieces().size());
    std::vector<char> done(given_.pieces().size(), 0);
    for (Index p = 0; p < done.size(); ++p) {
      if (done[p] || !get<Solid>(p)) continue;
      std::vector<Index> part = gather(p, shared, done, false);
      if (part.size() > 1 && !can_be_built(part)) part = gather(p, shared, done, true);
      for (const Index q : part) done[q] = 1;
      std::sort(part.begin(), part.end());
      parts[p] = std::move(part);
    }
  }

  // Solid p and all that it can be joined with; `careful`: each is tried before it is taken.
  std::vector<Index> gather(Index p, const std::vector<std::vector<Index>>& shared,
                            const std::vector<char>& done, bool careful) {
    std::vector<Index> part = {p};
    places_[p] = places_of(*get<Solid>(p), positions_[p]);
    for (std::size_t i = 0; i < part.size(); ++i)
      for (const Index n : shared[part[i]]) {
        const auto& hinge = given_.hinges()[n];
        const Index q = hinge.piece[hinge.piece[0] == part[i]];
        if (done[q] || std::find(part.begin(), part.end(), q) != part.end()) continue;
        if (!place(n, part[i], q) || !fits(part, q)) continue;
        part.push_back(q);
        if (careful && !can_be_built(part)) part.pop_back();
      }
    return part;
  }

  // Puts solid q where hinge n with solid p, which is placed, wants it. False if the two measure
  // the hinge differently.
  bool place(Index n, Index p, Index q) {
    const auto& hinge = given_.hinges()[n];
    places_[q] = places_of(*get<Solid>(q), positions_[q]);
    std::array<Point3, 3> triangle[2];
    Point3 inside[2];
    double size = 0;
    for (const std::size_t i : {0U, 1U}) {
      const Index piece = i == 0 ? p : q;
      const std::size_t side = hinge.piece[0] == piece ? 0 : 1;
      const auto& member = hinge.member[side];
      const Solid& solid = *get<Solid>(piece);
      auto& given = inside_to_given_[piece];
      if (given.empty()) given = vertices_outside(solid);
      const auto& corners = solid.tets()[member.simplex].corner;
      inside[i] = {0, 0, 0};
      for (const Index v : corners)
        for (std::size_t d = 0; d < 3; ++d) inside[i][d] += places_[piece][given[v]][d] / 4;
      for (std::size_t k = 0; k < 3; ++k)
        triangle[i][k] = places_[piece][given[corners[member.corner[k]]]];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Point3 one = minus(triangle[0][(k + 1) % 3], triangle[0][k]);
      const Point3 other = minus(triangle[1][(k + 1) % 3], triangle[1][k]);
      const double a = std::sqrt(dot(one, one)), b = std::sqrt(dot(other, other));
      size = std::max({size, a, b});
      if (!(std::abs(a - b) <= alike * std::max(a, b)) || a == 0) return false;
    }
    const Placing placing =
        place_onto(triangle[1], inside[1], triangle[0], inside[0], tolerance(size));
    for (Point3& point : places_[q]) point = placing(point);
    return true;
  }
  static double tolerance(double size) { return 1e-5 * size; }

  // Do all vertices that q shares with solids of the part lie where theirs do?
  [[nodiscard]] bool fits(const std::vector<Index>& part, Index q) const {
    for (const auto& [v, w] : given_.outer_welds()) {
      const Index one = piece_of(v), other = piece_of(w);
      if (one != q && other != q) continue;
      const Index neighbour = one == q ? other : one;
      if (std::find(part.begin(), part.end(), neighbour) == part.end()) continue;
      const Point3 d = minus(places_[one][v - given_.pieces()[one].first_vertex],
                             places_[other][w - given_.pieces()[other].first_vertex]);
      if (!(std::sqrt(dot(d, d)) <= tolerance(get<Solid>(q)->unit()))) return false;
    }
    return true;
  }

  // The vertices of a part: of those that are welded, the first one's number stands for all.
  struct Vertices {
    std::vector<std::vector<Index>> of_piece;
    Index count = 0;
  };
  [[nodiscard]] Vertices vertices_of(const std::vector<Index>& pieces) const {
    std::vector<Index> begin = {0}, place(given_.pieces().size(), none);
    for (const Index p : pieces) {
      place[p] = static_cast<Index>(begin.size() - 1);
      begin.push_back(begin.back() + given_.pieces()[p].vertices);
    }
    DisjointSets same(begin.back());
    for (const auto& [v, w] : given_.outer_welds()) {
      const Index p = piece_of(v), q = piece_of(w);
      if (place[p] == none || place[q] == none) continue;
      same.unite(begin[place[p]] + v - given_.pieces()[p].first_vertex,
                 begin[place[q]] + w - given_.pieces()[q].first_vertex);
    }
    Vertices vertices;
    std::vector<Index> number(begin.back(), none);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      auto& of_piece = vertices.of_piece.emplace_back();
      for (Index v = begin[i]; v < begin[i + 1]; ++v) {
        Index& n = number[same.find(v)];
        if (n == none) n = vertices.count++;
        of_piece.push_back(n);
      }
    }
    return vertices;
  }

  [[nodiscard]] std::pair<std::vector<Point3>, std::vector<std::array<Index, 4>>> solid_of(
      const std::vector<Index>& pieces, const Vertices& vertices) const {
    std::vector<Point3> points(vertices.count);
    std::vector<std::array<Index, 4>> tets;
    for (std::size_t i = pieces.size(); i-- > 0;)
      for (Index v = 0; v < vertices.of_piece[i].size(); ++v)
        points[vertices.of_piece[i][v]] = places_[pieces[i]][v];
    for (std::size_t i = 0; i < pieces.size(); ++i)
      for (auto tet : tets_of(*get<Solid>(pieces[i]))) {
        for (Index& v : tet) v = vertices.of_piece[i][v];
        tets.push_back(tet);
      }
    return {std::move(points), std::move(tets)};
  }

  // Not where faces contradict each other, and not where the weld leaves a crack, as the wall
  // around a window: coordinates do not say on which side of it a source lies.
  [[nodiscard]] bool can_be_built(const std::vector<Index>& pieces) const {
    const Vertices vertices = vertices_of(pieces);
    const auto [points, tets] = solid_of(pieces, vertices);
    std::vector<char> cracked(vertices.count, 0);
    std::size_t pinches = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const Solid& solid = *get<Solid>(pieces[i]);
      pinches += solid.summary().pinched_edges + solid.summary().pinched_vertices;
      const std::vector<Index> outside = vertices_outside(solid);
      for (const auto& crack : solid.cracks())
        for (const Index v : crack) cracked[vertices.of_piece[i][outside[v]]] = 1;
    }
    try {
      const Solid solid(points, tets);
      if (solid.summary().pinched_edges + solid.summary().pinched_vertices > pinches) return false;
      const std::vector<Index> outside = vertices_outside(solid);
      for (const auto& crack : solid.cracks())
        for (const Index v : crack)
          if (!cracked[outside[v]]) return false;
      return true;
    } catch (const InputError&) {
      return false;
    }
  }

  typename Domain::Piece add(const std::vector<Index>& pieces, JoinedPieces<Real>& joined) {
    const Vertices vertices = vertices_of(pieces);
    const Index first = static_cast<Index>(joined.domain.vertex_count());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const auto& piece = given_.pieces()[pieces[i]];
      for (Index v = 0; v < piece.vertices; ++v)
        joined.vertex[piece.first_vertex + v] =
            first + (pieces.size() == 1 ? v : vertices.of_piece[i][v]);
    }
    if (pieces.size() == 1) return joined.domain.add(given_.complex(given_.pieces()[pieces[0]]));
    if (get<Solid>(pieces[0])) {
      const auto [points, tets] = solid_of(pieces, vertices);
      return joined.domain.add(TetMesh<Real>(points, tets));
    }
    std::vector<JoinedPart<Real>> surfaces;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      surfaces.push_back({get<Surface>(pieces[i]), vertices.of_piece[i]});
    std::vector<SurfaceSeam> seams;
    for (const auto& [ends, pairs] : inside_) {
      const auto a = std::find(pieces.begin(), pieces.end(), ends.first);
      const auto b = std::find(pieces.begin(), pieces.end(), ends.second);
      if (a == pieces.end() || b == pieces.end()) continue;
      seams.push_back(
          {{static_cast<Index>(a - pieces.begin()), static_cast<Index>(b - pieces.begin())},
           find_shared_faces(*get<Surface>(*a), *get<Surface>(*b), pairs)});
    }
    return joined.domain.add(join_surfaces<Real>(vertices.count, surfaces, seams));
  }

  const Domain& given_;
  const std::vector<std::vector<Point3>>& positions_;
  DisjointSets sets_;
  std::map<std::pair<Index, Index>, Pairs> inside_;  // what is welded, by pieces
  std::vector<std::vector<Index>> parts_;
  std::vector<std::vector<Point3>> places_;  // of solids' vertices
  std::vector<std::vector<Index>> inside_to_given_;
};

}  // namespace

template <class Real>
std::shared_ptr<const JoinedPieces<Real>> JoinedPieces<Real>::of(const MixedComplex<Real>& given) {
  Joiner<Real> joiner(given, given.positions_);
  return joiner.find_parts() ? joiner.build() : nullptr;
}

template struct JoinedPieces<float>;
template struct JoinedPieces<double>;

}  // namespace plexway::detail
