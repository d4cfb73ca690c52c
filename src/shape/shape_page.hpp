#pragma once

#include <plexway/io/page.hpp>
#include <plexway/shape/scene.hpp>
#include <plexway/shape/shape.hpp>

namespace plexway {

/// A domain of any kind on a page, with what a picture would show of it; of solids the skin, or its
/// edges where `content.look_inside`. Refers to `shape` and to the spans of `content`. Throws
/// UsageError for a domain without positions.
void fill_page(io::Page& page, const AnyShape& shape, const SceneContent& content);

}  // namespace plexway
