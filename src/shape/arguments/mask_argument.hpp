#pragma once

#include <memory>
#include <span>
#include <string>

#include <plexway/common/mask.hpp>
#include <plexway/shape/shape.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/source/source.hpp>

namespace plexway {

/// As typed, or nothing: vertices:FILE or simplices:FILE, numbers; FILE:3,7, what has these labels
/// in a file of labels of vertices (io::read_vertex_labels); or regions:3,7, what has these in the
/// input's own file (AnyShape::regions).
struct MaskArgument {
  std::string text;
};

/// The file, or nothing. Throws UsageError for what is none of these.
[[nodiscard]] std::string mask_file(const MaskArgument& argument);

/// What is closed of a domain, or null. Throws InputError "FILE:LINE: cause", where nothing stays
/// open, and for a label or region that nothing has; UsageError for a cloud.
[[nodiscard]] std::shared_ptr<const Mask> read_mask(const MaskArgument& argument,
                                                    const AnyShape& domain);

///@{
/// Throws InputError for a place that is closed, or cut off from everything. Null closes nothing.
void require_open(const Mask* mask, const AnyShape& domain, std::span<const PointSource> points);
void require_open(const Mask* mask, const AnyShape& domain, std::span<const Source> sources);
///@}

}  // namespace plexway
