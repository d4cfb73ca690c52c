#include "solver.hpp"

#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/executors/serial.hpp>

namespace plexway::cli {
namespace {

template <class Real>
class SurfaceSolver final : public Solver {
 public:
  explicit SurfaceSolver(const io::Triangles& surface)
      : mesh_(surface.positions, surface.triangles) {}

  std::size_t components() const override { return mesh_.summary().components; }

  void solve(std::span<const PointSource> sources, const PropagateOptions& options) override {
    propagate(Serial{}, mesh_, sources, options, workspace_, field_);
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
    return mesh_.bytes() + workspace_.bytes() + field_.distance.capacity() * sizeof(Real) +
           field_.label.capacity() * sizeof(Index);
  }

 private:
  TriangleMesh<Real> mesh_;
  Workspace<Real> workspace_;
  DistanceField<Real> field_;
};

}  // namespace

std::unique_ptr<Solver> make_solver(const Domain& domain, Precision precision) {
  return with_file_name(domain, [&]() -> std::unique_ptr<Solver> {
    if (precision == Precision::single)
      return std::make_unique<SurfaceSolver<float>>(domain.surface());
    return std::make_unique<SurfaceSolver<double>>(domain.surface());
  });
}

}  // namespace plexway::cli
