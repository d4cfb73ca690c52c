// Readers of surfaces, solids, wireframes and clouds, by format.

#include <plexway/io/edges.hpp>
#include <plexway/io/points.hpp>

#include "fuzz_reader.hpp"
#include "io/readers.hpp"
#include "io/solid/cells.hpp"

namespace fuzz {

/// What every reader of wireframes promises for any bytes: a sound wireframe, or an InputError.
template <class Parser>
int check_edge_reader(Parser parse, const std::uint8_t* data, std::size_t size) {
  return check_input("input", [&] {
    const auto wires = parse({reinterpret_cast<const char*>(data), size}, "input");
    require(!wires.edges.empty() || wires.positions.empty(), "a wireframe has edges");
    require(wires.positions.empty() ? wires.lengths.size() == wires.edges.size()
                                    : wires.lengths.empty(),
            "edges have lengths, from the file or from positions");
    if (!wires.positions.empty())
      require(wires.positions.size() == wires.vertices, "one position a vertex");
    require_finite(wires.positions);
    for (const double length : wires.lengths)
      require(std::isfinite(length) && length >= 0, "lengths are finite and not negative");
    require_in_range(wires.edges, wires.vertices);
    require(wires.vertices <= (1u << 24) + 64 * size, "no more vertices than the file is worth");
  });
}

/// What every reader of clouds promises for any bytes: finite points, as many normals or none, or
/// an InputError.
template <class Parser>
int check_points(Parser parse, const std::uint8_t* data, std::size_t size) {
  return check_input("input", [&] {
    const auto points = parse({reinterpret_cast<const char*>(data), size}, "input");
    require(!points.positions.empty(), "a cloud has points");
    require(points.positions.size() <= size, "no more points than the file has bytes");
    require(points.normals.empty() || points.normals.size() == points.positions.size(),
            "normals are none or one a point");
    require_finite(points.positions);
    require_finite(points.normals);
  });
}

}  // namespace fuzz

// FreeSurfer's annotations: a label for each vertex, or an InputError of one line.
PLEXWAY_FUZZER(annotation)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_input("input", [&] {
    const auto labels = plexway::io::parse_freesurfer_annotation(
        {reinterpret_cast<const char*>(data), size}, "input");
    fuzz::require(8 * labels.size() < size, "no more vertices than bytes");
  });
}

// Meshes and points.
PLEXWAY_FUZZER(draco)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_reader(
      [](std::string_view bytes, std::string_view name) {
        return plexway::io::parse_draco(bytes, name);
      },
      data, size);
}

PLEXWAY_FUZZER(edge_list)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_edge_reader(plexway::io::parse_edge_list, data, size);
}

PLEXWAY_FUZZER(freesurfer)(const std::uint8_t* data, std::size_t size) {
  fuzz::check_reader(plexway::io::parse_freesurfer_ascii, data, size);
  return fuzz::check_reader(plexway::io::parse_freesurfer, data, size);
}

// GIfTI: a surface, and the same bytes as labels.
PLEXWAY_FUZZER(gifti)(const std::uint8_t* data, std::size_t size) {
  fuzz::check_reader(plexway::io::parse_gifti, data, size);
  const fuzz::MemoryFile file(data, size);
  return fuzz::check_input(file.name(), [&] { (void)plexway::io::read_gifti_labels(file.name()); });
}

PLEXWAY_FUZZER(gltf)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_reader(
      [](std::string_view bytes, std::string_view name) {
        return plexway::io::parse_gltf(bytes, name);
      },
      data, size);
}

PLEXWAY_FUZZER(gmsh)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_reader(plexway::io::parse_gmsh, data, size);
}

PLEXWAY_FUZZER(las)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_points(plexway::io::parse_las, data, size);
}

PLEXWAY_FUZZER(medit)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_reader(plexway::io::parse_medit, data, size);
}

// The two files of TetGen as one: what stands behind the first '@' is the .ele.
PLEXWAY_FUZZER(node_ele)(const std::uint8_t* data, std::size_t size) {
  const auto parse = [](std::string_view both, std::string_view name) {
    const auto at = both.find('@');
    const std::string_view ele = at == std::string_view::npos ? "" : both.substr(at + 1);
    return plexway::io::parse_node_ele({both.substr(0, at), name}, {ele, name});
  };
  return fuzz::check_reader(parse, data, size);
}

PLEXWAY_FUZZER(obj)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_reader(plexway::io::parse_obj, data, size);
}

PLEXWAY_FUZZER(obj_lines)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_edge_reader(
      [](std::string_view text, std::string_view name) {
        return edges_of(plexway::io::parse_obj(text, name), name);
      },
      data, size);
}

PLEXWAY_FUZZER(off)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_reader(plexway::io::parse_off, data, size);
}

PLEXWAY_FUZZER(ply)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_reader(plexway::io::parse_ply, data, size);
}

PLEXWAY_FUZZER(ply_points)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_points(plexway::io::parse_ply_points, data, size);
}

PLEXWAY_FUZZER(stl)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_reader(plexway::io::parse_stl, data, size);
}

PLEXWAY_FUZZER(three_mf)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_reader(plexway::io::parse_three_mf, data, size);
}

PLEXWAY_FUZZER(vtk)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_reader(plexway::io::parse_vtk, data, size);
}

PLEXWAY_FUZZER(vtu)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_reader(plexway::io::parse_vtu, data, size);
}

PLEXWAY_FUZZER(xyz)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_points(plexway::io::parse_point_table, data, size);
}
