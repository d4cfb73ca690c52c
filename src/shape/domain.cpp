#include <plexway/any_domain.hpp>

#include <memory>
#include <utility>
#include <vector>

#include "executors/supported.hpp"
#include "shape/inside.hpp"
#include "shape/kept_build.hpp"
#include "shape/prepared.hpp"
#include "shape/shape_state.hpp"

namespace plexway {

AnyDomain::AnyDomain(AnyShape shape, const BuildOptions& options) {
  const Stopwatch building;
  auto prepared = with_file_name(shape, [&] { return prepare(shape, options); });
  state_ = std::make_shared<const State>(State{std::move(shape), std::move(prepared),
                                               BuildOptions{options.precision,
                                                            options.triangulation,
                                                            options.lengths,
                                                            options.mask,
                                                            options.threads,
                                                            {}},
                                               building.seconds()});
}

AnyDomain AnyDomain::masked(std::shared_ptr<const Mask> mask) const {
  BuildOptions options = state_->options;
  options.mask = std::move(mask);
  return AnyDomain(shape(), options);
}

void AnyDomain::keep(const std::filesystem::path& file) const {
  KeptOut out(file);
  // Without what the complex leaves out.
  const auto open = without_collapsed(shape(), nullptr);
  write_kept_shape(out, open ? shape().open_part(*open) : shape(), state_->options);
  state_->prepared->keep(out);
  out.commit();
}

AnyDomain AnyDomain::read(const std::filesystem::path& file, const ReadOptions& reading,
                          const BuildOptions& building) {
  return AnyDomain(AnyShape::read(file, reading), building);
}

const AnyShape& AnyDomain::shape() const { return state_->shape; }
Precision AnyDomain::precision() const { return state_->prepared->precision(); }
std::size_t AnyDomain::simplices() const {
  return open_simplices() != nullptr ? shape().simplices() : state_->prepared->simplices();
}
const MeasuredLengths* AnyDomain::lengths() const { return state_->options.lengths.get(); }
const OpenSimplices* AnyDomain::open_simplices() const { return state_->prepared->open(); }
std::size_t AnyDomain::components() const { return state_->prepared->components(); }
double AnyDomain::mean_edge() const { return state_->prepared->mean_edge(); }
std::size_t AnyDomain::refracting_edges() const { return state_->prepared->refracting_edges(); }
const CloudSummary* AnyDomain::cloud() const { return state_->prepared->cloud(); }
const TriangulationReport& AnyDomain::triangulation() const {
  return state_->prepared->triangulation();
}
double AnyDomain::build_seconds() const { return state_->build_seconds; }
std::size_t AnyDomain::bytes() const { return state_->prepared->bytes(); }

Support AnyDomain::support(const AnyExecutor& executor, const SourceList& sources,
                           const PropagateOptions& options) const {
  const ExecutorKind kind = std::visit([](const auto& e) { return e.kind; }, executor);
  return detail::support_of(state_->prepared->combination(kind), state_->prepared->metric(),
                            sources, options);
}

AnyPathField AnyDomain::path_field(const AnyExecutor& executor,
                                   std::span<const PointSource> sources,
                                   const PropagateOptions& options) const {
  const Inside inside(open_simplices(), sources);
  return AnyPathField(with_file_name(shape(), [&] {
    return state_->prepared->path_field(executor, inside.list().points(), options);
  }));
}

const AnyField& AnyPathField::field() const { return state_->field; }
Path AnyPathField::trace(const PointSource& point, const TraceOptions& options) const {
  return state_->trace(point, options);
}
double AnyPathField::at(const PointSource& point, ReadOut level) const {
  return state_->at(point, level);
}
std::vector<double> AnyPathField::at(std::span<const PointSource> points, ReadOut level) const {
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const PointSource& point : points) distances.push_back(state_->at(point, level));
  return distances;
}
std::vector<std::array<double, 3>> AnyPathField::gradient() const { return state_->gradient(); }
std::size_t AnyPathField::bytes() const { return state_->bytes(); }

AnyComplex complex_of(const AnyDomain& domain) { return domain.state().prepared->complex(); }

RowComplex row_complex(const AnyDomain& domain, std::span<const PointSource> rows) {
  std::vector<PointSource> inside(rows.begin(), rows.end());
  if (const OpenSimplices* const open = domain.open_simplices())
    for (PointSource& row : inside) row = open->inside(row);
  RowComplex found = domain.state().prepared->row_complex(std::move(inside));
  if (std::holds_alternative<std::monostate>(found.complex))
    found.rows.assign(rows.begin(), rows.end());
  return found;
}

}  // namespace plexway
