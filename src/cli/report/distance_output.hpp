#pragma once

#include <cstdint>
#include <span>

#include "io/output_place.hpp"

namespace plexway::cli {

using io::check_output_name;
using io::check_output_place;
using io::check_outputs_differ;

/// CSV on standard output: `vertex,distance`, and `,label`, `,original` and `,error` where there
/// are such. Throws as write_output.
void write_distance_csv(std::span<const double> distance, std::span<const std::int32_t> label,
                        std::span<const std::uint32_t> original, std::span<const double> error);

}  // namespace plexway::cli
