#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <iterator>
#include <string>
#include <type_traits>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "executors/scenes.hpp"
#include "labels/solving.hpp"

namespace plexway::testing {

inline constexpr Accuracy accuracies[] = {Accuracy::fast(), Accuracy::accurate(), Accuracy::exact(),
                                          Accuracy::usual()};

/// All of these with each other.
struct Way {
  Visibility visibility;
  Accuracy accuracy;
  Schedule schedule;
};
inline constexpr std::size_t ways_count =
    std::size(visibilities) * std::size(accuracies) * std::size(schedules);
inline std::vector<Way> all_ways() {
  std::vector<Way> all;
  for (const Visibility visibility : visibilities)
    for (const Accuracy accuracy : accuracies)
      for (const Schedule schedule : schedules) all.push_back({visibility, accuracy, schedule});
  return all;
}

/// Cells of the table that were gone through.
struct Count {
  std::size_t yes = 0, no = 0;
};

/// How far off a field may be; all domains are about 1 across. By the best rule a way that is
// straight is exact up to rounding. Not so where paths are refracted (tests/metric/snell_test.cpp
// has it in full), and where the fronts of two sources, or of a curve and its ends, meet in a
// simplex: it keeps one of the two labels. Windows keep both.
template <class D>
double tolerance(const Combination& cell, const Asked& asked, double edge) {
  if (cell.metric == MetricKind::refracting) return 4e-2;
  if (cell.accuracy == Accuracy::Kind::exact) return 1e-12;
  if (cell.accuracy == Accuracy::Kind::merged) return 1e-3;
  const bool exact = D::kind == DomainKind::wireframe || cell.visibility == Visibility::saddles;
  if (!exact) return 0.25;  // bends where it need not
  const bool fronts = std::holds_alternative<VertexSource>(asked.source) ||
                      cell.source == SourceKind::curve || cell.source == SourceKind::simplex;
  if (fronts && D::kind != DomainKind::wireframe) return 0.2 * edge;
  return cell.single_precision ? 4e-6 : 1e-12;
}

/// Every cell of the table for a domain: every yes is right by the closed form, every no says its
/// sentence; and many fields are what single ones are.
template <class E, class D>
void check_scene(const E& executor, const Scene<D>& scene, Count& count) {
  INFO(scene.name << (sizeof(RealOf<D>) == 4 ? ", float" : ", double") << ", executor "
                  << static_cast<int>(E::kind));
  const std::vector<Asked> asked = sources_of(scene);
  const std::size_t vertices = scene.domain.vertex_count();
  REQUIRE(scene.places.size() == vertices);
  double edge = 0;
  for (const auto& corners : scene.simplices)
    for (const Index v : corners)
      edge = std::max(edge, straight_between(scene.places[corners[0]], scene.places[v]));
  WorkspaceOf<E, D> workspace;
  DistanceField<RealOf<D>> field;
  for (const Way& way : all_ways()) {
    const auto visibility = way.visibility;
    const auto accuracy = way.accuracy;
    const auto schedule = way.schedule;
    std::vector<Source> each;  // what solve_each goes together with
    PropagateOptions options;
    options.accuracy = accuracy;
    options.visibility = visibility;
    options.schedule = schedule;
    for (const Asked& a : asked) {
      const auto with = [&](auto runs) {
        return combination<decltype(runs), D>(a.kind, visibility, schedule, scene.domain.metric(),
                                              accuracy.kind());
      };
      Combination cell = with(E{});
      const Support verdict = support(cell);
      INFO(a.name << ", visibility " << static_cast<int>(visibility) << ", schedule "
                  << static_cast<int>(schedule) << ", accuracy "
                  << static_cast<int>(accuracy.kind()));
      using EachOf = std::conditional_t<E::kind == ExecutorKind::openmp, Serial, E>;
      if (supports<E, D> && support(with(EachOf{}))) each.push_back(a.source);
      if (!verdict) {
        ++count.no;
        const std::string sentence = verdict.sentence();
        CHECK(sentence.size() > 20);
        if constexpr (supports<E, D>)
          CHECK_THROWS_WITH(solve(executor, scene.domain, a.source, options, workspace, field),
                            sentence);
        else
          CHECK_THROWS_WITH(verdict.require(), sentence);
        continue;
      }
      ++count.yes;
      cell.accuracy = resolved(accuracy, cell).kind();
      if constexpr (supports<E, D>) {
        solve(executor, scene.domain, a.source, options, workspace, field);
        if (D::kind == DomainKind::mixed && accuracy == Accuracy::usual())
          cell.accuracy = field.accuracy.kind();  // sheets that join to one are solved as one
        CHECK(field.accuracy.kind() == cell.accuracy);
        const bool estimated =
            cell.accuracy != Accuracy::Kind::fast && D::kind != DomainKind::solid;
        CHECK(field.error.size() == (estimated ? vertices : 0));
        REQUIRE(field.distance.size() == vertices);
        CHECK(field.complete);
        double worst = 0, below = 0;
        for (Index v = 0; v < vertices; ++v) {
          const double e = static_cast<double>(field.distance[v]) - a.exact(v);
          worst = std::max(worst, std::abs(e));
          if (!std::isfinite(e)) worst = e;
          below = std::min(below, e);
        }
        CHECK(worst <= tolerance<D>(cell, a, edge));
        const bool ball = std::holds_alternative<BallSource>(a.source);  // whose inside turns over
        if (visibility == Visibility::upper_bound && !ball) CHECK(below >= -4e-5);
      }
    }
    if constexpr (supports<E, D>) {
      if (each.empty() || schedule == Schedule::priority) continue;
      const auto rows = solve_each(executor, scene.domain, each, options);
      REQUIRE(rows.rows() == each.size());
      for (std::size_t k = 0; k < rows.rows(); ++k) {
        const auto same = E::kind == ExecutorKind::gl
                              ? solve(executor, scene.domain, each[k], options)
                              : solve(Serial{}, scene.domain, each[k], options);
        CHECK(std::equal(rows.row(k).begin(), rows.row(k).end(), same.distance.begin(),
                         same.distance.end()));
      }
    }
  }
}

}  // namespace plexway::testing
