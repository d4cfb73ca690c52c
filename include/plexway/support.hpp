#pragma once

#include <type_traits>

#include <plexway/domain/concept.hpp>
#include <plexway/executors.hpp>
#include <plexway/propagate/options.hpp>

/// @file
/// The table of what goes together, and the sentence that says why something does not.
// What goes with what. Everything that can be solved, and everything that is refused and why, is
// decided here and nowhere else.
namespace plexway {

/// What a field starts from, as far as it matters here (source/source.hpp).
enum class SourceKind {
  vertex,   ///< a vertex, or a set of them; balls about one
  point,    ///< a point of a simplex; balls about one
  curve,    ///< a CurveSource of more than one point
  simplex,  ///< a SimplexSource
};

/// Why not, each in one sentence that says what to do instead. `X(name, sentence)`.
#define PLEXWAY_REFUSALS(X)                                                                        \
  X(gl_domain,                                                                                     \
    "the executor GL takes surfaces, solids, wireframes and clouds: use the executor Serial")      \
  X(gl_double, "the executor GL computes in single precision: make the domain of float")           \
  X(gl_lengths,                                                                                    \
    "the executor GL needs coordinates of a solid, not lengths alone: use the executor Serial")    \
  X(gl_refraction,                                                                                 \
    "the executor GL does not refract paths: use the executor Serial, or build the surface with "  \
    "one length an edge")                                                                          \
  X(gl_visibility, "the executor GL knows Visibility::saddles only: use another executor")         \
  X(order,                                                                                         \
    "the schedule priority needs one thread that takes the nearest label: use the executor "       \
    "Serial, or the schedules dual_queue or fifo")                                                 \
  X(mixed_visibility, "mixed domains know the default visibility only")                            \
  X(mixed_order, "mixed domains are not propagated nearest first: use the dual queue")             \
  X(table,                                                                                         \
    "the tuned policy is a table for triangles: use saddles, centroid or upper_bound on other "    \
    "domains")                                                                                     \
  X(refraction_visibility,                                                                         \
    "paths are refracted under Visibility::saddles only: use that, or build the surface with one " \
    "length an edge")                                                                              \
  X(paths_simplices,                                                                               \
    "paths are traced on surfaces, solids, wireframes, clouds and mixed domains: make a complex "  \
    "of simplices of dimension 1 to 3 one of these")                                               \
  X(read_out_labels,                                                                               \
    "distances inside simplices need the labels of the policy saddles, by Serial or OpenMP")       \
  X(read_out_simplices,                                                                            \
    "in complexes of simplices distances are read linearly: ask for ReadOut::linear")              \
  X(read_out_cloud, "a cloud has distances at its points only: take them from the field")          \
  X(directions_domain,                                                                             \
    "directions are those in triangles, tetrahedra and simplices: make a surface of the cloud, "   \
    "and along edges compare the ends")                                                            \
  X(directions_lengths,                                                                            \
    "directions in tetrahedra need their coordinates: build the solid with them, or trace paths")  \
  X(directions_refraction,                                                                         \
    "directions are not told where paths are refracted: build the surface with one length an "     \
    "edge, "                                                                                       \
    "or trace paths")                                                                              \
  X(simplex_labels_gl,                                                                             \
    "the executor GL leaves no labels in simplices: use the executor Serial or OpenMP")            \
  X(simplex_labels_domain,                                                                         \
    "triangles of surfaces and tetrahedra have labels: elsewhere ask those of the vertices")       \
  X(search_domain,                                                                                 \
    "searches that end early are for surfaces: solve other domains, with a radius where one is "   \
    "known")                                                                                       \
  X(search_refraction,                                                                             \
    "searches that end early, and samples, are not refracted: build the surface with one length "  \
    "an edge")                                                                                     \
  X(search_visibility, "searches that end early know the default visibility only: saddles")        \
  X(samples_domain, "points are chosen on surfaces, solids and clouds: make one of these")         \
  X(samples_lengths,                                                                               \
    "points are chosen in solids that have coordinates: build the solid with them")                \
  X(isolines_domain,                                                                               \
    "isolines are drawn on surfaces, clouds and mixed domains: solids have isosurfaces")           \
  X(arcs_domain,                                                                                   \
    "fields are known inside of triangles on surfaces: elsewhere draw straight isolines")          \
  X(isosurfaces_domain, "isosurfaces are those of solids: other domains have isolines, or none")   \
  X(pictures_domain, "pictures are of surfaces, solids, wireframes, clouds and mixed domains")     \
  X(masks_domain,                                                                                  \
    "masks are for surfaces, solids, wireframes and simplices: leave out what is closed when a "   \
    "cloud or a mixed domain is made")                                                             \
  X(metrics_domain,                                                                                \
    "metrics measure surfaces, solids, wireframes and mixed domains: give simplices their "        \
    "lengths, and make a surface of a cloud")                                                      \
  X(metrics_speeds, "mixed domains are measured by speeds only: give one a simplex")               \
  X(regions_domain,                                                                                \
    "regions are those of surfaces, solids, wireframes and mixed domains: other domains have "     \
    "none")                                                                                        \
  X(triangulations_domain,                                                                         \
    "only a surface has triangles to flip: leave the triangulation of other domains as it is")     \
  X(kept_domain,                                                                                   \
    "prepared files are for surfaces, solids, wireframes and clouds: other domains are built "     \
    "each time")                                                                                   \
  X(parts_domain,                                                                                  \
    "surfaces, solids and clouds are written in parts: write other domains to one file")           \
  X(volumes_domain, "only the field of a solid fits a .vdb: take another format")                  \
  X(conversions_domain,                                                                            \
    "surfaces, solids, wireframes and clouds are converted: take mixed domains and simplices as "  \
    "they are")                                                                                    \
  X(boundaries_domain,                                                                             \
    "boundaries are those of surfaces, solids and wireframes: name the vertices of other domains") \
  X(margins_domain,                                                                                \
    "margins are for paths on surfaces and clouds: leave the margin out, other paths have none")   \
  X(margins_refraction,                                                                            \
    "refracted paths are pulled taut and not searched for: leave the margin out")                  \
  X(duals_domain,                                                                                  \
    "only cells on a surface have a dual triangulation: take the cells of other domains as they "  \
    "are")                                                                                         \
  X(error_classes_domain,                                                                          \
    "errors are told apart by place and shape on surfaces and in solids: elsewhere take their "    \
    "mean")                                                                                        \
  X(rows_gl,                                                                                       \
    "rows are solved one a thread, and what is near is looked for by threads: use the executor "   \
    "OpenMP or Serial")                                                                            \
  X(cloud_point, "a source on a cloud is a point by number, not a place in a triangle")            \
  X(point_of_five,                                                                                 \
    "a source in four dimensions must be a vertex: a point of a 4-simplex has five coordinates")   \
  X(shapes,                                                                                        \
    "curves and simplices as sources are for surfaces and wireframes: name points or vertices "    \
    "here")                                                                                        \
  X(shapes_gl,                                                                                     \
    "the executor GL starts from points and sets of vertices: use the executor Serial for curves " \
    "and simplices")                                                                               \
  X(shapes_float,                                                                                  \
    "labels start from curves and triangles in double precision, since their virtual sources are " \
    "far away: make the domain of double, or ask for windows (accurate)")                          \
  X(shapes_threads,                                                                                \
    "labels start from curves and triangles on the executor Serial: use that, or ask for windows " \
    "(accurate)")                                                                                  \
  X(shapes_visibility,                                                                             \
    "curves and triangles as sources need labels with limits: use the policy saddles")             \
  X(windows_domain,                                                                                \
    "accuracies other than fast are for surfaces and clouds: other domains have one, ask for "     \
    "fast")                                                                                        \
  X(windows_gl,                                                                                    \
    "the executor GL keeps one label a triangle: use the executor Serial, or the accuracy fast")   \
  X(windows_refraction, "windows are not refracted: use the accuracy fast")                        \
  X(windows_visibility,                                                                            \
    "windows know what they see: use the policy saddles, or the accuracy fast")                    \
  X(windows_labels,                                                                                \
    "the step of the dual queue and `vectorised` are of labels: leave them as they are, or use "   \
    "the accuracy fast")                                                                           \
  X(windows_float,                                                                                 \
    "exact distances need double precision: make the domain of double, or ask for accurate")

#define PLEXWAY_NAME(name, sentence) name,
/// The reasons of PLEXWAY_REFUSALS by name; `nothing` is none.
enum class Refusal { nothing, PLEXWAY_REFUSALS(PLEXWAY_NAME) };
#undef PLEXWAY_NAME

/// Yes, or the reason why not.
class Support {
 public:
  /// Yes, unless there is a reason.
  constexpr Support(Refusal refusal = Refusal::nothing) : refusal_(refusal) {}

  /// Does it go together?
  [[nodiscard]] constexpr explicit operator bool() const { return refusal_ == Refusal::nothing; }
  /// The reason by name.
  [[nodiscard]] constexpr Refusal refusal() const { return refusal_; }
  /// One sentence; empty for yes.
  [[nodiscard]] constexpr const char* sentence() const {
    switch (refusal_) {
      case Refusal::nothing:
        break;
#define PLEXWAY_CASE(name, sentence) \
  case Refusal::name:                \
    return sentence;
        PLEXWAY_REFUSALS(PLEXWAY_CASE)
#undef PLEXWAY_CASE
    }
    return "";
  }
  /// Throws UsageError with the sentence unless it is yes.
  void require() const;

 private:
  Refusal refusal_;
};

/// A cell of the table: what a field is to be solved on, by what, from what and how.
struct Combination {
  /// What runs the solve.
  ExecutorKind executor;
  /// What it runs on.
  DomainKind domain;
  int dimension;  ///< of its simplices
  /// Is the domain one of float?
  bool single_precision;
  /// Where the domain's lengths come from.
  MetricKind metric = MetricKind::intrinsic;
  /// What the field starts from.
  SourceKind source = SourceKind::vertex;
  /// As in PropagateOptions.
  Visibility visibility = Visibility::saddles;
  /// As in PropagateOptions.
  Schedule schedule = Schedule::dual_queue;
  /// By which rule.
  Accuracy::Kind accuracy = Accuracy::Kind::usual;
  /// Is an option given that only labels know: a step, or not vectorised?
  bool label_options = false;
};

/// Could windows solve it (Accuracy)? Else why not. A team takes them in pieces, or has one thread
/// do it where the order asked for is not theirs.
constexpr Support support_of_windows(const Combination& c) {
  if (c.domain != DomainKind::surface && c.domain != DomainKind::cloud)
    return Refusal::windows_domain;
  if (c.executor == ExecutorKind::gl) return Refusal::windows_gl;
  if (c.metric == MetricKind::refracting) return Refusal::windows_refraction;
  if (c.visibility != Visibility::saddles) return Refusal::windows_visibility;
  if (c.label_options) return Refusal::windows_labels;
  if (c.accuracy == Accuracy::Kind::exact && c.single_precision) return Refusal::windows_float;
  return Refusal::nothing;
}

/// What `usual` comes to in this cell; whatever else is asked for as it is.
[[nodiscard]] Accuracy resolved(Accuracy accuracy, const Combination& c);

/// Does it go together?
///
/// What does means the same everywhere. Visibility::saddles is the best rule that a domain has, on
/// wireframes and in SimplicialComplex the only one beside upper_bound. `radius` and an offset are
/// in the domain's unit, nothing beyond the radius is reached. `step` counts edges as they are
/// typical of the domain. A second source kind never makes a cell worse: a list of sources goes
/// together if each of them does.
constexpr Support support(const Combination& c) {
  using enum DomainKind;
  const bool gl = c.executor == ExecutorKind::gl, serial = c.executor == ExecutorKind::serial;
  const bool tuned = c.visibility == Visibility::tuned;
  const bool saddles = c.visibility == Visibility::saddles;
  const bool priority = c.schedule == Schedule::priority;
  const bool by_windows =
      c.accuracy == Accuracy::Kind::merged || c.accuracy == Accuracy::Kind::exact;
  const bool shape = c.source == SourceKind::curve || c.source == SourceKind::simplex;

  // What the types of executor and domain say.
  if (gl && (c.domain == simplices || c.domain == mixed)) return Refusal::gl_domain;
  if (gl && !c.single_precision) return Refusal::gl_double;
  // Rules.
  if (tuned && c.domain != surface && c.domain != cloud) return Refusal::table;
  if (c.domain == mixed && !saddles) return Refusal::mixed_visibility;
  if (c.metric == MetricKind::refracting && gl) return Refusal::gl_refraction;
  if (c.metric == MetricKind::refracting && !saddles) return Refusal::refraction_visibility;
  if (c.domain == solid && c.metric != MetricKind::embedded && gl) return Refusal::gl_lengths;
  if (gl && !saddles) return Refusal::gl_visibility;
  // Order.
  if (priority && !serial) return Refusal::order;
  if (priority && c.domain == mixed) return Refusal::mixed_order;
  // Accuracy.
  const Support windows = support_of_windows(c);
  if (by_windows && !windows) return windows;
  // Sources.
  if (c.domain == cloud && c.source == SourceKind::point) return Refusal::cloud_point;
  if (c.dimension > 3 && c.source == SourceKind::point) return Refusal::point_of_five;
  if (shape && c.domain != wireframe) {
    if (c.domain != surface) return Refusal::shapes;
    const bool by_labels = c.accuracy == Accuracy::Kind::fast || !windows;
    if (by_labels && gl) return Refusal::shapes_gl;
    if (by_labels && !saddles) return Refusal::shapes_visibility;
    if (by_labels && !serial) return Refusal::shapes_threads;
    if (by_labels && c.single_precision) return Refusal::shapes_float;
  }
  return Support();
}

/// The cell of an executor and a domain as types, for the kinds of sources and options that may be
/// given. (What only an object knows, such as a solid of lengths alone, counts as it is best.)
template <ExecutorType E, DomainType D>
[[nodiscard]] constexpr Combination combination(SourceKind source = SourceKind::vertex,
                                                Visibility visibility = Visibility::saddles,
                                                Schedule schedule = Schedule::dual_queue,
                                                MetricKind metric = D::kind == DomainKind::solid
                                                                        ? MetricKind::embedded
                                                                        : MetricKind::intrinsic,
                                                Accuracy::Kind accuracy = Accuracy::Kind::usual) {
  return {E::kind, D::kind, D::dimension, std::is_same_v<typename D::Number, float>,
          metric,  source,  visibility,   schedule,
          accuracy};
}

/// What is done on a domain besides solving. `X(name, what it is)`.
#define PLEXWAY_PURPOSES(X)                                                            \
  X(paths, "PathField::trace")                                                         \
  X(read_out, "PathField::at by other levels than ReadOut::linear")                    \
  X(directions, "PathField::gradient")                                                 \
  X(simplex_labels, "PathField::simplex_labels")                                       \
  X(searches, "BoundedSearch and PathSearch")                                          \
  X(samples, "farthest_points, poisson_disks, centroidal_voronoi and distance_matrix") \
  X(isolines, "isolines of a field (any/isolines.hpp)")                                \
  X(arcs, "isolines as arcs, and fine_field (any/isolines.hpp)")                       \
  X(isosurfaces, "isosurfaces of a field (any/isolines.hpp)")                          \
  X(pictures, "ShapeScene, and pages to turn")                                         \
  X(masks, "BuildOptions::mask")                                                       \
  X(metrics, "AnyShape::measure")                                                      \
  X(tensors, "AnyShape::measure by anything but speeds")                               \
  X(regions, "AnyShape::regions")                                                      \
  X(triangulations, "other triangles than the shape's, BuildOptions::triangulation")   \
  X(kept_builds, "AnyDomain::keep")                                                    \
  X(parts, "fields in parts, .pvtu")                                                   \
  X(volumes, "fields in a .vdb")                                                       \
  X(conversions, "'plexway convert'")                                                  \
  X(lines, "AnyShape::joined")                                                         \
  X(boundaries, "AnyShape::boundary")                                                  \
  X(margins, "TraceOptions::margin")                                                   \
  X(duals, "the dual triangulation of cells, 'plexway cvt --dual'")                    \
  X(error_classes, "errors by place and shape, 'plexway bench --anatomy'")             \
  X(rows, "all_pairs and near_pairs (any/pairs.hpp)")

#define PLEXWAY_NAME(name, what) name,
/// The purposes of PLEXWAY_PURPOSES by name.
enum class Purpose { PLEXWAY_PURPOSES(PLEXWAY_NAME) };
#undef PLEXWAY_NAME

/// Does a purpose go together with a domain, and with the solve that left what it asks? Schedule,
/// precision, sources and accuracy do not matter.
constexpr Support support(Purpose purpose, const Combination& c) {
  using enum DomainKind;
  const bool refracting = c.metric == MetricKind::refracting;
  const bool saddles = c.visibility == Visibility::saddles, gl = c.executor == ExecutorKind::gl;
  const bool by_lengths = c.domain == solid && c.metric != MetricKind::embedded;
  const bool labels = saddles && !gl;
  switch (purpose) {
    case Purpose::paths:
      if (c.domain == simplices) return Refusal::paths_simplices;
      break;
    case Purpose::read_out:
      if (c.domain == simplices) return Refusal::read_out_simplices;
      if (c.domain == cloud) return Refusal::read_out_cloud;
      if (c.domain == wireframe) break;                          // by the ends
      if (c.domain == mixed || refracting || by_lengths) break;  // by paths
      if (!labels) return Refusal::read_out_labels;
      break;
    case Purpose::directions:
      if (c.domain == wireframe || c.domain == cloud) return Refusal::directions_domain;
      if (c.domain == simplices || c.domain == mixed) break;  // of the linear field
      if (refracting) return Refusal::directions_refraction;
      if (by_lengths) return Refusal::directions_lengths;
      if (!labels) return Refusal::read_out_labels;
      break;
    case Purpose::simplex_labels:
      if (c.domain != surface && c.domain != solid) return Refusal::simplex_labels_domain;
      if (gl) return Refusal::simplex_labels_gl;
      break;
    case Purpose::searches:
      if (c.domain != surface) return Refusal::search_domain;
      if (refracting) return Refusal::search_refraction;
      if (!saddles) return Refusal::search_visibility;
      break;
    case Purpose::samples:
      if (c.domain != surface && c.domain != solid && c.domain != cloud)
        return Refusal::samples_domain;
      if (refracting) return Refusal::search_refraction;
      if (by_lengths) return Refusal::samples_lengths;
      break;
    case Purpose::isolines:
      if (c.domain != surface && c.domain != cloud && c.domain != mixed)
        return Refusal::isolines_domain;
      break;
    case Purpose::arcs:
      if (c.domain != surface) return Refusal::arcs_domain;
      break;
    case Purpose::isosurfaces:
      if (c.domain != solid) return Refusal::isosurfaces_domain;
      break;
    case Purpose::pictures:
      if (c.domain == simplices) return Refusal::pictures_domain;
      break;
    case Purpose::masks:
      if (c.domain == cloud || c.domain == mixed) return Refusal::masks_domain;
      break;
    case Purpose::metrics:
      if (c.domain == cloud || c.domain == simplices) return Refusal::metrics_domain;
      break;
    case Purpose::tensors:
      if (c.domain == mixed) return Refusal::metrics_speeds;
      return support(Purpose::metrics, c);
    case Purpose::regions:
      if (c.domain == cloud || c.domain == simplices) return Refusal::regions_domain;
      break;
    case Purpose::triangulations:
      if (c.domain != surface) return Refusal::triangulations_domain;
      break;
    case Purpose::kept_builds:
      if (c.domain == mixed || c.domain == simplices) return Refusal::kept_domain;
      break;
    case Purpose::parts:
      if (c.domain != surface && c.domain != solid && c.domain != cloud)
        return Refusal::parts_domain;
      break;
    case Purpose::volumes:
      if (c.domain != solid) return Refusal::volumes_domain;
      break;
    case Purpose::conversions:
      if (c.domain == mixed || c.domain == simplices) return Refusal::conversions_domain;
      break;
    case Purpose::lines:
      if (c.domain != surface && c.domain != wireframe) return Refusal::shapes;
      break;
    case Purpose::boundaries:
      if (c.domain != surface && c.domain != solid && c.domain != wireframe)
        return Refusal::boundaries_domain;
      break;
    case Purpose::margins:
      if (c.domain != surface && c.domain != cloud) return Refusal::margins_domain;
      if (refracting) return Refusal::margins_refraction;
      break;
    case Purpose::duals:
      if (c.domain != surface) return Refusal::duals_domain;
      break;
    case Purpose::error_classes:
      if (c.domain != surface && c.domain != solid) return Refusal::error_classes_domain;
      break;
    case Purpose::rows:
      if (gl) return Refusal::rows_gl;
      break;
  }
  return Support();
}
/// Where only the kind of the domain is known: counts as it is best.
constexpr Support support(Purpose purpose, DomainKind domain,
                          ExecutorKind executor = ExecutorKind::serial) {
  return support(purpose, {.executor = executor,
                           .domain = domain,
                           .dimension = 2,
                           .single_precision = true,
                           .metric = domain == DomainKind::solid ? MetricKind::embedded
                                                                 : MetricKind::intrinsic});
}
/// The same of a complex, with everything that it tells.
template <DomainType D>
[[nodiscard]] constexpr Support support(Purpose purpose, const D& domain,
                                        Visibility visibility = Visibility::saddles,
                                        ExecutorKind executor = ExecutorKind::serial) {
  return support(purpose, {.executor = executor,
                           .domain = D::kind,
                           .dimension = D::dimension,
                           .single_precision = std::is_same_v<typename D::Number, float>,
                           .metric = domain.metric(),
                           .visibility = visibility});
}

/// Can what is one kind as a file has it be taken as another (ReadOptions::as)? A level set, which
/// is a solid, as its surface, too.
constexpr bool taken_as(DomainKind held, DomainKind wanted, bool level_set = false) {
  using enum DomainKind;
  if (held == wanted) return true;
  if (held == surface) return wanted == solid || wanted == wireframe || wanted == cloud;
  return held == solid && (wanted == wireframe || (level_set && wanted == surface));
}

/// Is there anything that an executor solves on a domain?
template <class E, class D>
inline constexpr bool supports = static_cast<bool>(support(combination<E, D>()));

}  // namespace plexway
