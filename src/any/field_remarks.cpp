#include "any/field_remarks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <plexway/complex/point_cloud.hpp>

#include "any/arguments/source_argument.hpp"
#include "any/bent_crossings.hpp"
#include "any/cloud_words.hpp"
#include "any/rim_detours.hpp"
#include "any/words.hpp"

namespace plexway {

FieldReach reach_of(std::span<const double> distance, std::span<const Source> sources) {
  FieldReach outcome;
  outcome.max_distance = -std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < distance.size(); ++v) {
    if (!std::isfinite(distance[v])) continue;
    ++outcome.reached;
    if (distance[v] <= outcome.max_distance) continue;
    outcome.max_distance = distance[v];
    outcome.farthest = v;
  }
  std::set<Index> at;
  const auto take = [&](Index v) {
    if (v != none && std::isfinite(distance[v])) at.insert(v);
  };
  for (const Source& source : sources) {
    if (const auto* point = std::get_if<PointSource>(&source)) {
      ++outcome.sources;
      take(point->vertex);
    }
    if (const auto* set = std::get_if<VertexSource>(&source)) {
      outcome.sources += set->vertices.size();
      for (const Index v : set->vertices) take(v);
    }
  }
  // Where sets leave nothing to reach, nothing failed.
  const bool covered = at.size() == distance.size() && as_points(sources).empty();
  outcome.beside_source = covered ? at.size() : outcome.reached - at.size();
  outcome.from.assign(at.begin(), at.end());
  return outcome;
}

namespace {

// Vertices in no simplex.
std::size_t count_apart(const AnyShape& domain) {
  std::vector<bool> used(domain.vertices(), false);
  for (std::size_t s = 0; s < domain.simplices(); ++s)
    for (const auto v : domain.corners(s)) used[v] = true;
  return static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
}

// Why not all was reached.
std::string why_unreached(const AnyDomain& solver, bool bounded) {
  const AnyShape& domain = solver.shape();
  std::string why;
  if (domain.cloud() != nullptr) {
    if (solver.components() > 1) why = why_disconnected(*domain.cloud(), solver.components());
  } else {
    why = "the " + std::string(kind_noun(domain.kind())) + " has " +
          counted(solver.components(), "components");
    if (const std::size_t apart = count_apart(domain); apart > 0) {
      why.append(", ").append(counted(apart, "vertices")).append(apart == 1 ? " is" : " are");
      why.append(" in none of its ").append(domain.simplex_name());
    }
  }
  if (bounded) why.append(why.empty() ? "" : ", and ").append(bounded_search);
  return why;
}

}  // namespace

std::vector<std::string> field_remarks(const AnyDomain& solver, const AnyField& field,
                                       const FieldReach& outcome, bool bounded) {
  std::vector<std::string> remarks;
  const auto remark = [&](std::string text) { remarks.push_back(std::move(text)); };
  const bool single = solver.precision() == Precision::single;
  const AnyShape& domain = solver.shape();
  if (domain.cloud() != nullptr && domain.cloud()->not_finite > 0)
    remark(counted(domain.cloud()->not_finite, "points") +
           " not finite, and dropped: vertices count those that are left; the column original "
           "has their numbers in the file");
  if (const CloudSummary* cloud = solver.cloud()) {
    if (cloud->near_duplicates > 0)
      remark(counted(cloud->near_duplicates, "points") +
             " much nearer to an earlier one than all others are: they count as that one");
    if (100 * cloud->bridges > cloud->distinct)
      remark(counted(cloud->bridges, "points") +
             " hang together by single edges: no surface was found there, and ways go from point "
             "to point; more neighbours may help (--k " +
             std::to_string(4 * std::max<std::size_t>(domain.cloud()->k, 16)) + ")");
    const bool refused =
        !domain.cloud()->points.normals.empty() && domain.cloud()->normals().empty();
    const std::string cure = refused
                                 ? "normals that all point to one side would tell (those in the "
                                   "file do not, and are not taken)"
                                 : "normals in the file tell (columns nx ny nz)";
    if (cloud->torn_points > 0)
      remark(counted(cloud->torn_points, "points") + " (" + std::to_string(cloud->first_torn) +
             " is the first) around holes that could not be closed, as points there do not tell "
             "which side of the surface they are on: distances near them may be far off; " +
             cure);
    if (cloud->chord_points > 0)
      remark(counted(cloud->chord_points, "points") + " (" + std::to_string(cloud->first_chord) +
             " is the first) at sharp ridges where points do not tell how the surface runs: edges "
             "cut through the inside, and distances over them may be far too short; more points "
             "near the ridge or less noise (--smooth) help, and " +
             cure);
    if (cloud->joints > 0)
      remark(counted(cloud->joints, "pairs") +
             " of points join parts that have no triangles between them: all ways from one to the "
             "other go over these; normals in the file (columns nx ny nz) or points along the edge "
             "where they meet would join them");
    const RimDetours detours =
        rim_detours(domain.positions(), cloud->mean_spacing, field.doubles(), outcome.from);
    if (detours.points > 0)
      remark(counted(detours.points, "points") + " (" + std::to_string(detours.first) +
             " is the first) " + (detours.points == 1 ? "is" : "are") + " 5 to " +
             std::to_string(static_cast<int>(std::ceil(100 * detours.most))) +
             " % farther from the source than straight, though the cloud is flat there: ways go "
             "around a notch in its rim or a void; that is too far if the surface does not end "
             "there, and more points there help");
  }
  if (const BentCrossings bent = bent_crossings(solver); bent.hinges > 0)
    remark("solids have " + counted(bent.edges, "edges") +
           " around which ways bend, and faces or edges where the speed changes: single vertices "
           "whose ways do both may be up to a tenth too far" +
           (bent.cracks > 0 ? ", most of all where cracks end on such faces; where cracks join on "
                              "one, single vertices may be too near, by two thirds at worst"
                            : ""));
  // A single crack has two ends.
  const SolidBends bends = solid_bends(solver);
  if (bends.cracks > 0 && bends.edges > 2)
    remark("the solid has cracks, and " + counted(bends.edges, "edges") +
           " around which ways bend: single vertices behind several of them may be up to a tenth "
           "too far");
  if (bends.edges > 0 && outcome.sources > 1)
    remark(
        "ways from several sources bend around " + counted(bends.edges, "edges") +
        " of the solid: single vertices between what is nearest to the one and to the other "
        "may be up to a quarter too far; the least of a field from each source is more accurate");
  if (!field.complete()) {
    remark("stopped after " + counted(field.statistics().expansions, "expansions") +
           ": distances may still be too long");
  }
  // Labels that got much wrong say so, and windows are the cure where there are any. Where speeds
  // jump there are none, and what travels along an edge is lowered though nothing is wrong.
  const bool has_windows =
      (domain.kind() == DomainKind::surface || domain.kind() == DomainKind::cloud) &&
      solver.refracting_edges() == 0;
  const bool by_labels = field.accuracy() == Accuracy::fast();
  const std::string cure = has_windows && by_labels ? "; --accuracy accurate has none of this" : "";
  const std::size_t raised = field.statistics().raised_vertices;
  if (100 * raised > domain.vertices())
    remark(counted(raised, "vertices") +
           " came out nearer than the straight line through space, and were given its length: "
           "distances here are poor" +
           (cure.empty() ? "; another --triangulation may do better" : cure));
  const std::size_t lowered = field.statistics().lowered_vertices;
  if ((cure.empty() ? 20 : 50) * lowered > domain.vertices())
    remark(counted(lowered, "vertices") +
           " came out farther than a neighbour and the edge between, and were given that way: "
           "distances here are less accurate" +
           cure);
  // Rounding turns a line of sight a little at each edge. Where a straight line in space is known
  // it mends what windows lose by that.
  const double too_many = domain.positions().empty() && !by_labels ? 1e4 : 5e4;
  if (single && outcome.max_distance > too_many * solver.mean_edge() && solver.mean_edge() > 0)
    remark("distances of up to " + short_number(outcome.max_distance / solver.mean_edge()) +
           " edges: single precision may be off by more than 1e-4; use --precision double");
  const std::size_t unreached = domain.vertices() - outcome.reached;
  if (unreached == 0) return remarks;
  const std::string why = why_unreached(solver, bounded);
  remark(counted(unreached, "vertices") + " not reached (inf)" + (why.empty() ? "" : ": " + why));
  return remarks;
}

}  // namespace plexway
