#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <plexway/shape/read_options.hpp>

namespace plexway {

/// What was written.
struct Converted {
  std::string kind;          ///< as kind_name, or "the solid's surface"
  std::string simplex_name;  ///< in the plural; empty for clouds
  std::string note;          ///< how a level set came in or out, or empty
  std::size_t vertices = 0, simplices = 0;
  double load_seconds = 0, write_seconds = 0;
};

/// Extensions that something can be written as, with the dot.
[[nodiscard]] std::vector<std::string_view> conversion_extensions();

/// Reads a domain and writes it in the format of `out`: a surface is filled where only solids fit,
/// of a solid the boundary is taken where only surfaces fit. `options.cloud` is not looked at.
/// Throws as AnyShape::read and the writers, and UsageError for what does not go into that format.
Converted convert(const std::string& input, const std::string& out, const ReadOptions& options);

}  // namespace plexway
