#include "shape/prepared.hpp"

#include <algorithm>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/paths/mixed_path_field.hpp>
#include <plexway/shape/support.hpp>

#include "complexes/common/disjoint_sets.hpp"
#include "complexes/common/kept_archive.hpp"
#include "executors/checks.hpp"
#include "shape/arguments/arguments.hpp"
#include "shape/files/kept_build.hpp"
#include "shape/make_complex.hpp"
#include "shape/prepared_kind.hpp"
#include "shape/shape_state.hpp"
#include "shape/words.hpp"

namespace plexway::detail {
namespace {

// Rows of four vertices may be meant as quads.
void check_flat(const SolidSummary& solid) {
  if (solid.degenerate_tets == solid.tets)
    throw InputError((solid.tets == 1 ? "the only tetrahedron is flat"
                                      : "all " + counted(solid.tets, "tetrahedra") + " are flat") +
                     "; quads of a surface are two triangles each, (0, 1, 2) and (0, 2, 3)");
}

/// Solids, wireframes, clouds and simplices: solved as they are.
template <class Complex>
class PreparedPlain final : public PreparedKind<Complex> {
 public:
  template <class Make>
  PreparedPlain(const AnyShape& shape, bool measured, const Make& make)
      : PreparedKind<Complex>(shape, measured), complex_(make()) {
    if constexpr (Complex::kind == DomainKind::solid) check_flat(complex_.summary());
  }

  /// Is it one of that shape?
  [[nodiscard]] bool fits(const AnyShape& shape) const {
    return complex_.vertex_count() == shape.vertices() &&
           (shape.kind() == DomainKind::cloud || complex_.simplex_count() == shape.simplices());
  }

 private:
  const Complex& of() const override { return complex_; }

  Complex complex_;
};

/// Surfaces, which may be solved on other triangles than theirs.
template <class Real>
class PreparedSurface final : public PreparedKind<TriangleMesh<Real>> {
  using Base = PreparedKind<TriangleMesh<Real>>;

 public:
  PreparedSurface(const AnyShape& shape, const BuildOptions& options)
      : Base(shape, options.lengths != nullptr || shape.lengths() != nullptr),
        lengths_(options.lengths),
        mask_(options.mask),
        threads_(options.threads),
        left_open_(options.triangulation == Triangulation::automatic),
        made_(make_surface<Real>(options.triangulation, making(), report_)) {}
  PreparedSurface(const AnyShape& shape, Triangulation asked, KeptIn& in)
      : Base(shape, shape.lengths() != nullptr),
        left_open_(asked == Triangulation::automatic),
        made_(open(in, report_)) {
    const std::size_t own = made_.mesh.vertex_count() - report_.inserted_vertices;
    in.require(own == shape.vertices());
    in.require(made_.delaunay || made_.mesh.face_count() == shape.simplices());
  }

  void keep(KeptOut& out) const override {
    const auto done = static_cast<std::uint32_t>(made_.done);
    out(done, report_.flips, report_.inserted_vertices, made_.delaunay.has_value());
    KeptParts::keep(out, made_.mesh);
    if (made_.delaunay) KeptParts::keep(out, *made_.delaunay);
  }

  std::size_t simplices() const override { return this->shape_.simplices(); }
  double mean_edge() const override { return made_.mesh.unit(); }
  std::size_t refracting_edges() const override { return made_.mesh.summary().refracting_edges; }
  const TriangulationReport& triangulation() const override { return report_; }
  std::size_t bytes() const override {
    return Base::bytes() + (made_.delaunay ? made_.delaunay->bytes() : 0) +
           (input_ ? input_->bytes() : 0);
  }
  AnyComplex complex() const override { return &input(); }
  RowComplex row_complex(std::vector<PointSource> points) const override {
    if (made_.delaunay)
      for (PointSource& point : points) point = moved(point);
    return {&made_.mesh, std::move(points)};
  }

  std::shared_ptr<const AnyPathField::State> path_field(
      const AnyExecutor& executor, std::span<const PointSource> sources,
      const PropagateOptions& options) const override {
    using Paths = PathsOf<TriangleMesh<Real>>;
    const auto solved = [&](const std::shared_ptr<Paths>& state) {
      state->solve(executor, sources, options);
      cut(as<DistanceField<Real>>(state->field.data), this->shape_.vertices());
      state->field.triangulation = report_;
      return state;
    };
    const auto keep = this->shared_from_this();
    if (!elsewhere())
      return solved(std::make_shared<Paths>(keep, this->shape_, this->measured_, made_.mesh));
    return solved(std::make_shared<Paths>(keep, this->shape_, this->measured_, made_.mesh,
                                          *made_.delaunay, input()));
  }

 private:
  [[nodiscard]] Making making() const {
    return {this->shape_, lengths_ ? lengths_.get() : this->shape_.lengths(), mask_.get(),
            threads_};
  }
  static TriangulatedSurface<Real> open(KeptIn& in, TriangulationReport& report) {
    std::uint32_t done = 0;
    bool delaunay = false;
    in(done, report.flips, report.inserted_vertices, delaunay);
    in.require(done <= static_cast<std::uint32_t>(Retriangulation::refined));
    TriangulatedSurface<Real> made{KeptParts::open<TriangleMesh<Real>>(in), std::nullopt,
                                   static_cast<Retriangulation>(done)};
    in.require(delaunay == (made.done != Retriangulation::keep) &&
               report.inserted_vertices < made.mesh.vertex_count());
    report.done = named(made.done);
    if (delaunay) {
      made.delaunay.emplace(
          KeptParts::open_delaunay(in, made.mesh.face_count(), made.mesh.vertex_count()));
      in.require(made.delaunay->summary().flips == report.flips &&
                 made.delaunay->summary().inserted_vertices == report.inserted_vertices);
    } else {
      in.require(report.flips + report.inserted_vertices == 0);
    }
    return made;
  }
  const TriangleMesh<Real>& of() const override { return made_.mesh; }

  Placed place(const SourceList& sources, SolveRoom& room, AnyField& field) const override {
    field.triangulation = report_;
    if (!made_.delaunay) return {&made_.mesh, sources, field};
    if (!sources.only_points() && have_shapes(this->shape_, sources.sources())) {
      support(left_open_ ? Triangulation::automatic : Triangulation::delaunay, SourceKind::curve)
          .require();
      field.triangulation = {};
      return {&input(), sources, field};
    }
    return {&made_.mesh, moved(sources, room), field};
  }
  void take_back(SolveRoom&, AnyField& field) const override {
    if (made_.delaunay) cut(as<DistanceField<Real>>(field.data), this->shape_.vertices());
  }

  // Are there other triangles than the shape's?
  [[nodiscard]] bool elsewhere() const { return report_.flips + report_.inserted_vertices > 0; }

  // On the shape's own triangles.
  [[nodiscard]] const TriangleMesh<Real>& input() const {
    if (!elsewhere()) return made_.mesh;
    std::call_once(input_once_, [&] {
      input_.emplace(make_complex<Real>(std::get<io::Triangles>(this->shape_.data()), making()));
    });
    return *input_;
  }

  // Where a point of the input is in the other triangles, which would take what lies outside of its
  // triangle to the nearest place.
  PointSource moved(const PointSource& point) const {
    check_source(point, {this->shape_.vertices(), this->shape_.simplices(), "face", 3});
    return made_.delaunay->to_intrinsic(point);
  }

  SourceList moved(const SourceList& sources, SolveRoom& room) const {
    const auto same = [](Index) {};
    return room.moved(
        sources, [&](PointSource& point) { point = moved(point); }, same, same);
  }

  std::shared_ptr<const MeasuredLengths> lengths_;  // null: the shape's
  std::shared_ptr<const Mask> mask_;
  int threads_ = 0;
  bool left_open_;
  TriangulationReport report_;
  TriangulatedSurface<Real> made_;
  mutable std::once_flag input_once_;
  mutable std::optional<TriangleMesh<Real>> input_;
};

/// Mixed domains, and solids with a region to each speed: their pieces have vertices and simplices
/// of their own.
template <class Real>
class PreparedMixed final : public PreparedKind<MixedComplex<Real>> {
  using Base = PreparedKind<MixedComplex<Real>>;

 public:
  /// `speeds` are one a simplex of `mixed`, or none: 1 for all.
  PreparedMixed(const AnyShape& shape, const MixedShape& mixed, std::span<const double> speeds,
                const Mask* mask)
      : Base(shape, !speeds.empty()), pieces_(mixed, speeds) {
    count_components(mask);
  }

  std::size_t components() const override { return components_; }
  RowComplex row_complex(std::vector<PointSource> points) const override {
    return {std::monostate(), std::move(points)};
  }
  std::size_t bytes() const override {
    return Base::bytes() + (pieces_.vertex.capacity() + pieces_.simplex.capacity()) * sizeof(Index);
  }

  std::shared_ptr<const AnyPathField::State> path_field(
      const AnyExecutor& executor, std::span<const PointSource> sources,
      const PropagateOptions& options) const override {
    return std::make_shared<Paths>(
        std::static_pointer_cast<const PreparedMixed>(this->shared_from_this()), executor, sources,
        options);
  }

 private:
  class Paths final : public LinearField {
   public:
    Paths(const std::shared_ptr<const PreparedMixed>& of, const AnyExecutor& executor,
          std::span<const PointSource> sources, const PropagateOptions& options)
        : LinearField(of, of->shape_, executor, sources, options),
          of_(*of),
          paths_(of_.pieces_.complex),
          outer_(of_.pieces_.complex.simplex_count()) {
      const MixedPieces<Real>& pieces = of_.pieces_;
      DistanceField<Real> found;
      found.distance.assign(pieces.complex.vertex_count(), std::numeric_limits<Real>::infinity());
      const auto& distance = std::get<DistanceField<Real>>(field.data).distance;
      for (std::size_t v = 0; v < distance.size(); ++v)
        if (pieces.vertex[v] != none) found.distance[pieces.vertex[v]] = distance[v];
      std::vector<PointSource> inside(sources.begin(), sources.end());
      for (PointSource& source : inside) of_.move(source);
      for (Index s = 0; s < pieces.simplex.size(); ++s) outer_[pieces.simplex[s]] = s;
      paths_.adopt(std::move(found), inside);
    }

    Path trace(const PointSource& point, const TraceOptions& options) const override {
      if (options.margin) support(Purpose::margins, this->shape_.kind()).require();
      const std::vector<Index>& vertex = of_.pieces_.vertex;
      if (point.vertex < vertex.size() && vertex[point.vertex] == none) return {};  // in no simplex
      Path path = paths_.trace(inner(point), options);
      for (PathPoint& at : path.points) at.simplex = outer_[at.simplex];
      if (const OpenSimplices* const open = of_.open()) open->outside(path);
      detail::place(path, this->shape_);
      return path;
    }

   private:
    double read(const PointSource& point) const override { return paths_.at(inner(point)); }
    PointSource inner(PointSource point) const {
      if (const OpenSimplices* const open = of_.open()) point = open->inside(point);
      of_.move(point);
      return point;
    }

    const PreparedMixed& of_;
    PathField<MixedComplex<Real>> paths_;
    std::vector<Index> outer_;
  };

  const MixedComplex<Real>& of() const override { return pieces_.complex; }

  Placed place(const SourceList& sources, SolveRoom& room, AnyField& field) const override {
    field.triangulation = {};
    return {&pieces_.complex, moved(sources, room), room.other};
  }
  void take_back(SolveRoom& room, AnyField& field) const override {
    const auto& inner = as<DistanceField<Real>>(room.other.data);
    auto& found = as<DistanceField<Real>>(field.data);
    const auto pick = [&](const auto& from, auto& to, auto nothing) {
      to.clear();
      if (from.empty()) return;
      for (const Index v : pieces_.vertex) to.push_back(v == none ? nothing : from[v]);
    };
    pick(inner.distance, found.distance, std::numeric_limits<Real>::infinity());
    pick(inner.label, found.label, none);
    pick(inner.error, found.error, Real(0));
    found.accuracy = inner.accuracy;
    found.complete = inner.complete;
    found.statistics = inner.statistics;
  }

  [[nodiscard]] Index vertex(Index outer) const {
    if (outer >= pieces_.vertex.size())
      throw UsageError("vertex " + std::to_string(outer) + " is not in the domain");
    if (pieces_.vertex[outer] == none)
      throw UsageError("vertex " + std::to_string(outer) + " is in no simplex of the mixed domain");
    return pieces_.vertex[outer];
  }
  [[nodiscard]] Index simplex(Index outer) const {
    if (outer >= pieces_.simplex.size())
      throw UsageError("simplex " + std::to_string(outer) + " is not in the domain");
    return pieces_.simplex[outer];
  }
  void move(PointSource& point) const {
    if (point.vertex != none)
      point.vertex = vertex(point.vertex);
    else if (point.simplex != none)
      point.simplex = simplex(point.simplex);
  }

  SourceList moved(const SourceList& sources, SolveRoom& room) const {
    return room.moved(
        sources, [&](PointSource& point) { move(point); }, [&](Index& v) { v = vertex(v); },
        [&](Index& s) { s = simplex(s); });
  }

  // Of simplices that vertices join, or vertices that are one.
  void count_components(const Mask* mask) {
    DisjointSets sets(pieces_.complex.vertex_count());
    for (std::size_t s = 0; s < this->shape_.simplices(); ++s) {
      const auto corners = this->shape_.corners(s);
      if (mask != nullptr && !mask->is_open(corners, s)) continue;
      for (const Index v : corners) sets.unite(pieces_.vertex[v], pieces_.vertex[corners[0]]);
    }
    for (const auto& [a, b] : pieces_.complex.outer_welds()) sets.unite(a, b);
    std::vector<bool> seen(pieces_.complex.vertex_count(), false);
    for (const Index v : pieces_.vertex)
      if (v != none && !seen[sets.find(v)]) seen[sets.find(v)] = true, ++components_;
  }

  MixedPieces<Real> pieces_;
  std::size_t components_ = 0;
};

template <class Real, int N>
std::shared_ptr<Prepared> prepare_simplices(const AnyShape& shape, const Mask* mask) {
  using Complex = SimplicialComplex<Real, N>;
  const auto& given = std::get<SimplexShape>(shape.data());
  constexpr std::size_t corners = N + 1, edges = SimplexLayout<N>::edges;
  const auto rows = [&](const auto& numbers, std::size_t width, auto row) {
    std::vector<decltype(row)> open;
    for (std::size_t s = 0; s < given.corners.size() / corners; ++s) {
      if (mask != nullptr && !mask->is_open(shape.corners(s), s)) continue;
      std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(s * width), width, row.begin());
      open.push_back(row);
    }
    return open;
  };
  const auto simplices = rows(given.corners, corners, typename Complex::Corners());
  return std::make_shared<PreparedPlain<Complex>>(shape, given.axes == 0, [&]() -> Complex {
    if (given.axes > 0) return {given.positions, given.axes, simplices};
    return {given.vertices, simplices, rows(given.lengths, edges, typename Complex::Lengths())};
  });
}

template <class Real>
std::shared_ptr<Prepared> prepare_as(const AnyShape& shape, const BuildOptions& options) {
  const MeasuredLengths* const lengths = options.lengths ? options.lengths.get() : shape.lengths();
  const Making making{shape, lengths, options.mask.get(), options.threads, options.progress};
  return std::visit(
      [&](const auto& data) -> std::shared_ptr<Prepared> {
        using Data = std::decay_t<decltype(data)>;
        if constexpr (std::is_same_v<Data, io::Triangles>) {
          return std::make_shared<PreparedSurface<Real>>(shape, options);
        } else if constexpr (std::is_same_v<Data, MixedShape>) {
          std::vector<double> speeds = lengths == nullptr ? std::vector<double>() : lengths->speeds;
          if (making.mask == nullptr)
            return std::make_shared<PreparedMixed<Real>>(shape, data, speeds, nullptr);
          std::size_t number = 0;
          std::erase_if(speeds, [&](double) {
            const std::size_t s = number++;
            return !making.mask->is_open(shape.corners(s), s);
          });
          const AnyShape open = shape.open_part(*making.mask);
          return std::make_shared<PreparedMixed<Real>>(shape, std::get<MixedShape>(open.data()),
                                                       speeds, making.mask);
        } else if constexpr (std::is_same_v<Data, SimplexShape>) {
          switch (data.dimension) {
            case 1:
              return prepare_simplices<Real, 1>(shape, making.mask);
            case 2:
              return prepare_simplices<Real, 2>(shape, making.mask);
            case 3:
              return prepare_simplices<Real, 3>(shape, making.mask);
            default:
              return prepare_simplices<Real, 4>(shape, making.mask);
          }
        } else {
          if constexpr (std::is_same_v<Data, io::Tets>)
            if (lengths != nullptr && lengths->refracts) {
              MixedShape regions;
              regions.positions = data.positions;
              regions.parts.emplace_back().tets =
                  making.mask == nullptr ? data.tets : making.mask->open(data.tets);
              return std::make_shared<PreparedMixed<Real>>(
                  shape, regions, making.open(data.tets, lengths->speeds), making.mask);
            }
          using Complex = decltype(make_complex<Real>(data, making));
          return std::make_shared<PreparedPlain<Complex>>(
              shape, lengths != nullptr, [&] { return make_complex<Real>(data, making); });
        }
      },
      shape.data());
}

template <class Complex>
std::shared_ptr<Prepared> open_plain(const AnyShape& shape, KeptIn& in) {
  auto opened = std::make_shared<PreparedPlain<Complex>>(
      shape, shape.lengths() != nullptr, [&] { return KeptParts::open<Complex>(in); });
  in.require(opened->fits(shape));
  return opened;
}

// What is built already.
template <class Real>
std::shared_ptr<Prepared> open_as(const AnyShape& shape, const KeptBuild& kept) {
  KeptIn in = kept.complex;
  std::shared_ptr<Prepared> opened;
  switch (shape.kind()) {
    case DomainKind::surface:
      opened = std::make_shared<PreparedSurface<Real>>(shape, kept.triangulation, in);
      break;
    case DomainKind::solid:
      opened = open_plain<TetMesh<Real>>(shape, in);
      break;
    case DomainKind::wireframe:
      opened = open_plain<Wireframe<Real>>(shape, in);
      break;
    default:
      opened = open_plain<PointCloud<Real>>(shape, in);
  }
  in.end();
  return opened;
}

}  // namespace

std::shared_ptr<const Prepared> prepare(const AnyShape& shape, const BuildOptions& asked) {
  BuildOptions options = asked;
  if (asked.mask) support(Purpose::masks, shape.kind()).require();
  options.mask = without_collapsed(shape, asked.mask);
  if (on_other_triangles(options.triangulation))
    support(Purpose::triangulations, shape.kind()).require();
  if (options.lengths) support(Purpose::metrics, shape.kind()).require();
  if (options.threads < 0) throw UsageError("the number of threads must be 0 (all) or more");
  std::unique_ptr<const OpenSimplices> open;
  if (options.mask)
    open = std::make_unique<const OpenSimplices>(*options.mask, shape);
  else if (!shape.merged_vertices().empty())
    open = std::make_unique<const OpenSimplices>(Mask(shape.vertices(), shape.simplices()), shape);
  const bool single = options.precision == Precision::float32;
  std::shared_ptr<Prepared> made;
  if (const KeptBuild* const kept = shape.state().kept.get(); kept && kept->answers(options))
    made = single ? open_as<float>(shape, *kept) : open_as<double>(shape, *kept);
  else
    made = single ? prepare_as<float>(shape, options) : prepare_as<double>(shape, options);
  made->open_ = std::move(open);
  return made;
}

}  // namespace plexway::detail
