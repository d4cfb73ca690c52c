#pragma once

#include <functional>
#include <span>

#include <plexway/solve/distance_field.hpp>

#include "executors/gl/context.hpp"
#include "executors/gl/seeds.hpp"
#include "executors/gl/workspace.hpp"

namespace plexway::detail::gl {

/// Throws UsageError for more sources than the device tells apart.
void check_number(std::size_t sources);

/// What a solve was asked to do, and where.
struct Job {
  const GL& executor;
  const PropagateOptions& options;
  GLWorkspace::Implementation& workspace;
  const Session& session;

  /// All `cells` of so many fields unreached, labels of so many bytes; `step` is the dual queue's,
  /// in the unit inside.
  void start(std::size_t cells, std::size_t label_bytes, std::size_t fields, double step) const;
};

/// Calls the caller's progress function with what the device has done. Throws Cancelled.
std::function<void(const FrontControl&)> reporter(const PropagateOptions& options,
                                                  std::size_t simplices, double unit);

/// The last step of every solve: distances at vertices (bits of the least, in the numbers and the
/// unit inside) in `vertex_best`, and their sources if `labels` is not empty, to the caller's
/// arrays of fields times vertices.
struct Finish {
  const Buffer& inside;       ///< the number inside of each vertex
  const Buffer& vertex_best;  ///< the last of `stride` numbers a vertex
  std::size_t stride;
  const Buffer& vertex_source;
  std::size_t vertices, fields;
  double unit;
};
void finish(const Job& job, const Finish& what, std::span<float> distance, std::span<Index> label);

/// The steps before, where labels are not those of vertices: so many vertices unreached, then what
/// sources offer to them, or, of those that came out so near, whose they are.
void start_read_out(const Job& job, std::size_t vertices, std::size_t offers, bool labels);
void offer_vertices(const Job& job, const std::vector<VertexOffer>& offers, bool who, bool labels);
/// `ask`, a dispatch that counts what it changed at binding 4. True if there is anything.
bool changes(const Job& job, const std::function<void()>& ask);

/// A source's own offset survives scaling exactly.
void set_offsets(std::span<const PointSource> sources, const PropagateOptions& options,
                 std::span<float> distance);

/// Of `sources` fields over so many simplices and vertices, how many one launch should hold.
std::size_t fields_at_once(const Session& session, const GL& executor, std::size_t sources,
                           std::size_t simplices, std::size_t label_bytes, std::size_t vertices);

}  // namespace plexway::detail::gl
