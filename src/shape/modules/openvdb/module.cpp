// The tool's module for OpenVDB: see shape/modules/module.hpp.

#include <cstdio>
#include <utility>

#include <plexway/openvdb/field.hpp>
#include <plexway/openvdb/level_set.hpp>
#include <plexway/openvdb/solid.hpp>
#include <plexway/openvdb/surface.hpp>

#include "file/new_file.hpp"
#include "shape/modules/module.hpp"

namespace {

namespace fs = std::filesystem;
namespace vdb = plexway::openvdb;
using plexway::detail::OpenvdbFunctions;
using plexway::io::Tets;
using plexway::io::Triangles;

vdb::LevelSet read(const fs::path& file, const std::string& grid, double voxel, std::string& note) {
  vdb::LevelSet level_set = vdb::read_level_set(file, grid);
  char text[120];
  std::snprintf(text, sizeof text, "', voxel %.4g, %zu active voxels, %zu inside",
                level_set.voxel(), level_set.active_voxels(), level_set.inside_voxels());
  note = "level set '" + level_set.name() + text;
  if (voxel > 0) {
    std::snprintf(text, sizeof text, "; cut at %.4g", voxel);
    note += text;
  }
  return level_set;
}

vdb::LevelSet level_set_of(const Triangles& surface, double voxel, std::string& note) {
  vdb::Repair report;
  vdb::LevelSet level_set =
      vdb::level_set_of(surface.positions, surface.triangles, {.voxel = voxel, .report = &report});
  note = report.text();
  return level_set;
}

Tets tets(vdb::Solid solid) { return {std::move(solid.positions), std::move(solid.tets)}; }

Triangles triangles(vdb::Surface surface) {
  return {std::move(surface.positions), std::move(surface.triangles)};
}

Tets solid_of_file(const fs::path& file, const std::string& grid, double voxel, std::string& note) {
  return tets(vdb::fill(read(file, grid, voxel, note), voxel));
}

Triangles surface_of_file(const fs::path& file, const std::string& grid, double voxel,
                          std::string& note) {
  return triangles(vdb::surface_of(read(file, grid, voxel, note), voxel));
}

Tets solid_inside(const Triangles& surface, double voxel, std::string& note) {
  return tets(vdb::fill(level_set_of(surface, voxel, note)));
}

Triangles repaired(const Triangles& surface, double voxel, std::string& note) {
  return triangles(vdb::surface_of(level_set_of(surface, voxel, note)));
}

void write_level_set(const fs::path& file, const Triangles& surface, double voxel,
                     std::string& note) {
  vdb::write_level_set(file, level_set_of(surface, voxel, note));
}

std::size_t write_field(const fs::path& file, const Tets& solid, std::span<const double> distance,
                        std::span<const std::int32_t> label, double voxel) {
  vdb::FieldOptions options;
  options.voxel = voxel;
  return vdb::write_field(file, solid.positions, solid.tets, distance, label, options);
}

constexpr OpenvdbFunctions functions = {solid_of_file, surface_of_file, solid_inside,
                                        repaired,      write_level_set, write_field};

}  // namespace

extern "C" const OpenvdbFunctions* plexway_openvdb_functions() { return &functions; }
extern "C" void plexway_remove_unfinished() { plexway::detail::file::remove_unfinished(); }
