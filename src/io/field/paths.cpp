#include <plexway/io/paths.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include <plexway/error.hpp>

#include "io/names.hpp"
#include "io/output_file.hpp"

namespace plexway::io {
namespace {

// What is written: of isolines the value of each, by its source.
struct Paths {
  std::span<const Path> all;
  std::span<const double> values = {};

  [[nodiscard]] auto begin() const { return all.begin(); }
  [[nodiscard]] auto end() const { return all.end(); }
};

constexpr std::array<std::string_view, 5> path_suffixes = {".obj", ".ply", ".vtp", ".csv", ".json"};

std::size_t count_points(const Paths& paths) {
  std::size_t count = 0;
  for (const Path& path : paths) count += path.positions.size();
  return count;
}

void write_path_points(OutputFile& out, const Paths& paths, std::string_view before = "") {
  for (const Path& path : paths)
    for (const auto& p : path.positions) {
      out.write(before);
      out.write_row(p, " ");
      out.write("\n");
    }
}

void write_path_obj(OutputFile& out, const Paths& paths) {
  out.write("# geodesic paths by plexway\n");
  write_path_points(out, paths, "v ");
  std::size_t next = 1;
  for (const Path& path : paths) {
    if (path.positions.size() > 1) {
      out.write("l");
      for (std::size_t i = 0; i < path.positions.size(); ++i) out.write(" ", next + i);
      out.write("\n");
    }
    next += path.positions.size();
  }
}

void write_ply(OutputFile& out, const Paths& paths) {
  std::size_t edges = 0;
  for (const Path& path : paths) edges += path.positions.empty() ? 0 : path.positions.size() - 1;
  out.write("ply\nformat ascii 1.0\ncomment geodesic paths by plexway\nelement vertex " +
            std::to_string(count_points(paths)) +
            "\nproperty double x\nproperty double y\nproperty double z\nelement edge " +
            std::to_string(edges) + "\nproperty int vertex1\nproperty int vertex2\nend_header\n");
  write_path_points(out, paths);
  std::size_t next = 0;
  for (const Path& path : paths) {
    for (std::size_t i = 0; i + 1 < path.positions.size(); ++i)
      out.write(next + i, " ", next + i + 1, "\n");
    next += path.positions.size();
  }
}

void write_path_csv(OutputFile& out, const Paths& paths) {
  out.write(paths.values.empty() ? "path,x,y,z\n" : "path,x,y,z,value\n");
  for (std::size_t k = 0; k < paths.all.size(); ++k)
    for (const auto& p : paths.all[k].positions) {
      out.write(k, ",");
      out.write_row(p, ",");
      if (!paths.values.empty()) out.write(",", paths.values[paths.all[k].source]);
      out.write("\n");
    }
}

void write_vtp(OutputFile& out, const Paths& paths) {
  std::size_t lines = 0;
  for (const Path& path : paths) lines += !path.positions.empty();
  const auto begin = [&](const std::string& type, const std::string& name) {
    out.write("<DataArray type=\"", type, "\" Name=\"", name, "\" format=\"ascii\">\n");
  };
  const auto end = [&] { out.write("\n</DataArray>\n"); };
  // A number for each line.
  const auto array = [&](const std::string& type, const std::string& name, const auto& of_path) {
    begin(type, name);
    for (const Path& path : paths)
      if (!path.positions.empty()) out.write(of_path(path), " ");
    end();
  };
  out.write(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
      std::to_string(count_points(paths)) + "\" NumberOfVerts=\"0\" NumberOfLines=\"" +
      std::to_string(lines) + "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<Points>\n" +
      "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n");
  write_path_points(out, paths);
  out.write("</DataArray>\n</Points>\n<Lines>\n");
  begin("Int64", "connectivity");
  for (std::size_t i = 0, n = count_points(paths); i < n; ++i) out.write(i > 0 ? " " : "", i);
  end();
  std::size_t offset = 0;
  array("Int64", "offsets", [&](const Path& path) { return offset += path.positions.size(); });
  out.write("</Lines>\n<CellData Scalars=\"length\">\n");
  array("Float64", "length", [](const Path& path) { return path.length; });
  array("Int64", "source", [](const Path& path) { return std::int64_t{path.source}; });
  if (!paths.values.empty())
    array("Float64", "value", [&](const Path& path) { return paths.values[path.source]; });
  out.write("</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n");
}

void write_json(OutputFile& out, const Paths& paths) {
  out.write("{\"paths\": [");
  for (std::size_t k = 0; k < paths.all.size(); ++k) {
    const Path& path = paths.all[k];
    out.write(k == 0 ? "\n{" : ",\n{");
    const auto if_reached = [&](auto number) {
      std::isfinite(path.length) ? out.write(number) : out.write("null");
    };
    out.write("\"length\": ");
    if_reached(path.length);
    out.write(", \"source\": ");
    if_reached(path.source);
    if (!paths.values.empty()) out.write(", \"value\": ", paths.values[path.source]);
    out.write(", \"points\": [");
    for (std::size_t i = 0; i < path.points.size(); ++i) {
      out.write(i == 0 ? "{\"simplex\": " : ", {\"simplex\": ", path.points[i].simplex,
                ", \"barycentric\": [");
      out.write_row(path.points[i].barycentric, ", ");
      out.write("]}");
    }
    out.write("], \"positions\": [");
    for (std::size_t i = 0; i < path.positions.size(); ++i) {
      out.write(i == 0 ? "[" : ", [");
      out.write_row(path.positions[i], ", ");
      out.write("]");
    }
    out.write("]}");
  }
  out.write("\n]}\n");
}

using PathWriter = void (*)(OutputFile&, const Paths&);
constexpr std::array<PathWriter, 5> path_writers = {write_path_obj, write_ply, write_vtp,
                                                    write_path_csv, write_json};

void write_lines(const std::filesystem::path& file, const Paths& paths) {
  const std::string extension = lower_extension(file);
  const auto known = std::find(path_suffixes.begin(), path_suffixes.end(), extension);
  if (known == path_suffixes.end()) throw UsageError(unknown_extension(file, path_suffixes));
  for (const Path& path : paths)
    if (extension != ".json" && path.positions.size() != path.points.size())
      throw UsageError(file.string() +
                       ": the vertices have no positions; only .json can hold these paths");
  OutputFile out(file);
  path_writers[static_cast<std::size_t>(known - path_suffixes.begin())](out, paths);
  out.commit();
}

}  // namespace

std::span<const std::string_view> path_extensions() { return path_suffixes; }

void write_paths(const std::filesystem::path& file, std::span<const Path> paths) {
  write_lines(file, {paths});
}

void write_isolines(const std::filesystem::path& file, std::span<const Path> lines,
                    std::span<const double> values) {
  for (const Path& line : lines)
    if (line.source >= values.size())
      throw UsageError(file.string() + ": a line is of value " + std::to_string(line.source) +
                       ", and there are " + std::to_string(values.size()));
  write_lines(file, {lines, values});
}

}  // namespace plexway::io
