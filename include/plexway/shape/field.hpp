#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <variant>
#include <vector>

#include <plexway/solve/distance_field.hpp>

namespace plexway {

/// Whether numbers are float or double.
enum class Precision {
  float32,  ///< float
  float64,  ///< double
  ///@{
  /// The names of before.
  single [[deprecated("use float32")]] = float32,
  twice [[deprecated("use float64")]] = float64,
  ///@}
};

/// Which triangles a surface is solved on.
enum class Triangulation {
  input,
  delaunay,   ///< the intrinsic Delaunay triangulation of its vertices
  refined,    ///< that, with more vertices
  automatic,  ///< what pays (what_pays)
};

/// Which ones they became.
struct TriangulationReport {
  Triangulation done = Triangulation::input;  ///< never automatic
  /// The number of edges that were flipped.
  std::size_t flips = 0;
  /// New vertices, by refinement.
  std::size_t inserted_vertices = 0;
  double seconds = 0;  ///< for building on other triangles, where that was done
};

/// Distances at the vertices of an AnyDomain, in the caller's order and unit: +inf where no path
/// leads, never NaN.
class AnyField {
 public:
  /// A field in either precision.
  using Data = std::variant<DistanceField<float>, DistanceField<double>>;

  /// The field.
  Data data;
  TriangulationReport triangulation;  ///< which triangles it was solved on in the end

  /// One distance a vertex: so many.
  [[nodiscard]] std::size_t size() const {
    return std::visit([](const auto& f) { return f.distance.size(); }, data);
  }
  /// The distance of a vertex, which must be one (not checked).
  [[nodiscard]] double operator[](std::size_t vertex) const {
    return std::visit([&](const auto& f) { return static_cast<double>(f.distance[vertex]); }, data);
  }
  /// As doubles, a copy.
  [[nodiscard]] std::vector<double> doubles() const {
    return std::visit(
        [](const auto& f) { return std::vector<double>(f.distance.begin(), f.distance.end()); },
        data);
  }
  /// As they are, of float or double, no copy; empty where the domain has the other precision.
  template <class Real>
  [[nodiscard]] std::span<const Real> view() const {
    const auto* of = std::get_if<DistanceField<Real>>(&data);
    return of == nullptr ? std::span<const Real>() : std::span<const Real>(of->distance);
  }
  /// Nearest source of each vertex, by its place in the list; `none` where unreached. Empty for a
  /// single source.
  [[nodiscard]] std::span<const Index> label() const {
    return std::visit([](const auto& f) { return std::span<const Index>(f.label); }, data);
  }
  /// The same with -1 where unreached, as files have it.
  [[nodiscard]] std::vector<std::int32_t> file_label() const {
    std::vector<std::int32_t> labels;
    labels.reserve(label().size());
    for (const Index l : label()) labels.push_back(l == none ? -1 : static_cast<std::int32_t>(l));
    return labels;
  }
  /// The same also of a single source, whose place is 0.
  [[nodiscard]] std::vector<std::int32_t> nearest() const {
    std::vector<std::int32_t> labels = file_label();
    if (labels.empty())
      for (const double d : doubles())
        labels.push_back(d < std::numeric_limits<double>::infinity() ? 0 : -1);
    return labels;
  }
  /// Bytes held.
  [[nodiscard]] std::size_t bytes() const {
    return std::visit(
        [](const auto& f) {
          return f.distance.capacity() * sizeof(f.distance[0]) +
                 f.label.capacity() * sizeof(Index) + f.error.capacity() * sizeof(f.error[0]);
        },
        data);
  }
  /// False if max_expansions ended the solve early.
  [[nodiscard]] bool complete() const {
    return std::visit([](const auto& f) { return f.complete; }, data);
  }
  /// How far off each distance may be, an estimate (DistanceField::error); empty for
  /// Accuracy::fast().
  [[nodiscard]] std::vector<double> error() const {
    return std::visit(
        [](const auto& f) { return std::vector<double>(f.error.begin(), f.error.end()); }, data);
  }
  /// By which it was solved.
  [[nodiscard]] Accuracy accuracy() const {
    return std::visit([](const auto& f) { return f.accuracy; }, data);
  }
  /// The work that it took.
  [[nodiscard]] const PropagateStatistics& statistics() const {
    return std::visit([](const auto& f) -> const PropagateStatistics& { return f.statistics; },
                      data);
  }
};

}  // namespace plexway
