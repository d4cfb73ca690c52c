#include <plexway/pcl/files.hpp>

#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>

#include <plexway/common/ids.hpp>
#include <plexway/error.hpp>

#include "file/new_file.hpp"
#include "pcd_check.hpp"
#include "quiet.hpp"

namespace plexway::pcl {
namespace {

namespace fs = std::filesystem;
using ::pcl::PCLPointCloud2;
using ::pcl::PCLPointField;
using Row = std::array<double, 3>;

constexpr std::array<std::string_view, 2> extensions = {".pcd", ".ply"};

std::string lower_extension(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

std::string unknown_extension(const fs::path& file) {
  return file.string() + ": unknown extension; .pcd and .ply go through PCL";
}

std::string bytes_of(const fs::path& file) {
  const auto fail = [&](const std::string& cause) {
    throw InputError(file.string() + ": " + cause);
  };
  std::error_code ignored;
  const fs::file_status status = fs::status(file, ignored);
  if (status.type() == fs::file_type::not_found) fail("no such file");
  if (fs::is_directory(status)) fail("is a directory, not a file");
  // PCL maps files into memory, which pipes do not allow.
  if (!fs::is_regular_file(status)) fail("is not a file, as PCL wants one");
  std::ifstream in(file, std::ios::binary);
  std::string bytes(fs::file_size(file, ignored), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in || static_cast<std::size_t>(in.gcount()) != bytes.size()) fail("cannot be read");
  if (bytes.empty()) fail("is empty");
  return bytes;
}

/// The reader of PCL asks for as much memory as the header says.
void check_ply_count(std::string_view bytes, const std::string& name) {
  constexpr std::string_view word = "element vertex ";
  const std::string_view header = bytes.substr(0, bytes.find("end_header"));
  const auto at = header.find(word);
  if (!bytes.starts_with("ply") || at == header.npos || header.size() == bytes.size())
    throw InputError(name + ": is no PLY file with vertices");
  std::uint64_t count = 0;
  const char* const digits = header.data() + at + word.size();
  const auto result = std::from_chars(digits, header.data() + header.size(), count);
  if (result.ec != std::errc{} || count == 0 || count >= none || count > bytes.size())
    throw InputError(name +
                     ": the header's number of vertices is not that of this file, which has " +
                     std::to_string(bytes.size()) + " bytes");
}

template <class Number>
double number_at(const std::uint8_t* from) {
  Number value;
  std::memcpy(&value, from, sizeof value);
  return static_cast<double>(value);
}

double value_at(const std::uint8_t* from, std::uint8_t type) {
  switch (type) {
    case PCLPointField::INT8:
      return number_at<std::int8_t>(from);
    case PCLPointField::UINT8:
      return number_at<std::uint8_t>(from);
    case PCLPointField::INT16:
      return number_at<std::int16_t>(from);
    case PCLPointField::UINT16:
      return number_at<std::uint16_t>(from);
    case PCLPointField::INT32:
      return number_at<std::int32_t>(from);
    case PCLPointField::UINT32:
      return number_at<std::uint32_t>(from);
    case PCLPointField::INT64:
      return number_at<std::int64_t>(from);
    case PCLPointField::UINT64:
      return number_at<std::uint64_t>(from);
    case PCLPointField::FLOAT32:
      return number_at<float>(from);
    case PCLPointField::FLOAT64:
      return number_at<double>(from);
    default:
      return std::nan("");
  }
}

using Axes = std::array<const PCLPointField*, 3>;

std::optional<Axes> axes_named(const PCLPointCloud2& cloud,
                               const std::array<std::string_view, 3>& names) {
  Axes axes{};
  for (const PCLPointField& field : cloud.fields)
    for (std::size_t k = 0; k < 3; ++k)
      if (field.name == names[k]) axes[k] = &field;
  for (const PCLPointField* axis : axes) {
    if (axis == nullptr) return std::nullopt;
    const int size = ::pcl::getFieldSize(axis->datatype);
    if (size == 0 || axis->offset + static_cast<std::size_t>(size) > cloud.point_step)
      return std::nullopt;
  }
  return axes;
}

Row row_at(const PCLPointCloud2& cloud, std::size_t point, const Axes& axes) {
  Row row;
  for (std::size_t k = 0; k < 3; ++k)
    row[k] = value_at(&cloud.data[point * cloud.point_step + axes[k]->offset], axes[k]->datatype);
  return row;
}

bool finite(const Row& row) {
  return std::isfinite(row[0]) && std::isfinite(row[1]) && std::isfinite(row[2]);
}

FilePoints points_of(const PCLPointCloud2& cloud, const std::string& name) {
  const auto axes = axes_named(cloud, {"x", "y", "z"});
  const std::size_t count = std::size_t{cloud.width} * cloud.height;
  if (!axes || cloud.data.size() != count * cloud.point_step)
    throw InputError(name + ": has no points with x, y and z that PCL understands");
  const auto normal_axes = axes_named(cloud, {"normal_x", "normal_y", "normal_z"});
  FilePoints points;
  points.positions.reserve(count);
  if (normal_axes) points.normals.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Row position = row_at(cloud, i, *axes);
    if (!finite(position)) continue;
    points.positions.push_back(position);
    points.original.push_back(static_cast<Index>(i));
    if (!normal_axes) continue;
    const Row normal = row_at(cloud, i, *normal_axes);
    points.normals.push_back(finite(normal) ? normal : Row{0, 0, 0});
  }
  points.dropped = count - points.positions.size();
  if (points.dropped == 0) points.original = {};
  if (points.positions.empty())
    throw InputError(name + ": none of its " + std::to_string(count) + " points is finite");
  return points;
}

/// Single precision, as PCL's point types have it: fields in double are not read into them.
class CloudMaker {
 public:
  void add(const std::string& name, std::uint8_t type = PCLPointField::FLOAT32) {
    PCLPointField field;
    field.name = name;
    field.offset = cloud_.point_step;
    field.datatype = type;
    field.count = 1;
    cloud_.fields.push_back(field);
    cloud_.point_step += static_cast<std::uint32_t>(sizeof(float));
  }

  void start(std::size_t points) {
    cloud_.width = static_cast<std::uint32_t>(points);
    cloud_.height = 1;
    cloud_.row_step = cloud_.point_step * cloud_.width;
    cloud_.is_dense = true;
    cloud_.data.reserve(points * cloud_.point_step);
  }

  void put(double value) { put_bytes(static_cast<float>(value)); }
  void put_number(std::uint32_t value) { put_bytes(value); }

  const PCLPointCloud2& cloud() const { return cloud_; }

 private:
  template <class Number>
  void put_bytes(Number value) {
    static_assert(sizeof value == sizeof(float));
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(&value);
    cloud_.data.insert(cloud_.data.end(), bytes, bytes + sizeof value);
  }

  PCLPointCloud2 cloud_;
};

int write_with_pcl(const std::string& file, bool ply, const PCLPointCloud2& cloud, PcdForm form) {
  const Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  const Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();
  if (ply) return ::pcl::PLYWriter().writeBinary(file, cloud, origin, turn);
  ::pcl::PCDWriter writer;
  constexpr int digits = 9;  // so that single precision reads back the same
  switch (form) {
    case PcdForm::ascii:
      return writer.writeASCII(file, cloud, origin, turn, digits);
    case PcdForm::binary:
      return writer.writeBinary(file, cloud, origin, turn);
    default:
      return writer.writeBinaryCompressed(file, cloud, origin, turn);
  }
}

void write_cloud(const fs::path& file, const PCLPointCloud2& cloud, PcdForm form) {
  detail::file::NewFile out(file);
  int result = -1;
  std::string cause = "PCL failed to";
  try {
    const Quiet quiet;
    result = write_with_pcl(out.place(), lower_extension(file) == ".ply", cloud, form);
  } catch (const std::exception& from_pcl) {
    cause = from_pcl.what();
  }
  if (result != 0) out.refuse(cause);
  out.commit();
}

void check_writing(const char* who, const fs::path& file, std::size_t points) {
  const std::string extension = lower_extension(file);
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
    throw UsageError(unknown_extension(file));
  if (points == 0) throw UsageError(std::string(who) + ": no points");
  if (points >= none) throw UsageError(std::string(who) + ": more points than 32 bits count");
}

void require_length(const char* who, const char* what, std::size_t length, std::size_t points) {
  if (length != points)
    throw UsageError(std::string(who) + ": " + std::to_string(length) + " " + what + " for " +
                     std::to_string(points) + " points");
}

}  // namespace

std::span<const std::string_view> file_extensions() { return extensions; }

FilePoints read_points(const fs::path& file) {
  const std::string name = file.string();
  const std::string extension = lower_extension(file);
  const bool pcd = extension == ".pcd";
  if (!pcd && extension != ".ply") throw InputError(unknown_extension(file));
  std::size_t promised = 0;
  {
    const std::string bytes = bytes_of(file);
    if (pcd)
      promised = check_pcd(bytes, name).points;
    else
      check_ply_count(bytes, name);
  }
  PCLPointCloud2 cloud;
  int result = -1;
  try {
    const Quiet quiet;
    result = pcd ? ::pcl::PCDReader().read(name, cloud) : ::pcl::PLYReader().read(name, cloud);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(name + ": PCL cannot read it: " + error.what());
  }
  if (result != 0 || (pcd && std::size_t{cloud.width} * cloud.height != promised))
    throw InputError(name + ": PCL cannot read it: it is malformed or ends too soon");
  return points_of(cloud, name);
}

void write_points(const fs::path& file, std::span<const Row> positions,
                  std::span<const Row> normals, PcdForm form) {
  check_writing("write_points", file, positions.size());
  if (!normals.empty()) require_length("write_points", "normals", normals.size(), positions.size());
  CloudMaker maker;
  for (const char* axis : {"x", "y", "z"}) maker.add(axis);
  if (!normals.empty())
    for (const char* axis : {"normal_x", "normal_y", "normal_z"}) maker.add(axis);
  maker.start(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (const double c : positions[i]) maker.put(c);
    if (normals.empty()) continue;
    for (const double c : normals[i]) maker.put(c);
  }
  write_cloud(file, maker.cloud(), form);
}

void write_field(const fs::path& file, std::span<const Row> positions,
                 std::span<const double> distance, PcdForm form, std::span<const Index> original) {
  check_writing("write_field", file, positions.size());
  require_length("write_field", "distances", distance.size(), positions.size());
  if (!original.empty())
    require_length("write_field", "original numbers", original.size(), positions.size());
  CloudMaker maker;
  for (const char* name : {"x", "y", "z", "intensity"}) maker.add(name);
  if (!original.empty()) maker.add("original", PCLPointField::UINT32);
  maker.start(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (const double c : positions[i]) maker.put(c);
    maker.put(distance[i]);
    if (!original.empty()) maker.put_number(original[i]);
  }
  write_cloud(file, maker.cloud(), form);
}

}  // namespace plexway::pcl
