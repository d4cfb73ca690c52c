#pragma once

#include <concepts>
#include <span>

#include <plexway/domain/domains.hpp>
#include <plexway/executors.hpp>
#include <plexway/executors/fields.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/solve/workspace.hpp>
#include <plexway/source/source_list.hpp>
#include <plexway/support.hpp>

// One field or many? Take care which of the two you mean:
//
//   solve(executor, domain, sources)       ONE distance a vertex: to the *nearest* of the sources
//   solve_each(executor, domain, sources)  K distances a vertex: one *to each* of the K sources

/// The library: domains, sources, executors, fields, and what to do with them.
namespace plexway {

namespace detail {

// An executor may bring a workspace of its own.
template <class E>
concept OwnWorkspace = requires {
  typename E::Workspace;
};
template <class E, class D>
struct WorkspaceFor {
  using type = Workspace<RealOf<D>>;
};
template <OwnWorkspace E, class D>
struct WorkspaceFor<E, D> {
  using type = typename E::Workspace;
};

/// An error of the compiler, in one sentence, where the types alone say that it cannot be.
template <Refusal refusal>
constexpr bool check() {
#define PLEXWAY_ASSERT(name, sentence) static_assert(refusal != Refusal::name, sentence);
  PLEXWAY_REFUSALS(PLEXWAY_ASSERT)
#undef PLEXWAY_ASSERT
  return true;
}

}  // namespace detail

/// Does an executor solve a domain? Where types alone say that it does not, asking is an error of
/// the compiler, which says why; `supports` (support.hpp) answers instead.
template <class E, class D>
concept ExecutorSolves = detail::check<support(combination<E, D>()).refusal()>();

/// ONE field: the distance of every vertex from the *nearest* of `sources`, and which one that is,
/// by its place in the list.
///
/// Any executor, domain and sources that go together (support.hpp). What the types rule out does
/// not compile, what only values show throws UsageError, both with the same sentence. `workspace`
/// is reused from call to call and belongs to one domain and one thread at a time.
///
/// Sources are points, sets of vertices, balls, curves and simplices (source/source.hpp); each ball
/// takes a solve of its own, since inside and outside are not one field. In a wireframe curves and
/// edges are as near as their points.
///
/// Throws UsageError for no source, one that is not in the domain, options out of range or what
/// does not go together, and Cancelled when the progress callback says so. Cost: see the executors.
/// Source: Trettner, Bommes, Kobbelt: Geodesic Distance Computation via Virtual Source Propagation,
/// SGP 2021.
//
// Both verbs are compiled in the library: in src/executors the surface, solid, wireframe, cloud,
// simplicial and mixed.cpp, each of which says where its loop is.
template <ExecutorType E, DomainType D>
requires ExecutorSolves<E, D>
void solve(const E& executor, const D& domain, const SourceList& sources,
           const PropagateOptions& options, WorkspaceOf<E, D>& workspace,
           DistanceField<RealOf<D>>& field);

/// The same with a workspace of its own.
template <ExecutorType E, DomainType D>
[[nodiscard]] DistanceField<RealOf<D>> solve(const E& executor, const D& domain,
                                             const SourceList& sources,
                                             const PropagateOptions& options = {}) {
  WorkspaceOf<E, D> workspace;
  DistanceField<RealOf<D>> field;
  solve(executor, domain, sources, options, workspace, field);
  return field;
}

/// K fields: row k of `distance`, K times as many numbers as the domain has vertices, are the
/// distances of every vertex from source k *alone*. False if max_expansions ended one early.
///
/// By Serial one source after the other. By OpenMP one thread a source, as many at once as the
/// executor has, each doing what Serial does: the best use of many cores, with Serial's bits,
/// options and domains. By GL as many points in one launch as GL::batch_bytes holds, where
/// `max_expansions` counts a field on average; sources of other kinds one after the other.
///
/// Memory of OpenMP: a workspace and a field a thread (in float about 100 bytes a triangle, 160 a
/// tetrahedron, and 12 a vertex). Its progress is that of the source which the calling thread is
/// at; Cancelled ends all. Throws as `solve`, and UsageError for a `distance` of another size.
template <ExecutorType E, DomainType D>
requires ExecutorSolves<E, D>
bool solve_each(const E& executor, const D& domain, const SourceList& sources,
                const PropagateOptions& options, WorkspaceOf<E, D>& workspace,
                std::span<RealOf<D>> distance);

/// The same with a workspace and rows of its own.
template <ExecutorType E, DomainType D>
[[nodiscard]] Fields<RealOf<D>> solve_each(const E& executor, const D& domain,
                                           const SourceList& sources,
                                           const PropagateOptions& options = {}) {
  WorkspaceOf<E, D> workspace;
  Fields<RealOf<D>> fields(sources.size(), domain.vertex_count());
  fields.complete = solve_each(executor, domain, sources, options, workspace, fields.values());
  return fields;
}

/// Options whose order is known when a program is compiled: an error of the compiler for executors
/// without order, where PropagateOptions would give one at run time.
template <ExecutorType E, DomainType D, std::derived_from<NearestFirst> Options, class... Rest>
auto solve(const E& executor, const D& domain, const SourceList& sources, const Options& options,
           Rest&... rest) {
  detail::check<support(
                    combination<E, D>(SourceKind::vertex, Visibility::saddles, Schedule::priority))
                    .refusal()>();
  return solve(executor, domain, sources, static_cast<const PropagateOptions&>(options), rest...);
}

// What neither verb takes: an error of the compiler, in one sentence.

namespace detail {

template <class E, class D, class Sources>
constexpr void explain_call() {
  constexpr bool swapped = DomainType<E> && ExecutorType<D>;
  static_assert(!swapped,
                "solve takes the executor first, then the domain: solve(Serial{}, mesh, 0)");
  static_assert(swapped || DomainType<D>,
                "the second argument is no domain: TriangleMesh, TetMesh, Wireframe, PointCloud, "
                "SimplicialComplex, MixedComplex, or one of your own that derives from "
                "CarriedDomain; an AnyDomain has members of these names");
  static_assert(swapped || !DomainType<D> || std::convertible_to<const Sources&, SourceList>,
                "sources are vertices by number, PointSource, VertexSource and the like; of a "
                "position in space the source is closest(positions, triangles, point)");
}

template <class E, class D, class Sources>
concept WrongCall = (ExecutorType<E> &&
                     !(DomainType<D> && std::convertible_to<const Sources&, SourceList>)) ||
                    (DomainType<E> && ExecutorType<D>);

}  // namespace detail

/// Does not compile, and says why.
template <class E, class D, class Sources, class... Rest>
requires detail::WrongCall<E, D, Sources> DistanceField<float> solve(const E&, const D&,
                                                                     const Sources&,
                                                                     const Rest&...) {
  detail::explain_call<E, D, Sources>();
  return {};
}

/// Does not compile: options stand in braces, by name.
template <ExecutorType E, DomainType D, class Options>
requires(!std::convertible_to<const Options&, PropagateOptions>)
    DistanceField<RealOf<D>> solve(const E&, const D&, const SourceList&, const Options&) {
  static_assert(std::convertible_to<const Options&, PropagateOptions>,
                "options stand in braces, by name: solve(Serial{}, mesh, 0, {.accuracy = "
                "Accuracy::exact(), .radius = 2})");
  return {};
}

/// Does not compile: the executor is missing.
template <DomainType D, class Sources>
DistanceField<float> solve(const D&, const Sources&) {
  static_assert(!DomainType<D>, "the executor is missing: solve(Serial{}, domain, sources)");
  return {};
}

}  // namespace plexway
