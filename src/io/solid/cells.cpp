#include "io/solid/cells.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "io/surface/polygons.hpp"

namespace plexway::io {
namespace {

using enum CellKind;

// By VTK's numbers; of those with 0 nodes files tell how many.
constexpr CellType vtk_types[] = {
    /* 0 */ {point, 0},
    {point, 0},
    {point, 0},
    {line, 2},
    {polyline, 0},
    /* 5 */ {triangle, 3},
    {strip, 0},
    {polygon, 0},
    {pixel, 4},
    {quad, 4},
    /* 10 */ {tetrahedron, 4},
    {voxel, 8},
    {hexahedron, 8},
    {prism, 6},
    {pyramid, 5},
    /* 15 */ {five_sided_prism, 10},
    {six_sided_prism, 12},
    {},
    {},
    {},
    /* 20 */ {},
    {line, 3},
    {triangle, 6},
    {quad, 8},
    {tetrahedron, 10},
    /* 25 */ {hexahedron, 20},
    {prism, 15},
    {pyramid, 13},
    {quad, 9},
    {hexahedron, 27},
    /* 30 */ {quad, 6},
    {prism, 12},
    {prism, 18},
    {hexahedron, 24},
    {triangle, 7},
    /* 35 */ {line, 4},
    {},
    {pyramid, 19}};
// Of any order, from 60 and from 68 on.
constexpr CellKind vtk_high_orders[] = {
    line,     triangle, quad,        polygon,     tetrahedron, prism,  pyramid, hexahedron,
    line,     triangle, quad,        tetrahedron, hexahedron,  prism,  pyramid, line,
    triangle, quad,     tetrahedron, hexahedron,  prism,       pyramid};

// Gmsh's numbers of each kind, from order 1 on.
constexpr std::int16_t gmsh_orders[][10] = {
    {1, 8, 26, 27, 28, 62, 63, 64, 65, 66},        {2, 9, 21, 23, 25, 42, 43, 44, 45, 46},
    {3, 10, 36, 37, 38, 47, 48, 49, 50, 51},       {4, 11, 29, 30, 31, 71, 72, 73, 74, 75},
    {5, 12, 92, 93, 94, 95, 96, 97, 98, -1},       {6, 13, 90, 91, 106, 107, 108, 109, 110, -1},
    {7, 14, 118, 119, 120, 121, 122, 123, 124, -1}};
constexpr CellKind gmsh_kinds[] = {line, triangle, quad, tetrahedron, hexahedron, prism, pyramid};
// Points, and those without nodes inside of faces or of themselves.
constexpr std::pair<int, CellType> gmsh_others[] = {
    {15, {point, 1}},    {16, {quad, 8}},     {17, {hexahedron, 20}}, {18, {prism, 15}},
    {19, {pyramid, 13}}, {20, {triangle, 9}}, {22, {triangle, 12}},   {24, {triangle, 15}}};

std::uint32_t nodes_of(CellKind kind, std::uint32_t order) {
  const std::uint32_t n = order + 1;
  switch (kind) {
    case line:
      return n;
    case triangle:
      return n * (n + 1) / 2;
    case quad:
      return n * n;
    case tetrahedron:
      return n * (n + 1) * (n + 2) / 6;
    case hexahedron:
      return n * n * n;
    case prism:
      return n * n * (n + 1) / 2;
    default:
      return n * (n + 1) * (2 * n + 1) / 6;
  }
}

}  // namespace

CellType vtk_cell_type(std::int64_t number) {
  if (number >= 0 && number < std::ssize(vtk_types))
    return vtk_types[static_cast<std::size_t>(number)];
  if (number >= 60 && number - 60 < std::ssize(vtk_high_orders))
    return {vtk_high_orders[static_cast<std::size_t>(number - 60)], 0};
  return {};
}

CellType gmsh_cell_type(std::int64_t number) {
  for (std::size_t kind = 0; kind < std::size(gmsh_kinds); ++kind)
    for (std::uint32_t order = 1; order <= 10; ++order)
      if (gmsh_orders[kind][order - 1] == number)
        return {gmsh_kinds[kind], nodes_of(gmsh_kinds[kind], order)};
  for (const auto& [other, type] : gmsh_others)
    if (other == number) return type;
  return {};
}

std::uint32_t corners_of(CellKind kind) {
  constexpr std::uint32_t least[] = {0, 0, 2, 2, 3, 3, 3, 4, 4, 4, 8, 8, 6, 5, 10, 12};
  return least[static_cast<std::size_t>(kind)];
}

std::string_view name_of(CellKind kind) {
  constexpr std::string_view names[] = {"cell",
                                        "point",
                                        "line",
                                        "polyline",
                                        "triangle",
                                        "strip",
                                        "polygon",
                                        "pixel",
                                        "quadrilateral",
                                        "tetrahedron",
                                        "voxel",
                                        "hexahedron",
                                        "prism",
                                        "pyramid",
                                        "prism of five sides",
                                        "prism of six sides"};
  return names[static_cast<std::size_t>(kind)];
}

bool CellTaker::add(CellKind kind, std::span<const std::uint32_t> corners) {
  const auto c = corners;
  if (c.size() < corners_of(kind)) return false;
  const auto add_triangle = [&](std::size_t i, std::size_t j, std::size_t k) {
    cells_.triangles.push_back({c[i], c[j], c[k]});
  };
  switch (kind) {
    case none:
    case point:
      break;
    case line:
      cells_.edges.push_back({c[0], c[1]});
      break;
    case polyline:
      for (std::size_t i = 1; i < c.size(); ++i) cells_.edges.push_back({c[i - 1], c[i]});
      break;
    case triangle:
      add_triangle(0, 1, 2);
      break;
    case strip:  // where one goes back to a corner it joins two
      for (std::size_t i = 2; i < c.size(); ++i)
        if (c[i] != c[i - 1] && c[i - 1] != c[i - 2] && c[i - 2] != c[i])
          add_triangle(i - 2, i % 2 == 0 ? i - 1 : i, i % 2 == 0 ? i : i - 1);
      break;
    case polygon:
      cut_polygon(cells_.positions, c, cells_.triangles);
      if (c.size() > 3) ++cells_.report.split_polygons;
      break;
    case pixel:
      return add(quad, std::array{c[0], c[1], c[3], c[2]});
    case quad:
      return add(polygon, c.first(4));
    case tetrahedron:
      cells_.tets.push_back({c[0], c[1], c[2], c[3]});
      break;
    case voxel:
      return add(hexahedron, std::array{c[0], c[1], c[3], c[2], c[4], c[5], c[7], c[6]});
    default:
      add_solid(kind, c.first(corners_of(kind)));
      ++cells_.report.split_cells;
  }
  return true;
}

void CellTaker::add_solid(CellKind kind, std::span<const std::uint32_t> corners) {
  // Faces by places among the corners; a prism has one of n below, one above, and n around.
  std::vector<std::vector<std::size_t>> faces;
  if (kind == pyramid) {
    faces = {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  } else {
    const std::size_t n = corners.size() / 2;
    faces.resize(2);
    for (std::size_t i = 0; i < n; ++i) {
      faces[0].push_back(n - 1 - i);
      faces[1].push_back(n + i);
      faces.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
    }
  }
  const auto sorted = [](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    std::array<std::uint32_t, 3> triangle = {a, b, c};
    std::sort(triangle.begin(), triangle.end());
    return triangle;
  };
  const auto lower = [&](std::size_t a, std::size_t b) { return corners[a] < corners[b]; };
  const std::uint32_t apex = *std::min_element(corners.begin(), corners.end());
  const std::size_t first = cells_.tets.size();
  double volume = 0;
  for (auto& face : faces) {
    std::rotate(face.begin(), std::min_element(face.begin(), face.end(), lower), face.end());
    const auto at = [&](std::size_t i) { return corners[face[i]]; };
    if (face.size() == 4 && at(0) != at(1) && at(1) != at(2) && at(2) != at(3) && at(3) != at(0))
      for (const std::size_t tip : {0, 2})
        halves_.push_back(sorted(corners[face[1]], corners[face[3]], corners[face[tip]]));
    if (corners[face[0]] == apex) continue;
    for (std::size_t i = 2; i < face.size(); ++i) {
      const std::array<std::uint32_t, 4> tet = {apex, corners[face[0]], corners[face[i - 1]],
                                                corners[face[i]]};
      // Of cells of which corners are one.
      if (tet[1] == tet[2] || tet[2] == tet[3] || tet[1] == tet[3]) continue;
      std::array<std::array<double, 3>, 3> side{};
      for (std::size_t s = 0; s < 3; ++s)
        for (std::size_t k = 0; k < 3; ++k)
          side[s][k] = cells_.positions[tet[s + 1]][k] - cells_.positions[apex][k];
      for (std::size_t k = 0; k < 3; ++k)
        volume += side[0][k] * (side[1][(k + 1) % 3] * side[2][(k + 2) % 3] -
                                side[1][(k + 2) % 3] * side[2][(k + 1) % 3]);
      cells_.tets.push_back(tet);
    }
  }
  // Files differ in which way round they list a prism.
  if (volume < 0)
    for (std::size_t t = first; t < cells_.tets.size(); ++t)
      std::swap(cells_.tets[t][2], cells_.tets[t][3]);
}

void CellTaker::finish(std::string_view name) {
  std::sort(halves_.begin(), halves_.end());
  for (std::size_t t = 0; t < cells_.tets.size() && !halves_.empty(); ++t)
    for (std::size_t out = 0; out < 4; ++out) {
      auto tet = cells_.tets[t];
      std::swap(tet[out], tet[3]);
      std::sort(tet.begin(), tet.begin() + 3);
      if (std::binary_search(halves_.begin(), halves_.end(), std::array{tet[0], tet[1], tet[2]}))
        throw InputError(std::string(name) + ": the triangle of vertices " +
                         std::to_string(tet[0]) + ", " + std::to_string(tet[1]) + " and " +
                         std::to_string(tet[2]) +
                         " is half a face of a hexahedron or prism that is cut along the other "
                         "diagonal: they need a pyramid between, or save it as tetrahedra");
    }
  if (!refused_.passed_over.empty())
    throw InputError(std::string(name) + ": has " + refused_.passed_over_text() +
                     ", which are not read: a domain without them would have holes");
}

namespace {

void pass_over(const Mixed& cells, FileReport& report, bool triangles) {
  if (triangles) report.pass_over("triangles", cells.triangles.size());
  report.pass_over("lines", cells.edges.size());
}

}  // namespace

Tets tets_of(Mixed cells, std::string_view name) {
  pass_over(cells, cells.report, true);
  if (cells.tets.empty())
    throw InputError(
        std::string(name) + ": has no tetrahedra; it has " +
        (cells.report.passed_over.empty() ? "no cells at all" : cells.report.passed_over_text()));
  return {std::move(cells.positions), std::move(cells.tets), std::move(cells.report)};
}

Triangles triangles_of(Mixed cells, std::string_view name) {
  pass_over(cells, cells.report, false);
  Triangles surface{std::move(cells.positions), std::move(cells.triangles),
                    std::move(cells.report)};
  require_faces(surface, name);
  return surface;
}

Edges edges_of(Mixed cells, std::string_view name) {
  if (cells.edges.empty())
    throw InputError(std::string(name) + (cells.triangles.empty()
                                              ? ": has no lines; a wireframe needs at least one"
                                              : ": has faces but no lines; read it as a surface"));
  cells.report.pass_over("triangles", cells.triangles.size());
  const std::size_t n = cells.positions.size();
  return {std::move(cells.positions), std::move(cells.edges), {}, n, std::move(cells.report)};
}

void close_seams(Mixed& cells) {
  const auto& p = cells.positions;
  std::vector<std::uint32_t> order(p.size()), becomes(p.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return p[a] != p[b] ? p[a] < p[b] : a < b; });
  for (std::size_t i = 0; i < order.size(); ++i)
    becomes[order[i]] = i > 0 && p[order[i]] == p[order[i - 1]] ? becomes[order[i - 1]] : order[i];
  std::vector<std::array<double, 3>> kept;
  std::vector<std::uint32_t> number(p.size());
  for (std::uint32_t v = 0; v < p.size(); ++v)
    if (becomes[v] == v) {
      number[v] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(p[v]);
    }
  const auto renumber = [&](auto& rows) {
    for (auto& row : rows)
      for (std::uint32_t& v : row) v = number[becomes[v]];
  };
  renumber(cells.edges);
  renumber(cells.triangles);
  cells.positions = std::move(kept);
  std::erase_if(cells.triangles,
                [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[0] == t[2]; });
}

Mixed mixed_of(Triangles surface) {
  Mixed cells;
  cells.positions = std::move(surface.positions);
  cells.triangles = std::move(surface.triangles);
  cells.report = std::move(surface.report);
  return cells;
}

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
