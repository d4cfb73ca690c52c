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
  ShapeSolver(const Shape& shape, Triangulation triangulation, const MeasuredLengths* lengths)
      : complex_(build(shape, triangulation, lengths)),
        simplices_(simplices_of(shape)),
        shape_(shape),
        lengths_(lengths),
        left_open_(triangulation == Triangulation::automatic) {}

  std::size_t components() const override { return complex_.summary().components; }
  std::size_t simplices() const override { return simplices_; }
  TriangulationReport triangulation() const override {
    return on_input_ ? TriangulationReport() : triangulation_;
  }
  double mean_edge() const override {
    if constexpr (std::is_same_v<Shape, io::Triangles>) return complex_.unit();
    return 0;
  }
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
    on_input_ = false;
    if constexpr (std::is_same_v<Shape, io::Triangles>)
      if (delaunay_ && left_open_ && 50 * repairs(field_) > field_.distance.size()) {
        // Which triangles are better was only guessed.
        if (!input_) input_.emplace(make_complex<Real>(shape_, lengths_));
        DistanceField<Real> other;
        std::visit(
            [&](const auto& chosen) {
              if constexpr (!std::is_same_v<std::decay_t<decltype(chosen)>, GL>)
                plexway::solve(chosen, *input_, sources, options, workspace_, other);
            },
            executor);
        if (!other.distance.empty() && repairs(other) < repairs(field_)) {
          field_ = std::move(other);
          on_input_ = true;
        }
      }
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

  std::vector<double> error() const override {
    if (field_.error.empty()) return {};
    return {field_.error.begin(), field_.error.end() - inserted()};
  }
  Accuracy accuracy() const override { return field_.accuracy; }

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
    return on_input_ ? 0 : static_cast<std::ptrdiff_t>(triangulation_.inserted_vertices);
  }

  // Vertices whose distances had to be mended.
  static std::size_t repairs(const DistanceField<Real>& field) {
    return field.statistics.raised_vertices + field.statistics.lowered_vertices;
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

  // Sets what comes before the complex.
  [[nodiscard]] Complex build(const Shape& shape, [[maybe_unused]] Triangulation triangulation,
                              const MeasuredLengths* lengths) {
    if constexpr (std::is_same_v<Shape, io::Triangles>) {
      auto made = make_surface<Real>(triangulation, shape, lengths, triangulation_);
      delaunay_ = std::move(made.delaunay);
      return std::move(made.mesh);
    } else {
      return make_complex<Real>(shape, lengths);
    }
  }
  // Before any were added.
  [[nodiscard]] std::size_t simplices_of([[maybe_unused]] const Shape& shape) const {
    if constexpr (std::is_same_v<Shape, io::Triangles>)
      return shape.triangles.size();
    else
      return simplex_count(complex_);
  }

  std::optional<IntrinsicDelaunay> delaunay_;
  TriangulationReport triangulation_;
  Complex complex_;
  std::size_t simplices_;
  const Shape& shape_;
  const MeasuredLengths* lengths_;
  bool left_open_, on_input_ = false;
  std::optional<Complex> input_;  // where its triangles turned out to be better
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
