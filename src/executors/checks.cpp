#include "executors/checks.hpp"

#include <string>
#include <variant>

#include <plexway/error.hpp>

namespace plexway {

Accuracy resolved(Accuracy accuracy, const Combination& c) {
  if (accuracy.kind() != Accuracy::Kind::usual) return accuracy;
  return support_of_accuracy(c) ? Accuracy::accurate() : Accuracy::fast();
}

Combination with(Combination what, const PropagateOptions& options) {
  what.visibility = options.visibility;
  what.schedule = options.schedule;
  what.accuracy = options.accuracy.kind();
  what.label_options = options.step != PropagateOptions{}.step || !options.vectorised;
  return what;
}

namespace detail {

namespace {

SourceKind kind_of(const PointSource& source) {
  return source.vertex != none ? SourceKind::vertex : SourceKind::point;
}
SourceKind kind_of(const VertexSource&) { return SourceKind::vertex; }
SourceKind kind_of(const BallSource& source) { return kind_of(source.centre); }
SourceKind kind_of(const CurveSource& source) {
  if (source.points.size() > 1) return SourceKind::curve;
  return source.points.empty() ? SourceKind::vertex : kind_of(source.points.front());
}
SourceKind kind_of(const SimplexSource&) { return SourceKind::simplex; }

}  // namespace

Combination with(Combination what, MetricKind metric, const PropagateOptions& options) {
  what.metric = metric;
  return plexway::with(what, options);
}

Support support_of(Combination what, MetricKind metric, const SourceList& sources,
                   const PropagateOptions& options) {
  what = with(what, metric, options);
  Support found = support(what);
  const auto look = [&](SourceKind kind) {
    if (!found) return;
    what.source = kind;
    found = support(what);
  };
  for (const PointSource& source : sources.points())
    if (source.vertex == none) look(SourceKind::point);
  for (const Source& source : sources.sources())
    std::visit([&](const auto& one) { look(kind_of(one)); }, source);
  return found;
}

void require_support(const Combination& what, MetricKind metric, const SourceList& sources,
                     const PropagateOptions& options) {
  support_of(what, metric, sources, options).require();
}

void check_rows(std::size_t room, std::size_t sources, std::size_t vertices) {
  if (room != sources * vertices)
    throw UsageError("room for " + std::to_string(room) + " distances, but " +
                     std::to_string(sources) + " fields of " + std::to_string(vertices) +
                     " vertices need " + std::to_string(sources * vertices));
}

}  // namespace detail

}  // namespace plexway
