#include "shape/warnings/field_warnings.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <variant>
#include <vector>

#include <plexway/domain/domains.hpp>

#include "complexes/mixed/joined_pieces.hpp"
#include "complexes/simplicial/simplex_notches.hpp"
#include "shape/warnings/sentences.hpp"
#include "shape/words.hpp"
#include "strings/mixed_strings.hpp"

namespace plexway {
using namespace detail;

namespace detail {

namespace {

std::vector<Warning> cloud_warnings(const CloudSummary& cloud, Reader reader,
                                    const GivenCloud& given) {
  std::vector<Warning> warnings;
  const auto warning = [&](std::string text, bool doubtful = true) {
    warnings.push_back({std::move(text), doubtful});
  };
  const auto said = [&](Advice advice) { return std::string(spelled(advice, reader)); };
  if (cloud.near_duplicates > 0)
    warning(counted(cloud.near_duplicates, "points") +
                " much nearer to an earlier one than all others are: they count as that one",
            false);
  if (100 * cloud.bridges > cloud.distinct)
    warning(counted(cloud.bridges, "points") +
            " hang together by single edges: no surface was found there, and paths go from point "
            "to point; more neighbours may help (" +
            said(Advice::k) + std::to_string(4 * std::max<std::size_t>(given.k, 16)) + ")");
  const std::string in_file = said(Advice::in_the_file), columns = said(Advice::columns);
  const std::string cure = given.normals_refused
                               ? "normals that all point to one side would tell (" +
                                     said(Advice::those) + " do not, and are not taken)"
                               : "normals" + in_file + " tell " + columns;
  if (cloud.torn_points > 0)
    warning(counted(cloud.torn_points, "points") + " (" + std::to_string(cloud.first_torn) +
            " is the first) around holes that could not be closed, as points there do not tell "
            "which side of the surface they are on: distances near them may be far off; " +
            cure);
  if (cloud.chord_points > 0)
    warning(counted(cloud.chord_points, "points") + " (" + std::to_string(cloud.first_chord) +
            " is the first) at sharp ridges where points do not tell how the surface runs: edges "
            "cut through the inside, and distances over them may be far too short; more points "
            "near the ridge help, and " +
            cure);
  if (cloud.joints > 0)
    warning(counted(cloud.joints, "pairs") +
            " of points join parts that have no triangles between them: all paths from one to the "
            "other go over these; " +
            (given.normals_refused ? "" : "normals" + in_file + " " + columns + " or ") +
            "points along the edge where they meet would join them");
  return warnings;
}

// That paths bend at notches, and that tetrahedra which share edges alone look like quads of a
// curved surface.
std::string solid_sentence(const SolidSummary& solid) {
  if (solid.notch_edges > 0)
    return "paths bend around " + counted(solid.notch_edges, "edges") +
           " of the boundary, which no rule sees in a solid by lengths or tensors: distances "
           "behind them may be up to a sixth too short";
  if (solid.boundary_faces == 4 * solid.tets && solid.pinched_edges > 0)
    return "no two of the " + counted(solid.tets, "tetrahedra") +
           " share a face; if they are quads of a surface, split each into the triangles "
           "(0, 1, 2) and (0, 2, 3)";
  return "";
}

// Of simplices that do not lie flat.
template <class Real, int N>
std::string simplices_sentence(const SimplicialComplex<Real, N>& complex) {
  const std::size_t notches = complex.summary().flat ? 0 : count_notches(complex);
  if (notches == 0) return "";
  return "paths bend around " +
         counted(notches, N == 2   ? "corners"
                          : N == 3 ? "edges"
                                   : "triangles") +
         " of the boundary, which no rule sees in simplices by lengths, or that do not lie flat: "
         "distances behind them may be up to a sixth too short";
}

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
  // Of two parts, the vertices of the higher one that are the lower one's, and which.
  std::map<std::pair<Index, Index>, std::unordered_map<Index, Index>> shared;
  for (const auto& weld : complex.welds())
    for (const std::size_t low : {0U, 1U})
      if (dimension(weld.piece[low]) < dimension(weld.piece[1 - low]))
        shared[{weld.piece[low], weld.piece[1 - low]}][weld.vertex[1 - low]] = weld.vertex[low];
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
    for (auto pair = shared.lower_bound({low, 0}); pair != shared.end() && pair->first.first == low;
         ++pair) {
      const std::unordered_map<Index, Index>& there = pair->second;
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
          part(pair->first.second));
    }
    for (std::size_t n = 0; n < edges.size(); ++n) unmatched += has_ends[n] > has_edge[n];
  }
  return unmatched;
}

/// Parts that share vertices but not the edges between them, and paths that go from part to part
/// at some points of a face only. Cost: linear.
template <class Real>
std::vector<Warning> mixed_warnings(const MixedComplex<Real>& complex) {
  std::vector<Warning> warnings;
  if (const std::size_t edges = unmatched_edges(complex); edges > 0)
    warnings.push_back(
        {counted(edges, "edges") + " of wires or surfaces " + (edges == 1 ? "leads" : "lead") +
             " between vertices that another part has too, but not as an edge: between its ends no "
             "path goes from the one to the other; what is meant to lie on that part has to be "
             "made of "
             "its edges or faces",
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

}  // namespace

template <class C>
std::vector<Warning> complex_warnings(const C& complex, Reader reader, const GivenCloud& given) {
  std::string sentence;
  if constexpr (C::kind == DomainKind::cloud)
    return cloud_warnings(complex.summary(), reader, given);
  else if constexpr (C::kind == DomainKind::mixed)
    return mixed_warnings(complex);
  else if constexpr (C::kind == DomainKind::solid)
    sentence = solid_sentence(complex.summary());
  else if constexpr (C::kind == DomainKind::simplices && C::dimension > 1)
    sentence = simplices_sentence(complex);
  if (sentence.empty()) return {};
  return {{std::move(sentence)}};
}

}  // namespace detail

template <DomainType D>
std::vector<Warning> warnings(const D& domain, const DistanceField<RealOf<D>>& field,
                              const PropagateOptions& options) {
  constexpr Reader reader = Reader::people;
  std::vector<Warning> warnings = complex_warnings(domain, reader);
  FieldWork work{.statistics = field.statistics,
                 .accuracy = field.accuracy,
                 .complete = field.complete,
                 .has_windows = domain.metric() == MetricKind::intrinsic &&
                                (D::kind == DomainKind::surface || D::kind == DomainKind::cloud),
                 .has_triangulations = D::kind == DomainKind::surface,
                 .vertices = field.size()};
  if constexpr (D::kind == DomainKind::surface) {
    work.in_space = domain.faces_are_in_space();
    if (sizeof(RealOf<D>) == sizeof(float) && domain.unit() > 0)
      work.edges = largest_of(field) / domain.unit();
  }
  for (Warning& one : work_warnings(work, reader)) warnings.push_back(std::move(one));
  if (const std::size_t unreached = count_unreached(field); unreached > 0) {
    std::string why;
    if constexpr (requires { domain.summary().components; })
      if (domain.summary().components > 1)
        why = "the " + std::string(kind_noun(D::kind)) + " has " +
              counted(domain.summary().components, "components");
    warnings.push_back(unreached_warning(unreached, std::move(why), is_bounded(options), reader));
  }
  return warnings;
}

#define PLEXWAY_COMPILE(...)                                                         \
  template std::vector<Warning> detail::complex_warnings(const __VA_ARGS__&, Reader, \
                                                         const GivenCloud&);         \
  template std::vector<Warning> warnings(                                            \
      const __VA_ARGS__&, const DistanceField<__VA_ARGS__::Number>&, const PropagateOptions&);
PLEXWAY_DOMAINS(PLEXWAY_COMPILE)
#undef PLEXWAY_COMPILE

}  // namespace plexway
