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
  X(mixed_threads,                                                                                 \
    "mixed domains are not propagated on by several threads: use the executor Serial, or "         \
    "solve_each, which takes one thread a source")                                                 \
  X(mixed_visibility, "mixed domains know the default visibility only")                            \
  X(mixed_order, "mixed domains are not propagated nearest first: use the dual queue")             \
  X(table,                                                                                         \
    "the tuned policy is a table for triangles: use saddles, centroid or upper_bound on other "    \
    "domains")                                                                                     \
  X(refraction_visibility,                                                                         \
    "paths are refracted under Visibility::saddles only: use that, or build the surface with one " \
    "length an edge")                                                                              \
  X(search_refraction,                                                                             \
    "searches that end early, and samples, are not refracted: build the surface with one length "  \
    "an edge")                                                                                     \
  X(search_visibility, "searches that end early know the default visibility only: saddles")        \
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
  if (c.executor == ExecutorKind::openmp && c.domain == mixed) return Refusal::mixed_threads;
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

/// Do searches go no farther there than is asked (BoundedSearch, PathSearch, and the fields that
/// samples grow)? Else why not.
constexpr Support support_of_searches(MetricKind metric,
                                      Visibility visibility = Visibility::saddles) {
  if (metric == MetricKind::refracting) return Refusal::search_refraction;
  if (visibility != Visibility::saddles) return Refusal::search_visibility;
  return Refusal::nothing;
}

/// Is there anything that an executor solves on a domain?
template <class E, class D>
inline constexpr bool supports = static_cast<bool>(support(combination<E, D>()));

}  // namespace plexway
