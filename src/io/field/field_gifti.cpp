// GIfTI without a surface: an array of numbers for each vertex, as what shows a surface beside it
// takes them. https://www.nitrc.org/projects/gifti: GIFTI Surface Data Format, version 1.0.

#include <string>
#include <string_view>

#include "io/base64.hpp"
#include "io/field/field_formats.hpp"
#include "io/numbers.hpp"

namespace plexway::io {
namespace {

// The format has three types, two of them of whole numbers. One program alone reads any other.
template <class Numbers>
void write_map(OutputFile& out, std::string_view name, const Numbers& numbers) {
  std::string bytes;
  bytes.reserve(4 * numbers.size());
  for (const auto number : numbers)
    for (const char byte : little_endian(static_cast<float>(number))) bytes += byte;
  out.write(
      "<DataArray Intent=\"NIFTI_INTENT_SHAPE\" DataType=\"NIFTI_TYPE_FLOAT32\" "
      "ArrayIndexingOrder=\"RowMajorOrder\" Dimensionality=\"1\" Dim0=\"",
      numbers.size(),
      "\" Encoding=\"Base64Binary\" Endian=\"LittleEndian\" ExternalFileName=\"\" "
      "ExternalFileOffset=\"\">\n<MetaData><MD><Name><![CDATA[Name]]></Name><Value><![CDATA[",
      name, "]]></Value></MD></MetaData>\n<Data>", encode_base64(bytes), "</Data>\n</DataArray>\n");
}

}  // namespace

void write_gifti(OutputFile& out, const Field& field) {
  std::size_t maps = 1;
  field.each_more([&](std::string_view, const auto&) { ++maps; });
  out.write(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!DOCTYPE GIFTI SYSTEM "
      "\"http://www.nitrc.org/frs/download.php/115/gifti.dtd\">\n<GIFTI Version=\"1.0\" "
      "NumberOfDataArrays=\"",
      maps, "\">\n<MetaData/>\n<LabelTable/>\n");
  write_map(out, "distance", field.distance);
  field.each_more(
      [&](std::string_view name, const auto& numbers) { write_map(out, name, numbers); });
  out.write("</GIFTI>\n");
}

}  // namespace plexway::io
