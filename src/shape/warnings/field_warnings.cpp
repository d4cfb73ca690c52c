#include "shape/warnings/field_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/shape/complex.hpp>

#include "complexes/simplicial/simplex_notches.hpp"
#include "shape/shape_state.hpp"
#include "shape/warnings/cloud_rims.hpp"
#include "shape/warnings/sentences.hpp"
#include "shape/warnings/survey.hpp"
#include "shape/words.hpp"

namespace plexway {
using namespace detail;

namespace detail {

namespace {

// Vertices that are sources, and reached by `distance`: a function of a vertex.
template <class Distance>
std::vector<std::size_t> reached_sources(const Distance& distance, const SourceList& sources) {
  std::set<std::size_t> at;
  const auto take = [&](Index v) {
    if (v != none && std::isfinite(distance(v))) at.insert(v);
  };
  for (const PointSource& point : sources.points()) take(point.vertex);
  for (const Source& source : sources.sources()) {
    if (const auto* point = std::get_if<PointSource>(&source)) take(point->vertex);
    if (const auto* set = std::get_if<VertexSource>(&source))
      for (const Index v : set->vertices) take(v);
  }
  return {at.begin(), at.end()};
}

bool are_points(const SourceList& sources) {
  const auto all = sources.sources();
  return std::all_of(all.begin(), all.end(), [](const Source& source) {
    return std::holds_alternative<PointSource>(source);
  });
}

}  // namespace

FieldReach reach_of(std::span<const double> distance, const SourceList& sources) {
  FieldReach outcome;
  outcome.max_distance = -std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < distance.size(); ++v) {
    if (!std::isfinite(distance[v])) continue;
    ++outcome.reached;
    if (distance[v] <= outcome.max_distance) continue;
    outcome.max_distance = distance[v];
    outcome.farthest = v;
  }
  outcome.from = reached_sources([&](Index v) { return distance[v]; }, sources);
  // Where sets leave nothing to reach, nothing failed.
  const bool covered = outcome.from.size() == distance.size() && !are_points(sources);
  outcome.beside_source = covered ? outcome.from.size() : outcome.reached - outcome.from.size();
  return outcome;
}

namespace {

// Which vertices are in a simplex.
std::vector<bool> used_in(const AnyShape& domain) {
  std::vector<bool> used(domain.vertices(), false);
  for (std::size_t s = 0; s < domain.simplices(); ++s)
    for (const auto v : domain.corners(s)) used[v] = true;
  const std::span<const Index> first = domain.merged_vertices();
  for (std::size_t v = 0; v < first.size(); ++v) used[v] = used[first[v]];
  return used;
}

// Why not all was reached.
std::string why_unreached(const AnyDomain& solver, Reader reader) {
  const AnyShape& domain = solver.shape();
  std::string why;
  if (domain.cloud() != nullptr) {
    if (solver.components() > 1)
      why = why_disconnected(*domain.cloud(), solver.components(), reader);
  } else {
    why = "the " + std::string(kind_noun(domain.kind())) + " has " +
          counted(solver.components(), "components");
    const std::vector<bool> used = used_in(domain);
    const auto apart = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
    if (apart > 0) {
      why.append(", ").append(counted(apart, "vertices")).append(apart == 1 ? " is" : " are");
      why.append(" in none of its ").append(domain.simplex_name());
    }
    if (solver.components() > 1)
      if (const std::size_t twins = count_coincident(domain); twins > 0)
        why.append(", and ")
            .append(counted(twins, "vertices"))
            .append(" lie exactly where another does; ")
            .append(spelled(Advice::merge, reader))
            .append(" joins them");
  }
  return why;
}

}  // namespace

std::string apart_sentence(const AnyShape& domain, std::span<const std::size_t> from) {
  if (domain.cloud() != nullptr) return "";
  const std::vector<bool> used = used_in(domain);
  const auto apart =
      std::find_if(from.begin(), from.end(), [&](std::size_t v) { return !used[v]; });
  if (apart == from.end()) return "";
  std::string text = "vertex " + std::to_string(*apart) + " is in none of the " +
                     std::string(domain.simplex_name()) + ", so no other is reached from it";
  const auto at = domain.positions();
  if (at.empty()) return text;
  double least = std::numeric_limits<double>::infinity();
  std::size_t nearest = used.size();
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    const auto &p = at[v], &q = at[*apart];
    const double away = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
    if (away < least) least = away, nearest = v;
  }
  if (nearest < used.size())
    text += "; the nearest that is in one is vertex " + std::to_string(nearest) + ", " +
            short_number(least) + " away";
  return text;
}

}  // namespace detail

std::vector<Warning> domain_warnings(const AnyDomain& solver, Reader reader) {
  std::vector<Warning> warnings;
  const auto warning = [&](std::string text, bool doubtful = true) {
    warnings.push_back({std::move(text), doubtful});
  };
  const auto said = [&](Advice advice) { return std::string(spelled(advice, reader)); };
  const AnyShape& domain = solver.shape();
  if (std::string left_out = collapsed_sentence(domain); !left_out.empty())
    warning(std::move(left_out));
  for (const std::string& note : domain.report().notes) warning(note, false);
  if (const MeasuredLengths* lengths = solver.lengths(); lengths != nullptr && lengths->smoothed)
    warning(smoothed_sentence() + said(Advice::meant));
  if (std::string broken = violations_sentence(solver); !broken.empty()) warning(std::move(broken));
  if (domain.cloud() != nullptr && domain.cloud()->not_finite > 0)
    warning(counted(domain.cloud()->not_finite, "points") +
                " not finite, and dropped: vertices count those that are left; " +
                said(Advice::original) + " their numbers in the file",
            false);
  if (domain.kind() == DomainKind::surface) return warnings;  // nothing but what was said
  GivenCloud given;
  if (const CloudShape* cloud = domain.cloud())
    given = {cloud->k, !cloud->points.normals.empty() && cloud->normals().empty()};
  for (Warning& one : with_complex(
           solver, [&](const auto& complex) { return complex_warnings(complex, reader, given); }))
    warnings.push_back(std::move(one));
  const BridgedGaps gaps =
      with_cloud(solver, [&](const auto& cloud) { return bridged_gaps(*domain.cloud(), cloud); });
  if (gaps.triangles > 0)
    warning(
        counted(gaps.triangles, "triangles") + " (point " + std::to_string(gaps.first) +
        " is the first of their points) lie in rows over gaps about twice as wide as points are "
        "apart, or wider, and paths cross them: distances are too short if the surface ends there, "
        "as at a slit; neighbours within less than the gap's width keep it open (" +
        said(Advice::neighbour_radius) + ")");
  return warnings;
}

namespace detail {

std::vector<Warning> work_warnings(const FieldWork& work, Reader reader) {
  std::vector<Warning> warnings;
  const auto warning = [&](std::string text) { warnings.push_back({std::move(text)}); };
  const auto said = [&](Advice advice) { return std::string(spelled(advice, reader)); };
  const PropagateStatistics& done = work.statistics;
  const std::size_t all = work.vertices * work.fields;
  const std::string rows = work.fields > 1 ? " of " + counted(work.fields, "rows") : "";
  if (const std::size_t fields = done.windows_gave_up; fields > 0)
    warning("windows became too many to wait for" +
            (fields > 1 ? " from " + counted(fields, "sources") : std::string()) +
            ": the distances are those of " + said(Advice::fast) + "; " + said(Advice::exact) +
            " waits longer");
  if (!work.complete)
    warning("stopped after " + counted(done.expansions, "expansions") +
            ": distances may still be too long");
  // Labels that got much wrong say so, and windows are the cure where there are any. Where speeds
  // jump there are none, and what travels along an edge is lowered though nothing is wrong.
  const bool cured = work.has_windows && work.accuracy == Accuracy::fast();
  const std::string cure = cured ? "; " + said(Advice::accurate) + " has none of this" : "";
  // By windows it is rounding alone that makes distances too short.
  const bool rounds = work.edges > 0 && work.accuracy != Accuracy::fast();
  const std::size_t raised = done.raised_vertices;
  if (100 * raised > all)
    warning(
        counted(raised, "vertices") + rows +
        " came out nearer than the straight line through space by more than 1e-3 of it, and were "
        "given its length: distances here are poor" +
        (cured                     ? cure
         : rounds                  ? "; " + said(Advice::twice) + " may do better"
         : work.has_triangulations ? "; another " + said(Advice::triangulation) + " may do better"
                                   : ""));
  const std::size_t lowered = done.lowered_vertices;
  if ((cured ? 50 : 20) * lowered > all)
    warning(counted(lowered, "vertices") + rows +
            " came out farther than a neighbour and the edge between, and were set to that length: "
            "distances here are less accurate" +
            cure);
  // Rounding turns a line of sight a little at each edge. Where a straight line in space is known
  // it repairs what windows lose by that.
  const bool by_labels = work.accuracy == Accuracy::fast();
  if (work.edges > (!work.in_space && !by_labels ? 1e4 : 5e4))
    warning("distances of up to " + short_number(work.edges) +
            " edges: single precision may be off by more than 1e-4; use " + said(Advice::twice));
  return warnings;
}

}  // namespace detail

namespace {

FieldWork work_of(const AnyDomain& domain, const PropagateStatistics& statistics,
                  Accuracy accuracy) {
  const bool has_windows =
      (domain.kind() == DomainKind::surface || domain.kind() == DomainKind::cloud) &&
      domain.refracting_edges() == 0;
  return {.statistics = statistics,
          .accuracy = accuracy,
          .has_windows = has_windows,
          .has_triangulations = domain.kind() == DomainKind::surface,
          .vertices = domain.vertices()};
}

// A rim that is known to some spacings only, if that matters at the field's size.
std::string rims_sentence(const AnyDomain& solver, double farthest) {
  constexpr double spacings = 4, share = 0.05;
  const CloudSummary* const cloud = solver.cloud();
  if (cloud == nullptr || spacings * cloud->mean_spacing < share * farthest) return "";
  const ScatteredRims rims = with_cloud(
      solver, [&](const auto& sheet) { return scattered_rims(*solver.shape().cloud(), sheet); });
  if (rims.points == 0) return "";
  return "the points are scattered as by chance, and paths bend around corners of their rim (" +
         std::to_string(rims.first) +
         " is the first of their points): where it runs is known to some spacings alone, of " +
         short_number(cloud->mean_spacing) +
         " each, and distances behind it may be off by four; points along the rim help, or evenly "
         "spaced ones";
}

}  // namespace

std::vector<Warning> field_warnings(const AnyDomain& solver, const AnyField& field,
                                    const SourceList& sources, Reader reader) {
  std::vector<Warning> warnings;
  const auto warning = [&](std::string text) { warnings.push_back({std::move(text)}); };
  const AnyShape& domain = solver.shape();
  const double largest = std::visit([](const auto& f) { return largest_of(f); }, field.data);
  const auto from = [&] { return reached_sources([&](Index v) { return field[v]; }, sources); };
  if (!(largest > 0))
    if (std::string apart = apart_sentence(domain, from()); !apart.empty())
      warning(std::move(apart));
  if (const CloudSummary* cloud = solver.cloud()) {
    const RimDetours detours =
        rim_detours(domain.positions(), cloud->mean_spacing, field.doubles(), from());
    if (detours.points > 0)
      warning(counted(detours.points, "points") + " (" + std::to_string(detours.first) +
              " is the first) " +
              (detours.all ? detours.points == 1 ? "is" : "are" : "and more are") + " 5 to " +
              std::to_string(static_cast<int>(std::ceil(100 * detours.most))) +
              " % farther from the source than straight, though the cloud is flat there: paths go "
              "around a notch in its rim or a void; that is too far if the surface does not end "
              "there, and more points there help");
  }
  if (std::string rims = rims_sentence(solver, largest); !rims.empty()) warning(std::move(rims));
  FieldWork work = work_of(solver, field.statistics(), field.accuracy());
  work.complete = field.complete();
  work.in_space = !domain.positions().empty();
  if (const double edge = solver.mean_edge(); solver.precision() == Precision::float32 && edge > 0)
    work.edges = largest / edge;
  for (Warning& one : work_warnings(work, reader)) warnings.push_back(std::move(one));
  return warnings;
}

namespace detail {

bool is_bounded(const PropagateOptions& options) {
  return std::isfinite(options.radius) ||
         options.max_expansions != PropagateOptions{}.max_expansions;
}

Warning unreached_warning(std::size_t count, std::string why, bool bounded, Reader reader) {
  if (bounded)
    why.append(why.empty() ? "" : ", and ")
        .append(spelled(Advice::bounds, reader))
        .append(" ends the search early");
  return {counted(count, "vertices") + " not reached (inf)" + (why.empty() ? "" : ": " + why),
          false};
}

}  // namespace detail

std::vector<Warning> reach_warnings(const AnyDomain& domain, const AnyField& field,
                                    const PropagateOptions& options, Reader reader) {
  const std::size_t unreached =
      std::visit([](const auto& f) { return count_unreached(f); }, field.data);
  if (unreached == 0) return {};
  return {unreached_warning(unreached, why_unreached(domain, reader), is_bounded(options), reader)};
}

std::vector<Warning> warnings(const AnyDomain& domain, const AnyField& field,
                              const SourceList& sources, const PropagateOptions& options,
                              Reader reader) {
  std::vector<Warning> all = domain_warnings(domain, reader);
  for (auto& some : {field_warnings(domain, field, sources, reader),
                     reach_warnings(domain, field, options, reader)})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

std::vector<Warning> rows_warnings(const AnyDomain& domain, const PropagateStatistics& sum,
                                   Accuracy accuracy, std::size_t rows, Reader reader) {
  FieldWork work = work_of(domain, sum, accuracy);
  work.fields = rows;
  return work_warnings(work, reader);
}

}  // namespace plexway
