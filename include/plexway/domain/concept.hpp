#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>

#include <plexway/common/ids.hpp>

namespace plexway {

/// The kinds of domains.
enum class DomainKind {
  surface,    ///< TriangleMesh
  solid,      ///< TetMesh
  wireframe,  ///< Wireframe
  simplices,  ///< SimplicialComplex, of any dimension
  cloud,      ///< PointCloud
  mixed,      ///< MixedComplex
};

/// Where a domain's lengths come from.
enum class MetricKind {
  embedded,    ///< coordinates in space, which rules may use
  intrinsic,   ///< the lengths of edges, and nothing else
  refracting,  ///< the same, but some edges are of another length on either side
};

/// A space that fields are solved on.
///
/// It has vertices and simplices, each with the caller's numbers from 0. A field has one distance a
/// vertex, a source is a vertex or a point of a simplex. Solvers, file formats and tools need no
/// more than this; how simplices hang together is between a domain and its rule.
template <class D>
concept DomainType = std::floating_point<typename D::Number> && requires(const D& domain) {
  { D::kind } -> std::convertible_to<DomainKind>;
  /// Of its simplices; of a mixed domain, the greatest that there may be.
  { D::dimension } -> std::convertible_to<int>;
  { domain.vertex_count() } -> std::same_as<std::size_t>;
  { domain.simplex_count() } -> std::same_as<std::size_t>;
  { domain.metric() } -> std::same_as<MetricKind>;
  { domain.bytes() } -> std::same_as<std::size_t>;
  domain.summary();  // what it is made of, counted while it was built
};

/// A domain of simplices of one dimension, renumbered inside for locality.
template <class D>
concept SimplexDomainType = DomainType<D> && requires(const D& domain, Index number) {
  /// One unit inside, in the caller's unit: about the mean edge.
  { domain.unit() } -> std::same_as<double>;
  { domain.inside_vertex(number) } -> std::same_as<Index>;
  { domain.vertices_inside() } -> std::same_as<std::span<const Index>>;  // of each, in order
  domain.summary().components;
};

/// What the library is compiled for.
template <class Real>
inline constexpr bool is_number_of_domains =
    std::is_same_v<Real, float> || std::is_same_v<Real, double>;

/// The number type of a domain: the precision that fields on it are solved in.
template <class D>
using RealOf = typename D::Number;

}  // namespace plexway
