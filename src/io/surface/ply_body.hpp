#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "io/numbers.hpp"

namespace plexway::io {

enum class PlyFormat { ascii, little_endian, big_endian };
using PlyType = NumberType;  // all but the 64-bit whole numbers

struct PlyProperty {
  std::string_view name;
  PlyType type;  ///< of the value, or of the list's items
  bool is_list = false;
  PlyType count_type = PlyType::u8;  ///< lists only
};

struct PlyElement {
  std::string_view name;
  std::uint64_t count = 0;  ///< as the header says; not yet checked against the data
  std::size_t line = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  ///< bytes, up to where the data starts
  std::size_t lines = 0;
};

/// Reads the header at the front of `bytes`; the names in it point into `bytes`. Throws InputError.
PlyHeader parse_ply_header(std::string_view bytes, std::string_view name);

}  // namespace plexway::io

// The body of a PLY file, value by value, from one of two sources, text or bytes, which look the
// same to a reader; and the walk over its elements.

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include <plexway/error.hpp>

#include "io/numbers.hpp"
#include "io/surface/polygons.hpp"
#include "io/text_scanner.hpp"

namespace plexway::io {

/// The body as text, one instance of an element a line.
class PlyText {
 public:
  PlyText(std::string_view bytes, std::string_view name, const PlyHeader& header)
      : scanner_(bytes.substr(header.size), name, TextScanner::Backslash::ordinary,
                 header.lines + 1) {}

  [[noreturn]] void fail(const std::string& cause) const { scanner_.fail(cause); }
  std::uint64_t bytes_left() const { return scanner_.bytes_left(); }

  /// Each value takes a character and a separator; the last needs no separator.
  std::uint64_t most_instances(const PlyElement& element) const {
    return (scanner_.bytes_left() + 1) / (2 * element.properties.size());
  }

  void begin(const PlyElement& element, std::uint64_t instance) {
    if (!scanner_.to_content())
      scanner_.fail("the file ends after " + std::to_string(instance) + " of " +
                    std::to_string(element.count) + " " + quote(element.name) + " elements");
  }

  void end(const PlyElement& element) {
    if (scanner_.to_field())
      scanner_.fail("the line goes on after the last property of " + quote(element.name) +
                    " with " + quote(scanner_.field()));
    scanner_.next_line();
  }

  double real(PlyType, std::string_view what) { return scanner_.number(what); }

  std::int64_t whole(PlyType type, std::string_view what) {
    if (!is_float(type)) return scanner_.integer(what);
    const double value = scanner_.number(what);
    if (value != std::floor(value) || std::abs(value) > 9e15)
      scanner_.fail(std::string(what) + " is not a whole number");
    return static_cast<std::int64_t>(value);
  }

  void skip(PlyType, std::uint64_t values, std::string_view what) {
    for (; values != 0; --values)
      if (scanner_.field().empty()) scanner_.fail("the line ends before " + std::string(what));
  }

  void finish() {
    if (scanner_.to_content())
      scanner_.fail("the file goes on after its last element with " + quote(scanner_.field()));
  }

 private:
  TextScanner scanner_;
};

/// What may follow the last element.
inline constexpr std::string_view ply_padding{"\n\r \0", 4};

/// The body as bytes.
class PlyBytes : public BinaryNumbers<PlyBytes> {
 public:
  PlyBytes(std::string_view bytes, std::string_view name, const PlyHeader& header)
      : BinaryNumbers(
            bytes, header.format == PlyFormat::big_endian ? std::endian::big : std::endian::little,
            header.size),
        name_(name) {}

  [[noreturn]] void fail(const std::string& cause) const {
    std::string where = "byte " + std::to_string(at_);
    if (element_ != nullptr)
      where = quote(element_->name) + " element " + std::to_string(instance_) + ", " + where;
    throw InputError(std::string(name_) + ": " + where + ": " + cause);
  }

  std::uint64_t most_instances(const PlyElement& element) const {
    std::uint64_t least = 0;  // bytes of an instance whose lists are empty
    for (const auto& p : element.properties) least += size_of(p.is_list ? p.count_type : p.type);
    return bytes_left() / least;
  }

  void begin(const PlyElement& element, std::uint64_t instance) {
    element_ = &element;
    instance_ = instance;
  }
  void end(const PlyElement&) { element_ = nullptr; }

  void finish() {
    for (std::size_t i = at_; i < bytes_.size(); ++i)
      if (ply_padding.find(bytes_[i]) == ply_padding.npos)
        fail("the file goes on after its last element");
  }

 private:
  std::string_view name_;
  const PlyElement* element_ = nullptr;
  std::uint64_t instance_ = 0;
};

/// The property of that name, or null.
inline const PlyProperty* find_property(const PlyElement& element, std::string_view name) {
  for (const auto& property : element.properties)
    if (property.name == name) return &property;
  return nullptr;
}

[[noreturn]] inline void fail_ply_header(std::string_view name, std::size_t line,
                                         const std::string& cause) {
  throw InputError(std::string(name) + ":" + std::to_string(line) + ": " + cause);
}

/// Three numbers of an element, such as coordinates; `names` are for messages.
struct PlyTriple {
  std::array<const PlyProperty*, 3> axes{};
  const std::string_view* names = axis_names;

  /// Takes the property into `triple` if it is one of them.
  template <class Source>
  bool take(Source& source, const PlyProperty& property, std::array<double, 3>& triple) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (&property != axes[k]) continue;
      triple[k] = source.real(property.type, names[k]);
      return true;
    }
    return false;
  }
};

/// The element 'vertex' of a header and its coordinates, checked.
struct PlyVertex : PlyTriple {
  const PlyElement* element = nullptr;

  PlyVertex(const PlyHeader& header, std::string_view name) {
    for (const auto& other : header.elements)
      if (other.name == "vertex") element = &other;
    if (element == nullptr)
      fail_ply_header(name, header.lines, "the header has no element 'vertex'");
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string_view axis = std::string_view("xyz").substr(k, 1);
      axes[k] = find_property(*element, axis);
      if (axes[k] == nullptr || axes[k]->is_list)
        fail_ply_header(name, element->line, "element 'vertex' has no number " + quote(axis));
    }
    if (element->count >= most_vertices)
      fail_ply_header(name, element->line, "more vertices than 32 bits count");
  }
};

/// The element of that name and its list of vertices, if the header has it.
struct PlyCorners {
  const PlyElement* element = nullptr;
  const PlyProperty* list = nullptr;

  PlyCorners(const PlyHeader& header, std::string_view called, std::string_view name) {
    for (const auto& other : header.elements)
      if (other.name == called) element = &other;
    if (element == nullptr) return;
    list = find_property(*element, "vertex_indices");
    if (list == nullptr) list = find_property(*element, "vertex_index");
    if (list == nullptr || !list->is_list)
      fail_ply_header(name, element->line,
                      "element " + quote(called) +
                          " has no list 'vertex_indices' or "
                          "'vertex_index'");
  }
};

inline constexpr std::string_view last_property = "the last property";

template <class Source>
void skip_property(Source& source, const PlyProperty& property) {
  if (!property.is_list) return source.skip(property.type, 1, last_property);
  const std::int64_t length = source.whole(property.count_type, "a list's length");
  if (length < 0) source.fail("a list's length is negative: " + std::to_string(length));
  source.skip(property.type, static_cast<std::uint64_t>(length), last_property);
}

/// Walks over all elements. `begin(element)` is called for each whose count its bytes can hold, and
/// `read(element, i, property)` is called for every property of instance i: it takes the value and
/// says true, or leaves it and says false.
template <class Source, class Begin, class Read>
void walk_ply(Source& source, const PlyHeader& header, Begin begin, Read read) {
  for (const auto& element : header.elements) {
    if (element.properties.empty()) continue;  // takes no room in the file, however many there are
    if (element.count > source.most_instances(element))
      source.fail("the header says " + std::to_string(element.count) + " " + quote(element.name) +
                  " elements, but only " + std::to_string(source.bytes_left()) + " bytes follow");
    begin(element);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      source.begin(element, i);
      for (const auto& property : element.properties)
        if (!read(element, i, property)) skip_property(source, property);
      source.end(element);
    }
  }
  source.finish();
}

}  // namespace plexway::io
