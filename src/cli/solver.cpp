#include "solver.hpp"

#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include <plexway/solve.hpp>

#include "make_complex.hpp"

namespace plexway::cli {
namespace {

using cli::make_complex;

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
  else
    return summary.edges;
}

template <class Real, class Shape>
class ShapeSolver final : public Solver {
 public:
  ShapeSolver(const Shape& shape, [[maybe_unused]] Triangulation triangulation,
              const MeasuredLengths* lengths)
      : complex_(make_complex<Real>(shape, lengths)), simplices_(simplex_count(complex_)) {
    if constexpr (std::is_same_v<Shape, io::Triangles>)
      delaunay_ = retriangulate(triangulation, shape, lengths, complex_, triangulation_);
  }

  std::size_t components() const override { return complex_.summary().components; }
  std::size_t simplices() const override { return simplices_; }
  TriangulationReport triangulation() const override { return triangulation_; }
  const CloudSummary* cloud() const override {
    if constexpr (std::is_same_v<Shape, Cloud>) return &complex_.summary();
    return nullptr;
  }
  std::size_t refracting_edges() const override {
    if constexpr (std::is_same_v<Shape, io::Triangles>) return complex_.summary().refracting_edges;
    return 0;
  }

  void solve(const Executor& executor, std::span<const PointSource> sources,
             const PropagateOptions& options) override {
    std::span<const PointSource> there = sources;
    if (delaunay_) {
      moved_.clear();
      for (const PointSource& source : sources) moved_.push_back(delaunay_->to_intrinsic(source));
      there = moved_;
    }
    std::visit([&](const auto& chosen) { solve_on(chosen, there, options); }, executor);
  }

  void solve_from(const Executor& executor, std::span<const Source> sources,
                  const PropagateOptions& options) override {
    std::vector<Source> moved(sources.begin(), sources.end());
    if (delaunay_) {
      for (Source& source : moved) {
        if (auto* point = std::get_if<PointSource>(&source)) {
          *point = delaunay_->to_intrinsic(*point);
        } else if (auto* ball = std::get_if<BallSource>(&source)) {
          ball->centre = delaunay_->to_intrinsic(ball->centre);
        } else if (!std::holds_alternative<VertexSource>(source)) {
          throw UsageError(
              "--triangulation: lines and triangles lie in the triangles of the file; "
              "choose input");
        }
      }
    }
    const std::span<const Source> there = moved;
    std::visit([&](const auto& chosen) { solve_on(chosen, there, options); }, executor);
  }

  std::vector<double> distance() const override {
    return {field_.distance.begin(), field_.distance.end() - inserted()};
  }

  std::vector<std::int32_t> label() const override {
    std::vector<std::int32_t> labels;
    labels.reserve(field_.label.size());
    for (const Index label : field_.label)
      labels.push_back(label == none ? -1 : static_cast<std::int32_t>(label));
    if (!labels.empty()) labels.resize(labels.size() - static_cast<std::size_t>(inserted()));
    return labels;
  }

  const PropagateStatistics& statistics() const override { return field_.statistics; }
  bool complete() const override { return field_.complete; }

  std::size_t bytes() const override {
    std::size_t on_device = 0;
#ifdef PLEXWAY_HAS_GL
    on_device = gl_workspace_.bytes();
#endif
    return complex_.bytes() + (delaunay_ ? delaunay_->bytes() : 0) + workspace_.bytes() +
           on_device + field_.distance.capacity() * sizeof(Real) +
           field_.label.capacity() * sizeof(Index);
  }

 private:
  // Vertices at the end that are not the input's.
  [[nodiscard]] std::ptrdiff_t inserted() const {
    return static_cast<std::ptrdiff_t>(triangulation_.inserted_vertices);
  }

  using Complex = decltype(make_complex<Real>(std::declval<Shape>()));

  template <class OnThisMachine, class Sources>
  void solve_on(const OnThisMachine& executor, const Sources& sources,
                const PropagateOptions& options) {
    plexway::solve(executor, complex_, sources, options, workspace_, field_);
  }
  template <class Sources>
  void solve_on([[maybe_unused]] const GL& executor, [[maybe_unused]] const Sources& sources,
                [[maybe_unused]] const PropagateOptions& options) {
#ifdef PLEXWAY_HAS_GL
    if constexpr (supports<GL, Complex>) {
      plexway::solve(executor, complex_, sources, options, gl_workspace_, field_);
    } else {
      static_assert(support(combination<GL, Complex>()).refusal() == Refusal::gl_double);
      throw UsageError("--executor gl computes in single precision: use --precision float");
    }
#endif
  }

  Complex complex_;
  std::size_t simplices_;  // before any were added
  std::optional<IntrinsicDelaunay> delaunay_;
  TriangulationReport triangulation_;
  std::vector<PointSource> moved_;
  Workspace<Real> workspace_;
#ifdef PLEXWAY_HAS_GL
  GLWorkspace gl_workspace_;
#endif
  DistanceField<Real> field_;
};

template <class Shape>
std::unique_ptr<Solver> solver_of(const Shape& shape, Precision precision,
                                  Triangulation triangulation, const MeasuredLengths* lengths) {
  if (precision == Precision::single)
    return std::make_unique<ShapeSolver<float, Shape>>(shape, triangulation, lengths);
  return std::make_unique<ShapeSolver<double, Shape>>(shape, triangulation, lengths);
}

}  // namespace

std::unique_ptr<Solver> make_solver(const Domain& domain, Precision precision,
                                    Triangulation triangulation, const MeasuredLengths* lengths) {
  check_triangulation(triangulation, domain);
  return with_file_name(domain, [&] {
    return std::visit(
        [&](const auto& shape) { return solver_of(shape, precision, triangulation, lengths); },
        domain.shape());
  });
}

}  // namespace plexway::cli
