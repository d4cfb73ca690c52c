#include "solver.hpp"

#include <type_traits>
#include <utility>
#include <variant>

#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/executors/serial.hpp>
#include <plexway/executors/serial_solid.hpp>
#include <plexway/executors/serial_wireframe.hpp>

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

template <class Real, class Shape>
class ShapeSolver final : public Solver {
 public:
  explicit ShapeSolver(const Shape& shape) : complex_(make_complex<Real>(shape)) {}

  std::size_t components() const override { return complex_.summary().components; }

  void solve(const Executor& executor, std::span<const PointSource> sources,
             const PropagateOptions& options) override {
    std::visit(
        [&](const auto& chosen) {
          propagate(chosen, complex_, sources, options, workspace_, field_);
        },
        executor);
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
    return complex_.bytes() + workspace_.bytes() + field_.distance.capacity() * sizeof(Real) +
           field_.label.capacity() * sizeof(Index);
  }

 private:
  decltype(make_complex<Real>(std::declval<Shape>())) complex_;
  Workspace<Real> workspace_;
  DistanceField<Real> field_;
};

}  // namespace

std::unique_ptr<Solver> make_solver(const Domain& domain, Precision precision) {
  return with_file_name(domain, [&] {
    return std::visit(
        [&](const auto& shape) -> std::unique_ptr<Solver> {
          using Shape = std::decay_t<decltype(shape)>;
          if (precision == Precision::single)
            return std::make_unique<ShapeSolver<float, Shape>>(shape);
          return std::make_unique<ShapeSolver<double, Shape>>(shape);
        },
        domain.shape());
  });
}

}  // namespace plexway::cli
