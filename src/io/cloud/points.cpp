#include <plexway/io/points.hpp>

#include <plexway/error.hpp>

#include <array>
#include <cmath>
#include <filesystem>
#include <string>

#include "io/names.hpp"
#include "io/output_file.hpp"
#include "io/readers.hpp"

namespace plexway::io {
namespace {

namespace fs = std::filesystem;
constexpr std::array<std::string_view, 2> output_extensions = {".xyz", ".ply"};

void require_sound_points(const Points& points) {
  const auto fail = [](const std::string& cause) { throw UsageError("write_points: " + cause); };
  if (!points.normals.empty() && points.normals.size() != points.positions.size())
    fail(std::to_string(points.normals.size()) + " normals for " +
         std::to_string(points.positions.size()) + " points");
  for (const auto* rows : {&points.positions, &points.normals})
    for (std::size_t i = 0; i < rows->size(); ++i)
      for (const double c : (*rows)[i])
        if (!std::isfinite(c)) fail("point " + std::to_string(i) + " is not finite");
}

void write_xyz(OutputFile& out, const Points& points) {
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    out.write_row(points.positions[i], " ");
    if (!points.normals.empty()) out.write(" "), out.write_row(points.normals[i], " ");
    out.write("\n");
  }
}

void write_ply_cloud(OutputFile& out, const Points& points) {
  out.write("ply\nformat binary_little_endian 1.0\ncomment points by plexway\nelement vertex " +
            std::to_string(points.positions.size()) +
            "\nproperty double x\nproperty double y\nproperty double z\n");
  if (!points.normals.empty())
    out.write("property double nx\nproperty double ny\nproperty double nz\n");
  out.write("end_header\n");
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    for (const double c : points.positions[i]) out.write_binary(c);
    if (points.normals.empty()) continue;
    for (const double c : points.normals[i]) out.write_binary(c);
  }
}

}  // namespace

void refuse_pcd(std::string_view extension, const std::string& name) {
  if (extension == ".pcd")
    throw NotBuiltError(name +
                        ": .pcd goes through PCL: see plexway/pcl/files.hpp, component pcl, which "
                        "needs libpcl-dev; without it, .ply and .xyz");
}

std::span<const std::string_view> point_output_extensions() { return output_extensions; }

void write_points(const fs::path& file, const Points& points) {
  const std::string extension = lower_extension(file);
  refuse_pcd(extension, file.string());
  const bool text = extension == output_extensions[0];
  if (!text && extension != output_extensions[1])
    throw UsageError(unknown_extension(file, output_extensions));
  require_sound_points(points);
  OutputFile out(file);
  if (text)
    write_xyz(out, points);
  else
    write_ply_cloud(out, points);
  out.commit();
}

}  // namespace plexway::io
