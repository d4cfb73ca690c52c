#pragma once

#include <memory>
#include <string>

#include <plexway/common/mask.hpp>
#include <plexway/shape/read_options.hpp>
#include <plexway/shape/shape.hpp>

namespace plexway {

/// The mask that a text tells: `vertices:FILE` or `simplices:FILE`, a number (0-based) a line, are
/// closed; `FILE:3,7`, vertices with these labels (io::read_vertex_labels); `regions:3,7`,
/// simplices of these regions of the shape's own file (AnyShape::regions). Throws UsageError for
/// another text and for shapes that have no masks, InputError "FILE:LINE: cause", for a label or
/// region that nothing has, and where nothing stays open; messages name the option as `spelling`
/// has it.
[[nodiscard]] std::shared_ptr<const Mask> read_mask(const std::string& text, const AnyShape& shape,
                                                    Spelling spelling = Spelling::fields);

}  // namespace plexway
