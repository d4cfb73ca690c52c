#include "vtk_cells.hpp"

#include <utility>

namespace plexway::io {
namespace {

constexpr std::pair<std::string_view, NumberType> number_types[] = {
    {"Int8", NumberType::i8},
    {"UInt8", NumberType::u8},
    {"Int16", NumberType::i16},
    {"UInt16", NumberType::u16},
    {"Int32", NumberType::i32},
    {"UInt32", NumberType::u32},
    {"Int64", NumberType::i64},
    {"UInt64", NumberType::u64},
    {"Float32", NumberType::f32},
    {"Float64", NumberType::f64},
    {"char", NumberType::i8},
    {"signed_char", NumberType::i8},
    {"unsigned_char", NumberType::u8},
    {"short", NumberType::i16},
    {"unsigned_short", NumberType::u16},
    {"int", NumberType::i32},
    {"unsigned_int", NumberType::u32},
    {"vtkidtype", NumberType::i32},
    {"long", NumberType::i64},
    {"unsigned_long", NumberType::u64},
    {"vtktypeint64", NumberType::i64},
    {"vtktypeuint64", NumberType::u64},
    {"float", NumberType::f32},
    {"double", NumberType::f64},
};

/// vtkCellType.h; "" where the name would say nothing.
std::string kind_of(std::int64_t type) {
  constexpr std::string_view kinds[] = {
      "empty cells", "vertices", "vertices",       "lines",          "lines", "triangles",
      "strips",      "polygons", "quadrilaterals", "quadrilaterals", "",      "hexahedra",
      "hexahedra",   "prisms",   "pyramids",       "prisms",         "prisms"};
  if (type >= 0 && type < static_cast<std::int64_t>(std::size(kinds)))
    return std::string(kinds[static_cast<std::size_t>(type)]);
  return "cells of type " + std::to_string(type);
}

/// The corners that a tetrahedron of this type must at least have; none if it is something else.
/// Quadratic, Lagrange and Bezier ones list their four corners first.
std::optional<std::uint64_t> nodes_of_tetrahedron(std::int64_t type) {
  switch (type) {
    case 10:
      return 4;
    case 24:
      return 10;
    case 64:
    case 71:
    case 78:
      return 4;
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<NumberType> vtk_number_type(std::string_view name) {
  for (const auto& [known, type] : number_types)
    if (known == name) return type;
  return std::nullopt;
}

// Lines and polygons, those of second order too; points are no more than vertices.
bool VtkTets::add_other(const VtkCells& cells, std::size_t cell, std::int64_t type) {
  constexpr std::int64_t empty = 0, point = 1, points = 2, line = 3, polyline = 4, triangle = 5,
                         strip = 6, polygon = 7, pixel = 8, quad = 9, line2 = 21, triangle2 = 22,
                         quad2 = 23;
  const std::uint64_t from = cell == 0 ? 0 : cells.ends[cell - 1];
  const std::uint64_t nodes = cells.ends[cell] - from;
  const std::uint32_t* corner = cells.connectivity.data() + from;
  const auto add_triangle = [&](std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    solid_.triangles.push_back({corner[a], corner[b], corner[c]});
  };
  if (type == empty || type == point || type == points) return true;
  if ((type == line && nodes == 2) || (type == line2 && nodes == 3)) {
    solid_.edges.push_back({corner[0], corner[1]});
    return true;
  }
  if (type == polyline && nodes >= 2) {
    for (std::uint64_t i = 0; i + 1 < nodes; ++i)
      solid_.edges.push_back({corner[i], corner[i + 1]});
    return true;
  }
  if ((type == triangle && nodes == 3) || (type == triangle2 && nodes == 6)) {
    add_triangle(0, 1, 2);
    return true;
  }
  if ((type == polygon && nodes >= 3) || (type == quad && nodes == 4) ||
      (type == quad2 && nodes == 8)) {
    const std::uint64_t corners = type == quad2 ? 4 : nodes;
    for (std::uint64_t i = 2; i < corners; ++i) add_triangle(0, i - 1, i);
    return true;
  }
  if (type == pixel && nodes == 4) {
    add_triangle(0, 1, 3);
    add_triangle(0, 3, 2);
    return true;
  }
  if (type == strip && nodes >= 3) {
    for (std::uint64_t i = 2; i < nodes; ++i)
      add_triangle(i - 2, i % 2 == 0 ? i - 1 : i, i % 2 == 0 ? i : i - 1);
    return true;
  }
  return false;
}

std::optional<std::string> VtkTets::add(const VtkCells& cells, std::size_t cell,
                                        std::int64_t type) {
  const auto needed = nodes_of_tetrahedron(type);
  if (!needed) {
    if (take_ != Take::tets && add_other(cells, cell, type)) return std::nullopt;
    others_.add(kind_of(type));
    return std::nullopt;
  }
  const std::uint64_t from = cell == 0 ? 0 : cells.ends[cell - 1];
  const std::uint64_t nodes = cells.ends[cell] - from;
  const bool exactly = type == 10 || type == 24;
  if (exactly ? nodes != *needed : nodes < *needed)
    return "cell " + std::to_string(cell) + ", a tetrahedron of type " + std::to_string(type) +
           ", has " + std::to_string(nodes) + " points";
  const std::uint32_t* corner = cells.connectivity.data() + from;
  solid_.tets.push_back({corner[0], corner[1], corner[2], corner[3]});
  return std::nullopt;
}

}  // namespace plexway::io
