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

}  // namespace

std::optional<NumberType> vtk_number_type(std::string_view name) {
  for (const auto& [known, type] : number_types)
    if (known == name) return type;
  return std::nullopt;
}

std::optional<std::string> add_vtk_cell(CellTaker& taker, const VtkCells& cells, std::size_t cell,
                                        std::int64_t type) {
  constexpr std::int64_t polygon2 = 36;
  const std::uint64_t from = cell == 0 ? 0 : cells.ends[cell - 1];
  const std::uint64_t nodes = cells.ends[cell] - from;
  auto [kind, exactly] = vtk_cell_type(type);
  if (type == polygon2) kind = CellKind::polygon;  // its corners, and then as many mid-points
  if (kind == CellKind::none && type != 0) {
    taker.refuse(type == 41   ? "sets of points"
                 : type == 42 ? "polyhedra"
                              : "cells of type " + std::to_string(type));
    return std::nullopt;
  }
  const std::span corners(cells.connectivity.data() + from, type == polygon2 ? nodes / 2 : nodes);
  if ((exactly != 0 && nodes != exactly) || !taker.add(kind, corners))
    return "cell " + std::to_string(cell) + ", a " + std::string(name_of(kind)) + " of type " +
           std::to_string(type) + ", has " + std::to_string(nodes) + " points";
  return std::nullopt;
}

}  // namespace plexway::io
