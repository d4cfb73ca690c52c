#pragma once

#include <array>
#include <span>
#include <vector>

#include <plexway/cloud/neighbours.hpp>
#include <plexway/io/page.hpp>
#include <plexway/shape/scene.hpp>
#include <plexway/shape/shape.hpp>

namespace plexway::detail {

/// A domain of any kind on a page, with what a picture would show of it; of solids the skin, or its
/// edges where `content.look_inside`. Refers to `shape` and to the spans of `content`. Throws
/// UsageError for a domain without positions.
void fill_page(io::Page& page, const AnyShape& shape, const SceneContent& content);

/// The axis that probably points up, y or z. What is flat as terrain is lies; else what stands has
/// feet: at its lower end it is spread more widely than at its upper one, and more so than along
/// the other axes. Where neither tells, z. Positions only. Cost: linear.
char probable_up(const AnyShape& shape);

/// How values at the points of a cloud grow along its surface, a vector a point: the linear
/// function through the point that is nearest to its neighbours' values, where there are enough of
/// them, else 0. Neighbours whose value is not finite count for nothing. Cost: linear.
[[nodiscard]] std::vector<std::array<double, 3>> cloud_slopes(
    std::span<const std::array<double, 3>> points, std::span<const std::array<double, 3>> normals,
    const Neighbours& neighbours, std::span<const double> value);

}  // namespace plexway::detail
