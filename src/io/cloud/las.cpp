// LAS 1.0 to 1.4: points of laser scanners, whole numbers times a scale. Source: ASPRS, LAS
// Specification 1.4 - R15, 2019.

#include <cmath>
#include <string>

#include "io/numbers.hpp"
#include "io/readers.hpp"
#include "io/surface/polygons.hpp"

namespace plexway::io {
namespace {

// Where the header has what.
constexpr std::size_t minor_at = 25, header_at = 94, data_at = 96, format_at = 104, length_at = 105,
                      count_at = 107, scale_at = 131, shift_at = 155, long_count_at = 247,
                      least_header = 227, header_1_4 = 375;

}  // namespace

Points parse_las(std::string_view bytes, std::string_view name) {
  const auto fail = [&](const std::string& cause) {
    throw InputError(std::string(name) + ": " + cause);
  };
  const auto at = [&]<class Number>(Number, std::size_t place) {
    return load<Number>(bytes.data() + place, std::endian::little);
  };
  if (!bytes.starts_with("LASF")) fail("is no .las: it does not begin with LASF");
  if (bytes.size() < least_header) fail("ends inside its header");
  const int major = bytes[minor_at - 1], minor = bytes[minor_at];
  if (major != 1 || minor < 0 || minor > 4)
    fail("is of version " + std::to_string(major) + "." + std::to_string(minor) +
         " of LAS; 1.0 to 1.4 are read");
  const auto format = static_cast<unsigned char>(bytes[format_at]);
  if (format >= 128)
    fail("is packed (.laz), which is not read; unpack it, with 'pdal translate' or laszip");
  constexpr std::size_t least_length[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  if (format > 10) fail("has points of format " + std::to_string(format) + "; 0 to 10 are read");
  const std::size_t length = at(std::uint16_t{}, length_at);
  if (length < least_length[format])
    fail("has points of " + std::to_string(length) + " bytes, which format " +
         std::to_string(format) + " does not fit into");
  std::uint64_t count = at(std::uint32_t{}, count_at);
  if (minor == 4 && at(std::uint16_t{}, header_at) >= header_1_4 && bytes.size() >= header_1_4)
    count = at(std::uint64_t{}, long_count_at);
  const std::size_t from = at(std::uint32_t{}, data_at);
  if (count == 0) fail("has no points; a cloud needs at least one");
  if (from < least_header || from > bytes.size() || count > (bytes.size() - from) / length)
    fail("should have " + std::to_string(count) + " points of " + std::to_string(length) +
         " bytes, but only " + std::to_string(from > bytes.size() ? 0 : bytes.size() - from) +
         " bytes follow");
  if (count >= most_vertices) fail("more points than 32 bits count");
  std::array<double, 3> scale{}, shift{};
  for (std::size_t k = 0; k < 3; ++k) {
    scale[k] = at(double{}, scale_at + 8 * k);
    shift[k] = at(double{}, shift_at + 8 * k);
    if (!std::isfinite(scale[k]) || !std::isfinite(shift[k]) || scale[k] == 0)
      fail("has a scale or an offset that is no number to use");
  }
  Points points;
  points.positions.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::size_t record = from + i * length;
    // Withheld is their word for deleted.
    const auto flags = static_cast<unsigned char>(bytes[record + 15]);
    if (format < 6 ? (flags & 0x80) != 0 : (flags & 0x04) != 0) continue;
    std::array<double, 3> p{};
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = scale[k] * at(std::int32_t{}, record + 4 * k) + shift[k];
    for (const double c : p)
      if (!std::isfinite(c))
        fail("point " + std::to_string(i) + " has a coordinate that is not finite");
    points.positions.push_back(p);
    points.original.push_back(static_cast<std::uint32_t>(i));
  }
  if (points.positions.empty()) fail("has no points but withheld ones");
  if (points.positions.size() == count) points.original.clear();
  return points;
}

}  // namespace plexway::io
