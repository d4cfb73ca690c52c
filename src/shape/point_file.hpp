#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include <plexway/source/point_source.hpp>

#include <plexway/shape/shape.hpp>

namespace plexway {

/// Points of a domain, and one value each where `value` is not empty (`value_name` is its column).
/// The extension picks the format: .csv (x, y, z, where it is), .npy (n x 3), .obj and .ply
/// (vertices alone). Throws UsageError for another one, and as io::OutputFile.
void write_points(const std::filesystem::path& out, const AnyShape& domain,
                  std::span<const PointSource> points, std::string_view value_name = {},
                  std::span<const double> value = {});
std::span<const std::string_view> point_file_extensions();

/// n x n numbers as .csv or .npy.
void write_matrix(const std::filesystem::path& out, std::size_t n, std::span<const double> values);
std::span<const std::string_view> matrix_file_extensions();

}  // namespace plexway
