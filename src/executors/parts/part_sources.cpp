#include "executors/parts/part_sources.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include <plexway/error.hpp>

#include "complexes/common/geometry.hpp"
#include "complexes/common/number_range.hpp"

namespace plexway::detail {
namespace {

/// Numbers of the surface that sources name, and which these are.
class Named {
 public:
  void add(Index number, std::size_t source) {
    all_.push_back({number, static_cast<Index>(source)});
  }
  void sort() { std::sort(all_.begin(), all_.end()); }
  /// Calls visit(source) for each that names it.
  template <class Visit>
  void at(Index number, const Visit& visit) const {
    for (auto found = std::lower_bound(all_.begin(), all_.end(), std::pair(number, Index{0}));
         found != all_.end() && found->first == number; ++found)
      visit(found->second);
  }

 private:
  std::vector<std::pair<Index, Index>> all_;
};

}  // namespace

PartSources::Here PartSources::Here::ascending() const {
  std::vector<std::size_t> order(numbers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
  Here sorted;
  for (const std::size_t n : order) {
    sorted.points.push_back(points[n]);
    sorted.numbers.push_back(numbers[n]);
  }
  return sorted;
}

template <class Real>
PartSources part_sources(PieceRanks* ranks, const PartPieces<Real>& pieces,
                         std::span<const PointSource> sources) {
  PartSources found{sources, std::vector<PartSources::Here>(pieces.parts().size()), {}};
  Named vertices, faces;
  for (std::size_t n = 0; n < sources.size(); ++n)
    sources[n].vertex != none ? vertices.add(sources[n].vertex, n)
                              : faces.add(sources[n].simplex, n);
  vertices.sort();
  faces.sort();
  // Bits of numbers that one process knows: the first piece at a vertex, or whose triangle it is.
  constexpr std::size_t each = 7;
  std::vector<std::uint64_t> told(each * sources.size(), 0);
  const auto tell = [&](Index n, const std::array<double, 3>& at,
                        const std::array<double, 3>& origin) {
    std::uint64_t* const own = &told[each * n];
    own[0] = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      own[1 + d] = std::bit_cast<std::uint64_t>(at[d]);
      own[4 + d] = std::bit_cast<std::uint64_t>(origin[d]);
    }
  };
  for (std::size_t i = 0; i < pieces.parts().size(); ++i) {
    const PartPiece<Real>& part = pieces.parts()[i];
    const CutPiece& cut = pieces.cut_of(part);
    PartSources::Here& here = found.here[i];
    const auto positions = part.mesh->positions();
    // Those named by numbers that the piece has; here_as(source) is which it is there.
    const auto take = [&](const Named& named, std::span<const Index> numbers, const auto& here_as,
                          const auto& is_sent, const auto& where) {
      for (Index k = 0; k < numbers.size(); ++k)
        named.at(numbers[k], [&](Index n) {
          here.points.push_back(sources[n]);
          here_as(here.points.back()) = k;
          here.numbers.push_back(n);
          if (is_sent(k)) tell(n, where(here.points.back()), part.origin);
        });
    };
    take(
        vertices, part.vertices, [](PointSource& s) -> Index& { return s.vertex; },
        [&](Index v) { return part.is_first(v, cut); },
        [&](const PointSource& s) { return positions[s.vertex]; });
    take(
        faces, cut.simplices, [](PointSource& s) -> Index& { return s.simplex; },
        [&](Index f) { return f < part.own; },
        [&](const PointSource& s) {
          std::array<double, 3> at{};
          for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t d = 0; d < 3; ++d)
              at[d] += s.barycentric[c] * positions[part.mesh->triangles()[s.simplex].corner[c]][d];
          return at;
        });
  }
  add_up(ranks, told);
  found.sites.assign(sources.size(), {{infinity, infinity, infinity}, {0, 0, 0}});
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const std::uint64_t* const own = &told[each * n];
    if (own[0] == 0) continue;
    for (std::size_t d = 0; d < 3; ++d) {
      found.sites[n].at[d] = std::bit_cast<double>(own[1 + d]);
      found.sites[n].origin[d] = std::bit_cast<double>(own[4 + d]);
    }
  }
  return found;
}

template <class Real>
PartPoint nearest_on(const Team& team, const PartPieces<Real>& pieces,
                     const std::array<double, 3>& point) {
  for (const double x : point)
    if (!std::isfinite(x)) throw UsageError("a point's coordinates must be finite");
  // As a piece sees it; in mean edges.
  const auto from = [&](const PartPiece<Real>& part) {
    std::array<double, 3> seen;
    for (std::size_t d = 0; d < 3; ++d) seen[d] = (point[d] - part.origin[d]) / pieces.unit();
    return seen;
  };
  std::vector<double> of_part(pieces.parts().size(), infinity);
  std::vector<std::vector<double>> distances(of_part.size());  // of own triangles
  team.each(of_part.size(), [&](std::size_t i) {
    const PartPiece<Real>& part = pieces.parts()[i];
    const auto positions = part.mesh->positions();
    const auto seen = from(part);
    distances[i].resize(part.own);
    for (std::size_t f = 0; f < part.own; ++f) {
      std::array<std::array<double, 3>, 3> corners;
      double size = 0;
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t d = 0; d < 3; ++d) {
          corners[c][d] = positions[part.mesh->triangles()[f].corner[c]][d] - seen[d];
          size = std::max(size, std::abs(corners[c][d]));
        }
      if (size > 0)
        for (auto& corner : corners)
          for (double& x : corner) x /= size;
      distances[i][f] = size * std::sqrt(squared_distance(corners));
      of_part[i] = std::min(of_part[i], distances[i][f]);
    }
  });
  double least = infinity;
  for (const double one : of_part) least = std::min(least, one);
  least = least_of(team.ranks(), least);
  // What two pieces compute for one point of an edge differs by rounding.
  struct Found {
    Index face = none;
    double distance = 0;
    PointSource source;
  };
  Found best;
  for (std::size_t i = 0; i < of_part.size(); ++i) {
    const PartPiece<Real>& part = pieces.parts()[i];
    const auto positions = part.mesh->positions();
    const auto seen = from(part);
    double size = 1;
    for (const double x : seen) size = std::max(size, std::abs(x));
    const double near = least + 1e-14 * size;
    if (!(of_part[i] <= near)) continue;
    const auto& numbers = pieces.cut_of(part).simplices;
    std::size_t first = part.own;
    for (std::size_t f = 0; f < part.own; ++f)
      if (distances[i][f] <= near && (first == part.own || numbers[f] < numbers[first])) first = f;
    if (numbers[first] > best.face) continue;
    const auto& corner = part.mesh->triangles()[first].corner;
    const std::array<std::array<double, 3>, 3> at = {positions[corner[0]], positions[corner[1]],
                                                     positions[corner[2]]};
    constexpr std::array<std::array<std::uint32_t, 3>, 1> alone = {{{0, 1, 2}}};
    SimplexPoint place = closest_point(at, alone, seen);
    place.simplex = numbers[first];
    const std::array<Index, 3> ends = {part.vertices[corner[0]], part.vertices[corner[1]],
                                       part.vertices[corner[2]]};
    best = {numbers[first], distances[i][first] * pieces.unit(), source_at(place, ends)};
  }
  RankMail mail(team.ranks());
  for (std::size_t r = 0; r < mail.count(); ++r) mail.to(r).add(best);
  mail.meet();
  for (const Found& other : mail.template all<Found>())
    if (other.face < best.face) best = other;
  return {best.source, best.distance};
}

template PartSources part_sources(PieceRanks*, const PartPieces<float>&,
                                  std::span<const PointSource>);
template PartSources part_sources(PieceRanks*, const PartPieces<double>&,
                                  std::span<const PointSource>);
template PartPoint nearest_on(const Team&, const PartPieces<float>&, const std::array<double, 3>&);
template PartPoint nearest_on(const Team&, const PartPieces<double>&, const std::array<double, 3>&);

}  // namespace plexway::detail
