#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "quote.hpp"
#include "surface_checks.hpp"
#include "text_scanner.hpp"

namespace plexway::io {

/// An OBJ vertex, after its `v`.
inline void read_obj_vertex(TextScanner& scanner, std::vector<std::array<double, 3>>& positions) {
  const double x = scanner.number("coordinate x");
  const double y = scanner.number("coordinate y");
  const double z = scanner.number("coordinate z");
  while (scanner.to_field()) scanner.number("the field after z");  // weight or colour
  if (positions.size() == most_vertices) scanner.fail("more vertices than 32 bits count");
  positions.push_back({x, y, z});
}

/// What messages call an OBJ statement that names vertices, and one of those.
struct ObjElement {
  std::string_view name;    ///< "face"
  std::string_view vertex;  ///< "a vertex of the face"
};

/// One corner of the element with this number: `v`, `v/vt`, `v//vn` or `v/vt/vn`. Returns the
/// vertex, 0-based, < `limit`.
inline std::uint64_t read_obj_corner(TextScanner& scanner, const ObjElement& element,
                                     std::size_t number, std::size_t vertices_so_far,
                                     std::uint64_t limit) {
  const std::int64_t index = scanner.integer(element.vertex, '/');
  const std::string_view rest = scanner.rest_of_field();
  if (rest.find_first_not_of("/-+0123456789") != std::string_view::npos)
    scanner.fail("a corner of the " + std::string(element.name) +
                 " is not like 1, 1/2, 1//3 or 1/2/3: it goes on with " + quote(rest));
  const auto names = [&] {
    return std::string(element.name) + " " + std::to_string(number) + " names vertex " +
           std::to_string(index);
  };
  if (index > 0) {
    const auto vertex = static_cast<std::uint64_t>(index) - 1;
    if (vertex >= limit)
      scanner.fail(names() + ", but the file has " + std::to_string(limit) + " vertices");
    return vertex;
  }
  if (index == 0) scanner.fail(names() + "; OBJ counts from 1");
  const auto back = std::uint64_t{0} - static_cast<std::uint64_t>(index);
  if (back > vertices_so_far)
    scanner.fail(names() + ", but only " + std::to_string(vertices_so_far) +
                 " vertices come before it");
  return vertices_so_far - back;
}

}  // namespace plexway::io
