#pragma once

#include <functional>
#include <span>

#include <plexway/propagate/distance_field.hpp>

#include "executors/gl/uniforms.hpp"
#include "executors/gl/workspace.hpp"

namespace plexway::gl {

/// Throws UsageError for options that need an order among labels, or another rule.
void check_options(const PropagateOptions& options, std::size_t sources);

/// Room for waiting labels at first.
std::size_t room_for(const GL& executor, std::size_t cells);

/// Calls the caller's progress function with what the device has done. Throws Cancelled.
std::function<void(const FrontControl&)> reporter(const PropagateOptions& options,
                                                  std::size_t simplices, double unit);

/// The last step of every solve: distances at vertices (bits of the least, in the numbers and the
/// unit inside) in `vertex_best`, and their sources if `labels` is not empty, to the caller's
/// arrays of fields times vertices.
struct Finish {
  const Buffer& inside;  ///< the number inside of each vertex
  const Buffer& vertex_best;
  const Buffer& vertex_source;
  std::size_t vertices, fields;
  double unit, radius;
};
void finish(const Session& session, GLWorkspace::Implementation& workspace, const Finish& what,
            std::span<float> distance, std::span<Index> label);

/// A source's own offset survives scaling exactly.
void set_offsets(std::span<const PointSource> sources, const PropagateOptions& options,
                 std::span<float> distance);

/// Of `sources` fields over so many simplices and vertices, how many one launch should hold.
std::size_t fields_at_once(const Session& session, const GL& executor, std::size_t sources,
                           std::size_t simplices, std::size_t label_bytes, std::size_t vertices);

/// Expansions that all fields of a launch may have together.
std::size_t budget_of(const PropagateOptions& options, std::size_t fields);

/// Throws UsageError unless `distance` has the size of that many fields.
void check_size(std::span<const float> distance, std::size_t sources, std::size_t vertices);

}  // namespace plexway::gl
