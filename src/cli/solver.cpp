#include "solver.hpp"

#include <type_traits>
#include <utility>
#include <variant>

#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/executors/serial.hpp>
#include <plexway/executors/serial_cloud.hpp>
#include <plexway/executors/serial_pairs.hpp>
#include <plexway/executors/serial_solid.hpp>
#include <plexway/executors/serial_wireframe.hpp>
#include <plexway/executors/source_sets.hpp>

namespace plexway::cli {
namespace {

// Each is built in place: complexes are not to be copied.
template <class Real>
TriangleMesh<Real> make_complex(const io::Triangles& surface) {
  return {surface.positions, surface.triangles};
}
template <class Real>
TetMesh<Real> make_complex(const io::Tets& solid) {
  return {solid.positions, solid.tets};
}
template <class Real>
Wireframe<Real> make_complex(const io::Edges& wireframe) {
  if (wireframe.lengths.empty()) return {wireframe.positions, wireframe.edges};
  return {wireframe.vertices, wireframe.edges, wireframe.lengths};
}
template <class Real>
PointCloud<Real> make_complex(const Cloud& cloud) {
  return {cloud.measured(), cloud.neighbours, cloud_options(cloud)};
}
// A cloud in its other form.
struct PairsOf {
  const Cloud& cloud;
};
template <class Real>
PointPairs<Real> make_complex(const PairsOf& pairs) {
  return {pairs.cloud.measured(), pairs.cloud.neighbours, pair_options(pairs.cloud)};
}

// How many simplices a complex has, by the name that its summary gives them.
template <class Complex>
std::size_t simplex_count(const Complex& complex) {
  const auto& summary = complex.summary();
  if constexpr (requires {
                  summary.faces;
                  summary.boundary_edges;
                })
    return summary.faces;
  else if constexpr (requires { summary.tets; })
    return summary.tets;
  else if constexpr (requires { summary.triangles; })
    return summary.triangles;
  else if constexpr (requires { summary.neighbour_pairs; })
    return summary.neighbour_pairs;
  else
    return summary.edges;
}

template <class Real, class Shape>
class ShapeSolver final : public Solver {
 public:
  explicit ShapeSolver(const Shape& shape) : complex_(make_complex<Real>(shape)) {}

  std::size_t components() const override { return complex_.summary().components; }
  std::size_t simplices() const override { return simplex_count(complex_); }

  void solve(const Executor& executor, std::span<const PointSource> sources,
             const PropagateOptions& options) override {
    std::visit([&](const auto& chosen) { solve_on(chosen, sources, options); }, executor);
  }

  void solve_from(const Executor& executor, std::span<const Source> sources,
                  const PropagateOptions& options) override {
    std::visit([&](const auto& chosen) { solve_on(chosen, sources, options); }, executor);
  }

  std::vector<double> distance() const override {
    return {field_.distance.begin(), field_.distance.end()};
  }

  std::vector<std::int32_t> label() const override {
    std::vector<std::int32_t> labels;
    labels.reserve(field_.label.size());
    for (const Index label : field_.label)
      labels.push_back(label == none ? -1 : static_cast<std::int32_t>(label));
    return labels;
  }

  const PropagateStatistics& statistics() const override { return field_.statistics; }
  bool complete() const override { return field_.complete; }

  std::size_t bytes() const override {
    std::size_t on_device = 0;
#ifdef PLEXWAY_HAS_GL
    on_device = gl_workspace_.bytes();
#endif
    return complex_.bytes() + workspace_.bytes() + on_device +
           field_.distance.capacity() * sizeof(Real) + field_.label.capacity() * sizeof(Index);
  }

 private:
  template <class OnThisMachine, class Sources>
  void solve_on(const OnThisMachine& executor, const Sources& sources,
                const PropagateOptions& options) {
    if constexpr (kSerialOnly && !std::is_same_v<OnThisMachine, Serial>)
      throw UsageError("--form pairs is for --executor serial");
    else
      propagate(executor, complex_, sources, options, workspace_, field_);
  }
  template <class Sources>
  void solve_on([[maybe_unused]] const GL& executor, [[maybe_unused]] const Sources& sources,
                [[maybe_unused]] const PropagateOptions& options) {
#ifdef PLEXWAY_HAS_GL
    if constexpr (!std::is_same_v<Real, float>)
      throw UsageError("--executor gl computes in single precision: use --precision float");
    else if constexpr (kSerialOnly)
      throw UsageError("--form pairs is for --executor serial");
    else
      propagate(executor, complex_, sources, options, gl_workspace_, field_);
#endif
  }

  using Complex = decltype(make_complex<Real>(std::declval<Shape>()));
  static constexpr bool kSerialOnly = std::is_same_v<Complex, PointPairs<Real>>;

  Complex complex_;
  Workspace<Real> workspace_;
#ifdef PLEXWAY_HAS_GL
  GLWorkspace gl_workspace_;
#endif
  DistanceField<Real> field_;
};

template <class Shape>
std::unique_ptr<Solver> solver_of(const Shape& shape, Precision precision) {
  if (precision == Precision::single) return std::make_unique<ShapeSolver<float, Shape>>(shape);
  return std::make_unique<ShapeSolver<double, Shape>>(shape);
}

}  // namespace

std::unique_ptr<Solver> make_solver(const Domain& domain, Precision precision) {
  return with_file_name(domain, [&] {
    if (domain.cloud() != nullptr && domain.cloud()->form == CloudForm::pairs)
      return solver_of(PairsOf{*domain.cloud()}, precision);
    return std::visit([&](const auto& shape) { return solver_of(shape, precision); },
                      domain.shape());
  });
}

}  // namespace plexway::cli
