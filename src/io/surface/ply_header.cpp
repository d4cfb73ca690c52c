#include "io/surface/ply_body.hpp"

#include <optional>
#include <string>

#include "io/text_scanner.hpp"

namespace plexway::io {
namespace {

std::optional<PlyType> type_named(std::string_view word) {
  if (word == "char" || word == "int8") return PlyType::i8;
  if (word == "uchar" || word == "uint8") return PlyType::u8;
  if (word == "short" || word == "int16") return PlyType::i16;
  if (word == "ushort" || word == "uint16") return PlyType::u16;
  if (word == "int" || word == "int32") return PlyType::i32;
  if (word == "uint" || word == "uint32") return PlyType::u32;
  if (word == "float" || word == "float32") return PlyType::f32;
  if (word == "double" || word == "float64") return PlyType::f64;
  return std::nullopt;
}

PlyType read_type(TextScanner& scanner) {
  const auto word = scanner.field();
  const auto type = type_named(word);
  if (!type) scanner.fail("unknown property type " + quote(word));
  return *type;
}

PlyFormat read_format(TextScanner& scanner) {
  const auto word = scanner.field();
  PlyFormat format = PlyFormat::ascii;
  if (word == "binary_little_endian")
    format = PlyFormat::little_endian;
  else if (word == "binary_big_endian")
    format = PlyFormat::big_endian;
  else if (word != "ascii")
    scanner.fail("unknown format " + quote(word));
  const auto version = scanner.field();
  if (version != "1.0") scanner.fail("unknown version " + quote(version) + "; 1.0 is read");
  return format;
}

PlyElement read_element(TextScanner& scanner, const std::vector<PlyElement>& before) {
  PlyElement element;
  element.name = scanner.field();
  element.line = scanner.line();
  for (const auto& other : before)
    if (other.name == element.name) scanner.fail("a second element " + quote(element.name));
  const std::int64_t count = scanner.integer("the number of " + quote(element.name) + " elements");
  if (count < 0)
    scanner.fail("the number of " + quote(element.name) +
                 " elements is negative: " + std::to_string(count));
  element.count = static_cast<std::uint64_t>(count);
  return element;
}

PlyProperty read_property(TextScanner& scanner, const PlyElement& element) {
  PlyProperty property{};
  const auto word = scanner.field();
  if (word == "list") {
    property.is_list = true;
    property.count_type = read_type(scanner);
    if (is_float(property.count_type)) scanner.fail("a list's length must be of a whole type");
    property.type = read_type(scanner);
  } else {
    const auto type = type_named(word);
    if (!type) scanner.fail("unknown property type " + quote(word));
    property.type = *type;
  }
  property.name = scanner.field();
  if (property.name.empty()) scanner.fail("a property without a name");
  for (const auto& other : element.properties)
    if (other.name == property.name) scanner.fail("a second property " + quote(property.name));
  return property;
}

}  // namespace

PlyHeader parse_ply_header(std::string_view bytes, std::string_view name) {
  TextScanner scanner(bytes, name);
  PlyHeader header;
  if (const auto word = scanner.field(); word != "ply")
    scanner.fail("expected 'ply', found " + quote(word));
  bool has_format = false;
  while (scanner.next_line()) {
    const auto word = scanner.field();
    if (word == "end_header") {
      if (!has_format) scanner.fail("the header has no format line");
      if (!scanner.next_line()) scanner.fail("the file ends with its header");
      header.size = static_cast<std::size_t>(scanner.position() - bytes.data());
      header.lines = scanner.line() - 1;
      return header;
    }
    if (word == "format") {
      header.format = read_format(scanner);
      has_format = true;
    } else if (word == "element") {
      header.elements.push_back(read_element(scanner, header.elements));
    } else if (word == "property") {
      if (header.elements.empty()) scanner.fail("a property before the first element");
      auto& element = header.elements.back();
      element.properties.push_back(read_property(scanner, element));
    } else if (!word.empty() && word != "comment" && word != "obj_info") {
      scanner.fail("unknown word " + quote(word) + " in the header");
    }
  }
  scanner.fail("the file ends before 'end_header'");
}

}  // namespace plexway::io
