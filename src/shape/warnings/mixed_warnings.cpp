#include "shape/warnings/mixed_warnings.hpp"

#include <algorithm>
#include <array>
#include <type_traits>
#include <unordered_map>
#include <unordered_set>
#include <variant>
#include <vector>

#include "complexes/mixed/joined_pieces.hpp"
#include "shape/words.hpp"
#include "strings/mixed_space.hpp"

namespace plexway {
namespace {

using Edge = std::array<Index, 2>;

// Calls visit(a, b) for the edges of simplices, by vertices inside; those of several not once.
template <class Complex, class Visit>
void each_edge(const Complex& complex, const Visit& visit) {
  const auto all_of = [&](const auto& simplices) {
    for (const auto& simplex : simplices)
      for (std::size_t i = 0; i < std::size(simplex.corner); ++i)
        for (std::size_t k = i + 1; k < std::size(simplex.corner); ++k)
          if (simplex.corner[i] != simplex.corner[k])  // as the last one's, which is none
            visit(simplex.corner[i], simplex.corner[k]);
  };
  if constexpr (requires { complex.tets(); }) {
    all_of(complex.tets());
  } else if constexpr (requires { complex.triangles(); }) {
    all_of(complex.triangles());
  } else {
    for (Index v = 0; v + 1 < complex.begin().size(); ++v)
      for (Index a = complex.begin()[v]; a < complex.begin()[v + 1]; ++a)
        if (complex.arcs()[a].to != v) visit(v, complex.arcs()[a].to);
  }
}

// Edges of wires and surfaces between vertices that a part of a higher dimension has too, but not
// the edge.
template <class Real>
std::size_t unmatched_edges(const MixedComplex<Real>& complex) {
  const auto part = [&](Index piece) -> const auto& {
    return complex.complex(complex.pieces()[piece]);
  };
  const auto dimension = [&](Index piece) {
    return std::visit([](const auto& c) { return std::decay_t<decltype(c)>::dimension; },
                      part(piece));
  };
  std::size_t unmatched = 0;
  for (Index low = 0; low < complex.pieces().size(); ++low) {
    // Its edges, and of each whether a part has both ends, and whether one has it.
    std::vector<Edge> edges;
    std::visit(
        [&](const auto& c) {
          each_edge(c, [&](Index a, Index b) {
            edges.push_back({std::min(a, b), std::max(a, b)});
          });
        },
        part(low));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::vector<char> has_ends(edges.size(), 0), has_edge(edges.size(), 0);
    for (Index high = 0; high < complex.pieces().size(); ++high) {
      if (dimension(high) <= dimension(low)) continue;
      std::unordered_map<Index, Index> there;  // of the higher one's vertices
      for (const auto& weld : complex.welds())
        for (const std::size_t side : {0, 1})
          if (weld.piece[side] == low && weld.piece[1 - side] == high)
            there[weld.vertex[1 - side]] = weld.vertex[side];
      if (there.size() < 2) continue;
      std::unordered_set<Index> ends;
      for (const auto& [of_high, of_low] : there) ends.insert(of_low);
      for (std::size_t n = 0; n < edges.size(); ++n)
        if (ends.contains(edges[n][0]) && ends.contains(edges[n][1])) has_ends[n] = 1;
      std::visit(
          [&](const auto& c) {
            each_edge(c, [&](Index a, Index b) {
              const auto p = there.find(a), q = there.find(b);
              if (p == there.end() || q == there.end()) return;
              const Edge edge = {std::min(p->second, q->second), std::max(p->second, q->second)};
              const auto at = std::lower_bound(edges.begin(), edges.end(), edge);
              if (at != edges.end() && *at == edge)
                has_edge[static_cast<std::size_t>(at - edges.begin())] = 1;
            });
          },
          part(high));
    }
    for (std::size_t n = 0; n < edges.size(); ++n) unmatched += has_ends[n] > has_edge[n];
  }
  return unmatched;
}

}  // namespace

template <class Real>
std::vector<Warning> mixed_warnings(const MixedComplex<Real>& complex) {
  std::vector<Warning> warnings;
  if (const std::size_t edges = unmatched_edges(complex); edges > 0)
    warnings.push_back(
        {counted(edges, "edges") + " of wires or surfaces " + (edges == 1 ? "leads" : "lead") +
             " between vertices that another part has too, but not as an edge: between its ends no "
             "path goes from the one to the other; a wire has to be made of the other part's "
             "edges, a surface of its faces",
         false});
  if (MixedSpace::of(complex)->media) return warnings;
  const auto joined = complex.joined();
  if ((joined ? joined->domain : complex).hinges().empty()) return warnings;
  warnings.push_back(
      {"paths go from part to part at vertices and at the middles of edges only, as a part has no "
       "positions, a surface is curved, or a simplex does not lie at one speed where its corners "
       "are: distances are some 1e-3 too far, at single vertices some per cent",
       true});
  return warnings;
}

template std::vector<Warning> mixed_warnings(const MixedComplex<float>&);
template std::vector<Warning> mixed_warnings(const MixedComplex<double>&);

}  // namespace plexway
