// GIfTI, the XML of surfaces in neuroscience: arrays of numbers, each with what it is (Intent), how
// it is written (Encoding) and in which order.
// https://www.nitrc.org/projects/gifti: GIFTI Surface Data Format, version 1.0.

#include <string>

#include <plexway/error.hpp>

#include "io/file_bytes.hpp"
#include "io/names.hpp"
#include "io/readers.hpp"
#include "io/surface/polygons.hpp"

#if PLEXWAY_IO_PUGIXML
#include <pugixml.hpp>

#include <array>
#include <bit>
#include <cmath>

#include "io/base64.hpp"
#include "io/field/value_source.hpp"

namespace plexway::io {
namespace {

class GiftiReader {
 public:
  GiftiReader(std::string_view bytes, std::string_view name) : name_(name) {
    const pugi::xml_parse_result result =
        document_.load_buffer(bytes.data(), bytes.size(), pugi::parse_default & ~pugi::parse_eol);
    if (!result) fail(std::string("is not whole XML: ") + result.description());
    root_ = document_.child("GIFTI");
    if (!root_) fail("is no GIfTI file: it has no element GIFTI");
  }

  Triangles surface() const {
    Triangles surface;
    const pugi::xml_node points = array("NIFTI_INTENT_POINTSET"),
                         faces = array("NIFTI_INTENT_TRIANGLE");
    if (!points || !faces) fail("has no points and triangles: a surface (.surf.gii) has both");
    each_row<3>(points, [&](const std::array<double, 3>& p) { surface.positions.push_back(p); });
    each_row<3>(faces, [&](const std::array<double, 3>& corners) {
      std::array<std::uint32_t, 3> face;
      for (std::size_t i = 0; i < 3; ++i) {
        const double corner = corners[i];
        constexpr double most = 9e15;  // beyond, doubles skip whole numbers
        if (!(std::abs(corner) < most && corner == std::floor(corner)))
          fail("triangle " + std::to_string(surface.triangles.size()) +
               " has a corner that is not the number of a vertex");
        if (!(corner >= 0 && corner < static_cast<double>(surface.positions.size())))
          fail(bad_corner("face", std::ssize(surface.triangles), static_cast<std::int64_t>(corner),
                          surface.positions.size()));
        face[i] = static_cast<std::uint32_t>(corner);
      }
      surface.triangles.push_back(face);
    });
    require_faces(surface, name_);
    return surface;
  }

  std::vector<std::int32_t> labels() const {
    const pugi::xml_node first = root_.child("DataArray");
    if (!first) fail("has no array");
    std::vector<std::int32_t> labels;
    each_row<1>(first, [&](const std::array<double, 1>& label) {
      if (label[0] != std::floor(label[0]) || std::abs(label[0]) > 2147483647)
        fail("label " + std::to_string(labels.size()) + " is not a whole number of 32 bits");
      labels.push_back(static_cast<std::int32_t>(label[0]));
    });
    return labels;
  }

 private:
  [[noreturn]] void fail(const std::string& cause) const {
    throw InputError(std::string(name_) + ": " + cause);
  }

  pugi::xml_node array(const char* intent) const {
    return root_.find_child_by_attribute("DataArray", "Intent", intent);
  }

  NumberType type_of(pugi::xml_node array) const {
    const std::string_view type = array.attribute("DataType").value();
    if (type == "NIFTI_TYPE_FLOAT32") return NumberType::f32;
    if (type == "NIFTI_TYPE_FLOAT64") return NumberType::f64;
    if (type == "NIFTI_TYPE_INT32") return NumberType::i32;
    if (type == "NIFTI_TYPE_UINT32") return NumberType::u32;
    if (type == "NIFTI_TYPE_INT16") return NumberType::i16;
    if (type == "NIFTI_TYPE_UINT8") return NumberType::u8;
    fail("numbers of type " + quote(type) + " are not read");
  }

  std::uint64_t size_of_dimension(pugi::xml_node array, const char* attribute) const {
    const std::string_view text = array.attribute(attribute).value();
    std::uint64_t value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || rest != text.data() + text.size() || value > most_vertices)
      fail(std::string(attribute) + " is " + quote(text) + ", not a number of rows or columns");
    return value;
  }

  // All numbers in the order of the file, as bytes of the array's own type.
  std::string unpacked(pugi::xml_node array, std::uint64_t bytes) const {
    const std::string_view encoding = array.attribute("Encoding").value();
    const std::string_view text = array.child("Data").child_value();
    std::string data;
    if (!decode_base64(text, data)) fail("an array is not whole base64");
    if (encoding == "GZipBase64Binary")
      data = inflated(data, Deflated::zlib, bytes, std::string(name_) + ": an array");
    if (data.size() != bytes)
      fail("an array has " + std::to_string(data.size()) + " bytes where its dimensions ask for " +
           std::to_string(bytes));
    return data;
  }

  template <std::size_t N, class Visit>
  void each_row(pugi::xml_node array, const Visit& visit) const {
    const std::uint64_t rows = size_of_dimension(array, "Dim0");
    const std::uint64_t dimensions = size_of_dimension(array, "Dimensionality");
    const std::uint64_t columns = dimensions > 1 ? size_of_dimension(array, "Dim1") : 1;
    if (columns != N || dimensions > 2)
      fail("an array has " + std::to_string(columns) + " columns, not " + std::to_string(N));
    const std::string_view encoding = array.attribute("Encoding").value();
    const NumberType type = type_of(array);
    const bool by_columns =
        std::string_view(array.attribute("ArrayIndexingOrder").value()) == "ColumnMajorOrder";
    std::vector<double> numbers;
    if (encoding == "ASCII") {
      TextScanner in = TextScanner::of_value(array.child("Data").child_value(), name_);
      while (in.to_content() && numbers.size() <= rows * N)
        numbers.push_back(in.number("a number of an array"));
      if (numbers.size() != rows * N)
        fail("an array has not the " + std::to_string(rows * N) + " numbers it should");
    } else if (encoding == "Base64Binary" || encoding == "GZipBase64Binary") {
      const std::string bytes = unpacked(array, rows * N * size_of(type));
      const bool big = std::string_view(array.attribute("Endian").value()) == "BigEndian";
      const std::string where = std::string(name_) + ": an array";
      ByteValues in(bytes, where, big ? std::endian::big : std::endian::little);
      numbers.reserve(rows * N);
      for (std::uint64_t i = 0; i < rows * N; ++i)
        numbers.push_back(in.real(type, "a number of an array"));
    } else {
      fail("arrays written as " + quote(encoding) + " are not read: save it with its data inside");
    }
    for (std::uint64_t r = 0; r < rows; ++r) {
      std::array<double, N> row;
      for (std::size_t i = 0; i < N; ++i) row[i] = numbers[by_columns ? i * rows + r : r * N + i];
      visit(row);
    }
  }

  std::string_view name_;
  pugi::xml_document document_;
  pugi::xml_node root_;
};

}  // namespace

Triangles parse_gifti(std::string_view bytes, std::string_view name) {
  return GiftiReader(bytes, name).surface();
}

std::vector<std::int32_t> read_gifti_labels(const std::filesystem::path& file) {
  const FileBytes bytes(file);
  return GiftiReader(bytes.view(), file.string()).labels();
}

}  // namespace plexway::io

#else

namespace plexway::io {
namespace {

[[noreturn]] void not_built() {
  throw NotBuiltError(
      "this plexway reads no GIfTI: install libpugixml-dev and build it again, or save the surface "
      "as .ply");
}

}  // namespace

Triangles parse_gifti(std::string_view, std::string_view) { not_built(); }
std::vector<std::int32_t> read_gifti_labels(const std::filesystem::path&) { not_built(); }

}  // namespace plexway::io

#endif
