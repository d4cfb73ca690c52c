#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

/// @file
/// Domains of your own: derive from CarriedDomain, and every executor, source and option that
/// the carrier supports works with it. examples/hexagons.cpp is one.
namespace plexway {

/// A domain whose distances are found on another one, its carrier: it has its own vertices,
/// simplices and sources, and translates them.
template <class D>
concept CarriedDomainType = DomainType<D> && DomainType<typename D::Carrier> &&
    requires(const D& domain, const Source& source) {
  { domain.carrier() } -> std::same_as<const typename D::Carrier&>;
  { domain.carried(source) } -> std::same_as<Source>;
  { domain.carried_vertices() } -> std::same_as<std::span<const Index>>;
};

/// The base of such a domain: `class Mine : public CarriedDomain<Mine, Wireframe<float>>`. It
/// gives its base a carrier, and may have two public functions:
/// `PointSource place(const PointSource&) const`, where a point of its simplices is in the carrier,
/// and `Source whole(const SimplexSource&) const`, what all of a simplex of its own is there.
/// Without them its simplices are those of the carrier, by number.
template <class Derived, DomainType C>
class CarriedDomain {
 public:
  /// The carrier, which it is solved on.
  using Carrier = C;
  /// The precision of fields.
  using Number = typename C::Number;
  /// The rows of the table of support.hpp that it is in: the carrier's.
  static constexpr DomainKind kind = C::kind;
  /// Of the carrier's simplices.
  static constexpr int dimension = C::dimension;

  /// The carrier, which it is solved on.
  [[nodiscard]] const C& carrier() const { return carrier_; }
  /// The carrier's number of each vertex; empty if all are the carrier's own, by number.
  [[nodiscard]] std::span<const Index> carried_vertices() const { return vertices_; }
  /// Fields have one distance each.
  [[nodiscard]] std::size_t vertex_count() const {
    return vertices_.empty() ? carrier_.vertex_count() : vertices_.size();
  }
  /// The carrier's, unless the domain has its own.
  [[nodiscard]] std::size_t simplex_count() const { return carrier_.simplex_count(); }
  /// As the carrier's.
  [[nodiscard]] MetricKind metric() const { return carrier_.metric(); }
  /// The carrier's counts.
  [[nodiscard]] decltype(auto) summary() const { return carrier_.summary(); }
  /// Bytes held.
  [[nodiscard]] std::size_t bytes() const {
    return carrier_.bytes() + vertices_.capacity() * sizeof(Index);
  }
  /// A source of this domain as one of the carrier. Throws UsageError for a vertex that is not
  /// there.
  [[nodiscard]] Source carried(const Source& source) const {
    return std::visit([this](const auto& one) { return moved(one); }, source);
  }

 protected:
  /// `vertices`: as carried_vertices, each one of the carrier's (not checked).
  explicit CarriedDomain(C carrier, std::vector<Index> vertices = {})
      : carrier_(std::move(carrier)), vertices_(std::move(vertices)) {}
  /// Points of simplices have the carrier's numbers.
  [[nodiscard]] PointSource place(const PointSource& point) const { return point; }
  /// Likewise.
  [[nodiscard]] Source whole(const SimplexSource& simplex) const { return simplex; }

 private:
  [[nodiscard]] const Derived& self() const { return static_cast<const Derived&>(*this); }

  [[nodiscard]] Index moved(Index vertex) const {
    if (vertex >= self().vertex_count())
      throw UsageError("source vertex " + std::to_string(vertex) + " is out of range, there are " +
                       std::to_string(self().vertex_count()));
    return vertices_.empty() ? vertex : vertices_[vertex];
  }
  [[nodiscard]] PointSource at(const PointSource& point) const {
    if (names_nothing(point)) return point;
    PointSource there = point;
    if (point.vertex == none)
      there = self().place(point);
    else
      there.vertex = moved(point.vertex);
    there.offset = point.offset;
    return there;
  }
  [[nodiscard]] Source moved(const PointSource& point) const { return at(point); }
  [[nodiscard]] Source moved(VertexSource set) const {
    for (Index& v : set.vertices) v = moved(v);
    return set;
  }
  [[nodiscard]] Source moved(BallSource ball) const {
    ball.centre = at(ball.centre);
    return ball;
  }
  [[nodiscard]] Source moved(CurveSource curve) const {
    for (PointSource& point : curve.points) point = at(point);
    return curve;
  }
  [[nodiscard]] Source moved(const SimplexSource& simplex) const { return self().whole(simplex); }

  C carrier_;
  std::vector<Index> vertices_;
};

namespace detail {

template <class E, CarriedDomainType D>
requires(!OwnWorkspace<E>) struct WorkspaceFor<E, D> : WorkspaceFor<E, typename D::Carrier> {
};

// The carrier's sources.
template <CarriedDomainType D>
std::vector<Source> carried(const D& domain, const SourceList& sources) {
  std::vector<Source> there;
  there.reserve(sources.size());
  for (const PointSource& point : sources.points()) there.push_back(domain.carried(point));
  for (const Source& source : sources.sources()) there.push_back(domain.carried(source));
  return there;
}

// From the carrier's vertices to the domain's, where those are not the same.
template <class Number>
void take_vertices(std::span<const Index> vertices, std::vector<Number>& values) {
  if (vertices.empty() || values.empty()) return;
  std::vector<Number> taken(vertices.size());
  std::transform(vertices.begin(), vertices.end(), taken.begin(),
                 [&](Index v) { return values[v]; });
  values.swap(taken);
}

}  // namespace detail

/// ONE field, as `solve` has it on any domain, with the same errors. Cost: a solve on the carrier.
template <ExecutorType E, CarriedDomainType D>
requires ExecutorSolves<E, D>
void solve(const E& executor, const D& domain, const SourceList& sources,
           const PropagateOptions& options, WorkspaceOf<E, D>& workspace,
           DistanceField<RealOf<D>>& field) {
  const std::vector<Source> there = detail::carried(domain, sources);
  solve(executor, domain.carrier(), SourceList(there), options, workspace, field);
  const std::span<const Index> vertices = domain.carried_vertices();
  detail::take_vertices(vertices, field.distance);
  detail::take_vertices(vertices, field.label);
  detail::take_vertices(vertices, field.error);
}

/// K fields, one *to each* of K sources, as `solve_each` has them on any domain.
template <ExecutorType E, CarriedDomainType D>
requires ExecutorSolves<E, D>
bool solve_each(const E& executor, const D& domain, const SourceList& sources,
                const PropagateOptions& options, WorkspaceOf<E, D>& workspace,
                std::span<RealOf<D>> distance) {
  const std::vector<Source> there = detail::carried(domain, sources);
  const std::span<const Index> vertices = domain.carried_vertices();
  if (vertices.empty())
    return solve_each(executor, domain.carrier(), SourceList(there), options, workspace, distance);
  if (distance.size() != there.size() * vertices.size())
    throw UsageError("room for " + std::to_string(distance.size()) + " distances, but " +
                     std::to_string(there.size()) + " fields of " +
                     std::to_string(vertices.size()) + " vertices need " +
                     std::to_string(there.size() * vertices.size()));
  Fields<RealOf<D>> fields(there.size(), domain.carrier().vertex_count());
  const bool complete = solve_each(executor, domain.carrier(), SourceList(there), options,
                                   workspace, fields.values());
  for (std::size_t k = 0; k < there.size(); ++k)
    std::transform(vertices.begin(), vertices.end(),
                   distance.begin() + static_cast<std::ptrdiff_t>(k * vertices.size()),
                   [&](Index v) { return fields.row(k)[v]; });
  return complete;
}

}  // namespace plexway
