#pragma once

#include <span>
#include <type_traits>

#include <plexway/domain/concept.hpp>
#include <plexway/domain/support.hpp>
#include <plexway/executors.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/source_list.hpp>

/// @file
/// The table of supported combinations. The sentences that say why something is not, and what
/// domains themselves are checked for, are in domain/support.hpp; what files, builds and shapes
/// are, in shape/support.hpp.
// Everything that can be solved, and everything that is refused and why, is decided in these three
// and nowhere else.
namespace plexway {

/// The kinds of sources, as far as they matter here (source/source.hpp).
enum class SourceKind {
  vertex,   ///< a vertex, or a set of them; balls about one
  point,    ///< a point of a simplex; balls about one
  curve,    ///< a CurveSource of more than one point
  simplex,  ///< a SimplexSource
};

/// A cell of the table: what a field is to be solved on, by what, from what and how.
struct Combination {
  /// The executor.
  ExecutorKind executor;
  /// The domain.
  DomainKind domain;
  int dimension;  ///< of its simplices
  /// Is the domain one of float?
  bool single_precision;
  /// Where the domain's lengths come from.
  MetricKind metric = MetricKind::intrinsic;
  /// The source.
  SourceKind source = SourceKind::vertex;
  /// As in PropagateOptions.
  Visibility visibility = Visibility::saddles;
  /// As in PropagateOptions.
  Schedule schedule = Schedule::dual_queue;
  /// By which rule.
  Accuracy::Kind accuracy = Accuracy::Kind::usual;
  /// Is an option given that only labels know: a step, or not vectorised?
  bool label_options = false;
  /// Do its vertices have positions in space? Else purposes that draw or measure there have none.
  bool positions = true;
  /// Is it in parts over processes, of which none has the whole (SurfaceParts)?
  bool in_parts = false;
};

/// A cell with a solve's options.
[[nodiscard]] Combination with(Combination what, const PropagateOptions& options);

/// Could windows solve it (Accuracy)? Else why not. A team takes them in pieces, or has one thread
/// do it where the requested order is not theirs.
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

/// Could strings, which solids are solved by (docs/contributing/methods/strings.md)? Else why not.
/// Nearest first whatever the schedule.
constexpr Support support_of_strings(const Combination& c) {
  if (c.domain != DomainKind::solid) return Refusal::windows_domain;
  if (c.executor == ExecutorKind::gl) return Refusal::strings_gl;
  if (c.metric != MetricKind::embedded) return Refusal::strings_lengths;
  if (c.visibility != Visibility::saddles) return Refusal::strings_visibility;
  if (c.label_options) return Refusal::windows_labels;
  if (c.accuracy == Accuracy::Kind::exact) return Refusal::strings_exact;
  return Refusal::nothing;
}

/// Does a cell know another accuracy than `fast`? Else why not.
constexpr Support support_of_accuracy(const Combination& c) {
  return c.domain == DomainKind::solid ? support_of_strings(c) : support_of_windows(c);
}

/// What `usual` comes to in this cell; any other accuracy as it is.
[[nodiscard]] Accuracy resolved(Accuracy accuracy, const Combination& c);

/// Does it go together?
///
/// What is supported means the same everywhere. Visibility::saddles is the best rule that a domain
/// has, on wireframes and in SimplicialComplex the only one beside upper_bound. `radius` and an
/// offset are in the domain's unit, nothing beyond the radius is reached. `step` counts edges as
/// they are typical of the domain. A second source kind never makes a cell worse: a list of sources
/// goes together if each of them does.
constexpr Support support(const Combination& c) {
  using enum DomainKind;
  const bool gl = c.executor == ExecutorKind::gl, serial = c.executor == ExecutorKind::serial;
  const bool tuned = c.visibility == Visibility::tuned;
  const bool saddles = c.visibility == Visibility::saddles;
  const bool priority = c.schedule == Schedule::priority;
  const bool not_fast = c.accuracy == Accuracy::Kind::merged || c.accuracy == Accuracy::Kind::exact;
  const bool shape = c.source == SourceKind::curve || c.source == SourceKind::simplex;

  // In parts over processes.
  if (c.in_parts) {
    if (c.domain != surface) return Refusal::in_parts_domain;
    if (c.executor != ExecutorKind::openmp) return Refusal::ranks_executor;
    if (c.metric != MetricKind::intrinsic) return Refusal::in_parts_whole;
    if (shape) return Refusal::points_alone;
    const bool windows = c.accuracy != Accuracy::Kind::fast && support_of_windows(c);
    if (windows && c.schedule != Schedule::dual_queue) return Refusal::in_parts_order;
  }
  // What the types of executor and domain say.
  if (gl && (c.domain == simplices || c.domain == mixed)) return Refusal::gl_domain;
  if (gl && !c.single_precision) return Refusal::gl_double;
  // Rules.
  if (tuned && c.domain != surface && c.domain != cloud) return Refusal::table;
  if (c.domain == mixed && !saddles) return Refusal::mixed_visibility;
  if (c.metric == MetricKind::refracting && gl) return Refusal::gl_refraction;
  if (c.metric == MetricKind::refracting && !saddles) return Refusal::refraction_visibility;
  if (gl && !saddles) return Refusal::gl_visibility;
  // Order.
  if (priority && !serial) return Refusal::order;
  if (priority && c.domain == mixed) return Refusal::mixed_order;
  // Accuracy.
  if (const Support found = support_of_accuracy(c); not_fast && !found) return found;
  // Sources.
  if (c.domain == cloud && c.source == SourceKind::point) return Refusal::cloud_point;
  if (c.dimension > 3 && c.source == SourceKind::point) return Refusal::point_of_five;
  if (shape && c.domain != wireframe) {
    if (c.domain != surface) return Refusal::shapes;
    const bool by_labels = c.accuracy == Accuracy::Kind::fast || !support_of_windows(c);
    if (by_labels && gl) return Refusal::shapes_gl;
    if (by_labels && !saddles) return Refusal::shapes_visibility;
    if (by_labels && !serial) return Refusal::shapes_threads;
    if (by_labels && c.single_precision) return Refusal::shapes_float;
  }
  return Support();
}

/// The cell of an executor and a domain as types, for the kinds of sources and options that may be
/// given. (What only an object knows, such as a solid of intrinsic lengths, counts as it is best.)
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

/// What is done on a domain besides solving. `X(name, what it is, on which domains, why not on
/// others)`; what else it takes says `support`.
#define PLEXWAY_PURPOSES(X)                                                                      \
  X(paths, "PathField::trace", but(simplices), paths_simplices)                                  \
  X(read_out, "PathField::at by other levels than ReadOut::linear", but(simplices),              \
    read_out_simplices)                                                                          \
  X(directions, "PathField::gradient", but(wireframe, cloud), directions_domain)                 \
  X(simplex_labels, "PathField::simplex_labels", only(surface, solid), simplex_labels_domain)    \
  X(searches, "BoundedSearch and PathSearch", only(surface), search_domain)                      \
  X(samples, "farthest_points, poisson_disks, centroidal_voronoi and distance_matrix",           \
    only(surface, solid, cloud), samples_domain)                                                 \
  X(isolines, "isolines of a field (shape/isolines.hpp)", only(surface, cloud, mixed),           \
    isolines_domain)                                                                             \
  X(arcs, "isolines as arcs, and fine_field (shape/isolines.hpp)", only(surface), arcs_domain)   \
  X(isosurfaces, "isosurfaces of a field (shape/isolines.hpp)", only(solid), isosurfaces_domain) \
  X(pictures, "ShapeScene, and pages to turn", but(simplices), pictures_domain)                  \
  X(masks, "BuildOptions::mask", but(cloud, mixed), masks_domain)                                \
  X(metrics, "AnyShape::measure", but(cloud, simplices), metrics_domain)                         \
  X(tensors, "AnyShape::measure by tensors", but(mixed), metrics_speeds)                         \
  X(regions, "AnyShape::regions", but(cloud, simplices), regions_domain)                         \
  X(triangulations, "other triangles than the shape's, BuildOptions::triangulation",             \
    only(surface), triangulations_domain)                                                        \
  X(kept_builds, "AnyDomain::keep", but(mixed, simplices), kept_domain)                          \
  X(parts, "fields in parts, .pvtu", only(surface, solid, cloud), parts_domain)                  \
  X(volumes, "fields in a .vdb", only(solid), volumes_domain)                                    \
  X(conversions, "'plexway convert'", but(mixed, simplices), conversions_domain)                 \
  X(lines, "AnyShape::joined", only(surface, wireframe), shapes)                                 \
  X(boundaries, "AnyShape::boundary", only(surface, solid, wireframe), boundaries_domain)        \
  X(margins, "TraceOptions::margin", only(surface, cloud), margins_domain)                       \
  X(duals, "the dual triangulation of cells, 'plexway cvt --dual'", only(surface), duals_domain) \
  X(error_classes, "errors by place and shape, 'plexway bench --anatomy'", only(surface, solid), \
    error_classes_domain)                                                                        \
  X(rows, "all_pairs and near_pairs (shape/pairs.hpp)", but(), nothing)                          \
  X(ranks, "OpenMP::ranks", but(), nothing)                                                      \
  X(in_parts, "SurfaceParts, 'plexway-mpi distance --in-parts'", but(), nothing)                 \
  X(pieces, "MixedComplex::add", but(), nothing)                                                 \
  X(places, "AnyShape::closest and AnyShape::position", but(), nothing)                          \
  X(astar, "find_paths (shape/search.hpp), 'plexway path --astar'", but(), nothing)              \
  X(darts, "poisson_disks by DartOrder::simplices", but(cloud), darts_cloud)                     \
  X(given_lengths, "AnyShape::measure by metric::GivenLengths", but(mixed), metrics_speeds)

#define PLEXWAY_NAME(name, ...) name,
/// The purposes of PLEXWAY_PURPOSES by name.
enum class Purpose { PLEXWAY_PURPOSES(PLEXWAY_NAME) };
#undef PLEXWAY_NAME

/// A purpose as a row of a table.
#define PLEXWAY_ROW(name, what, domains, refusal) Row{domains, Refusal::refusal},
/// Is a purpose for a kind of domain? Else why not.
constexpr Support support_of_domain(Purpose purpose, DomainKind domain) {
  using enum DomainKind;
  struct Row {
    bool on_it;
    Refusal otherwise;
  };
  const auto only = [&](auto... kinds) { return ((domain == kinds) || ...); };
  const auto but = [&](auto... kinds) { return ((domain != kinds) && ...); };
  const Row rows[] = {PLEXWAY_PURPOSES(PLEXWAY_ROW)};
  const Row& row = rows[static_cast<int>(purpose)];
  return row.on_it ? Refusal::nothing : row.otherwise;
}
#undef PLEXWAY_ROW

/// Is what a purpose gives in space?
constexpr bool draws(Purpose purpose) {
  using enum Purpose;
  return purpose == directions || purpose == isolines || purpose == arcs ||
         purpose == isosurfaces || purpose == pictures || purpose == parts || purpose == volumes;
}

/// Does a purpose draw or measure in space?
constexpr bool needs_positions(Purpose purpose) {
  return draws(purpose) || purpose == Purpose::lines || purpose == Purpose::places;
}

/// Does a purpose need no more of a domain than each of several processes has of its part?
constexpr bool goes_in_parts(Purpose purpose) {
  using enum Purpose;
  return purpose == in_parts || purpose == ranks || purpose == parts;
}

/// Does a purpose go together with a domain, and with the solve that left what it asks? Precision
/// and kinds of sources do not matter (those: support_of_sources); schedule, step and accuracy do
/// for searches alone.
constexpr Support support(Purpose purpose, const Combination& c) {
  using enum DomainKind;
  const bool refracting = c.metric == MetricKind::refracting;
  const bool saddles = c.visibility == Visibility::saddles, gl = c.executor == ExecutorKind::gl;
  const bool by_lengths = c.domain == solid && c.metric != MetricKind::embedded;
  const bool labels = saddles && !gl;
  const bool windows = c.accuracy == Accuracy::Kind::merged || c.accuracy == Accuracy::Kind::exact;
  if (c.in_parts && !goes_in_parts(purpose)) return Refusal::in_parts_whole;
  if (const Support found = support_of_domain(purpose, c.domain); !found) return found;
  switch (purpose) {
    case Purpose::read_out:
      if (c.domain == cloud) return Refusal::read_out_cloud;
      if (c.domain == wireframe) break;                                 // by the ends
      if (c.domain == mixed || refracting || c.domain == solid) break;  // by paths
      if (!labels) return Refusal::read_out_labels;
      break;
    case Purpose::directions:
      if (c.domain == simplices || c.domain == mixed) break;  // of the linear field
      if (refracting) return Refusal::directions_refraction;
      if (by_lengths) return Refusal::directions_lengths;
      if (c.domain == solid) break;  // by paths
      if (!labels) return Refusal::read_out_labels;
      break;
    case Purpose::simplex_labels:
      if (gl && (c.domain == surface || by_lengths)) return Refusal::simplex_labels_gl;
      break;
    case Purpose::searches:
      if (refracting) return Refusal::search_refraction;
      if (!saddles) return Refusal::search_visibility;
      if (windows) return Refusal::search_accuracy;
      break;
    case Purpose::astar:
      if (c.executor != ExecutorKind::serial || c.schedule != Schedule::dual_queue ||
          c.label_options)
        return Refusal::search_order;
      return support(Purpose::searches, c);
    case Purpose::samples:
      if (refracting) return Refusal::search_refraction;
      if (by_lengths) return Refusal::samples_lengths;
      break;
    case Purpose::darts:
      return support(Purpose::samples, c);
    case Purpose::tensors:
      if (!c.positions && c.domain == wireframe) return Refusal::metrics_lengths;
      return support(Purpose::metrics, c);
    case Purpose::given_lengths:
      return support(Purpose::metrics, c);
    case Purpose::metrics:
      if (!c.positions && c.domain != wireframe) return Refusal::metrics_lengths;
      break;
    case Purpose::margins:
      if (refracting) return Refusal::margins_refraction;
      break;
    case Purpose::rows:
      if (gl) return Refusal::rows_gl;
      break;
    case Purpose::ranks:
      if (c.executor != ExecutorKind::openmp) return Refusal::ranks_executor;
      break;
    case Purpose::in_parts: {
      Combination parted = c;
      parted.in_parts = true;
      if (const Support found = support(parted); !found) return found;
      break;
    }
    case Purpose::pieces:
      return support_of_piece(c.domain, c.metric);
    default:
      break;
  }
  if (c.positions || !needs_positions(purpose)) return Refusal::nothing;
  return draws(purpose) ? Refusal::drawn_lengths : Refusal::positions;
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
/// The cell of a complex, with all its properties, by default options.
template <DomainType D>
[[nodiscard]] constexpr Combination combination_of(const D& domain, ExecutorKind executor) {
  return {.executor = executor,
          .domain = D::kind,
          .dimension = D::dimension,
          .single_precision = std::is_same_v<typename D::Number, float>,
          .metric = domain.metric()};
}
/// Does a purpose go together with a complex?
template <DomainType D>
[[nodiscard]] constexpr Support support(Purpose purpose, const D& domain,
                                        Visibility visibility = Visibility::saddles,
                                        ExecutorKind executor = ExecutorKind::serial,
                                        bool positions = true) {
  Combination what = combination_of(domain, executor);
  what.visibility = visibility;
  what.positions = positions;
  return support(purpose, what);
}
/// And with the options of a solve?
template <DomainType D>
[[nodiscard]] Support support(Purpose purpose, const D& domain, const PropagateOptions& options,
                              ExecutorKind executor = ExecutorKind::serial) {
  return support(purpose, with(combination_of(domain, executor), options));
}

/// What a purpose starts from: points alone, or vertex sets, balls, curves or simplices among them.
/// (In C++ the types decide; programs that take any source call it.)
constexpr Support support_of_sources(Purpose purpose, bool only_points) {
  const bool by_points = purpose == Purpose::paths || purpose == Purpose::read_out ||
                         purpose == Purpose::directions || purpose == Purpose::searches ||
                         purpose == Purpose::astar || purpose == Purpose::samples ||
                         purpose == Purpose::darts || purpose == Purpose::in_parts;
  return by_points && !only_points ? Refusal::points_alone : Refusal::nothing;
}

/// The points of a list, for a purpose that starts from points alone; UsageError for others in it.
inline std::span<const PointSource> points_of(Purpose purpose, const SourceList& sources) {
  support_of_sources(purpose, sources.only_points()).require();
  return sources.points();
}

/// Is there anything that an executor solves on a domain?
template <class E, class D>
inline constexpr bool supports = static_cast<bool>(support(combination<E, D>()));

}  // namespace plexway
