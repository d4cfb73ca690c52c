#include "shape/warnings/field_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <plexway/domain/domains.hpp>

#include "complexes/simplicial/simplex_notches.hpp"
#include "shape/warnings/mixed_warnings.hpp"
#include "shape/warnings/sentences.hpp"
#include "shape/words.hpp"

namespace plexway {

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

template <class Real>
double largest_of(const DistanceField<Real>& field) {
  double most = 0;
  for (const Real d : field)
    if (std::isfinite(d)) most = std::max(most, static_cast<double>(d));
  return most;
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
  const auto unreached = static_cast<std::size_t>(
      std::count_if(field.begin(), field.end(), [](auto d) { return !std::isfinite(d); }));
  if (unreached > 0) {
    std::string why;
    if constexpr (requires { domain.summary().components; })
      if (domain.summary().components > 1)
        why = "the " + std::string(kind_noun(D::kind)) + " has " +
              counted(domain.summary().components, "components");
    warnings.push_back(unreached_warning(unreached, std::move(why), is_bounded(options), reader));
  }
  return warnings;
}

#define PLEXWAY_COMPILE(...)                                                                     \
  template std::vector<Warning> complex_warnings(const __VA_ARGS__&, Reader, const GivenCloud&); \
  template std::vector<Warning> warnings(                                                        \
      const __VA_ARGS__&, const DistanceField<__VA_ARGS__::Number>&, const PropagateOptions&);
PLEXWAY_DOMAINS(PLEXWAY_COMPILE)
#undef PLEXWAY_COMPILE

}  // namespace plexway
