// Gmsh's .msh, versions 2 and 4.1, ascii and binary. https://gmsh.info/doc/texinfo/gmsh.html,
// sections "MSH file format" and "MSH file format version 2 (Legacy)".

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "io/field/value_source.hpp"
#include "io/readers.hpp"
#include "io/solid/cells.hpp"

namespace plexway::io {
namespace {

/// The numbers a file gives its vertices, to be looked up. Those that count on from the first, as
/// nearly all do, take no search.
class NodeTags {
 public:
  void reserve(std::size_t count) { tags_.reserve(count); }
  void add(std::int64_t tag) { tags_.push_back(tag); }
  std::size_t size() const { return tags_.size(); }

  /// To be called when all are added; a tag that occurs twice, if there is one.
  std::optional<std::int64_t> finish() {
    consecutive_ = true;
    for (std::size_t i = 1; i < tags_.size() && consecutive_; ++i)
      consecutive_ = tags_[i] > tags_[i - 1] && tags_[i] - 1 == tags_[i - 1];
    if (consecutive_) return std::nullopt;
    order_.resize(tags_.size());
    std::iota(order_.begin(), order_.end(), 0U);
    const auto tag = [&](std::uint32_t i) { return tags_[i]; };
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return tag(a) < tag(b); });
    for (std::size_t i = 1; i < order_.size(); ++i)
      if (tag(order_[i]) == tag(order_[i - 1])) return tag(order_[i]);
    return std::nullopt;
  }

  /// The place of the vertex with this tag in the file.
  std::optional<std::uint32_t> find(std::int64_t tag) const {
    if (tags_.empty()) return std::nullopt;
    if (consecutive_) {
      if (tag < tags_.front() || tag > tags_.back()) return std::nullopt;
      return static_cast<std::uint32_t>(tag - tags_.front());
    }
    const auto at =
        std::lower_bound(order_.begin(), order_.end(), tag,
                         [&](std::uint32_t i, std::int64_t value) { return tags_[i] < value; });
    if (at == order_.end() || tags_[*at] != tag) return std::nullopt;
    return *at;
  }

 private:
  std::vector<std::int64_t> tags_;
  std::vector<std::uint32_t> order_;  ///< sorted by tag; empty when consecutive
  bool consecutive_ = false;
};

using enum NumberType;

/// What stands between $MeshFormat and $EndMeshFormat.
struct Format {
  double version = 0;
  bool binary = false;
};

/// The sections behind the header, `Source` being TextValues or ByteValues.
template <class Source>
class GmshReader {
 public:
  /// `regions`: where those of the cells go, if they are wanted.
  GmshReader(Source in, std::string_view name, Regions* regions)
      : in_(in), name_(name), regions_(regions) {}

  Mixed read(bool version4) {
    while (!(has_nodes_ && has_elements_)) {
      const std::string_view section = in_.word();
      if (section == "$Nodes") {
        if (has_nodes_) in_.fail("a second section $Nodes");
        version4 ? nodes4() : nodes2();
        end_section("$EndNodes");
        if (const auto twice = tags_.finish())
          in_.fail("two nodes have the tag " + std::to_string(*twice));
        has_nodes_ = true;
      } else if (section == "$Elements") {
        if (!has_nodes_) in_.fail("$Elements comes before $Nodes");
        version4 ? elements4() : elements2();
        end_section("$EndElements");
        has_elements_ = true;
      } else if (section == "$Entities" && regions_ != nullptr && version4) {
        entities4();
        end_section("$EndEntities");
      } else if (section == "$ParametricNodes") {
        in_.fail("$ParametricNodes are not read; save the file without parametric coordinates");
      } else if (section.empty()) {
        in_.fail(std::string("the file ends before its section ") +
                 (has_nodes_ ? "$Elements" : "$Nodes"));
      } else if (section[0] == '$' && !section.starts_with("$End")) {
        in_.skip_past("$End" + std::string(section.substr(1)));
      } else {
        in_.fail("expected a section, found " + quote(section));
      }
    }
    taker_.finish(name_);
    return std::move(solid_);
  }

 private:
  void end_section(std::string_view end) {
    if (const auto word = in_.word(); word != end)
      in_.fail("expected " + std::string(end) + ", found " +
               (word.empty() ? "the end of the file" : quote(word)));
  }

  std::uint64_t count(std::int64_t stated, std::string_view what, NumberType type,
                      std::uint64_t values) {
    return checked_count(in_, stated, what, type, values);
  }

  void position() {
    std::array<double, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = in_.real(f64, axis_names[k]);
    solid_.positions.push_back(p);
  }

  void require_few(std::uint64_t nodes) {
    if (nodes >= most_vertices) in_.fail("more nodes than 32 bits count");
  }

  void nodes2() {
    // A node takes three doubles and a tag, 28 bytes; in text four values.
    const std::uint64_t nodes = count(in_.text_whole("the number of nodes"), "nodes", i32, 4);
    require_few(nodes);
    in_.end_line();
    solid_.positions.reserve(nodes);
    tags_.reserve(nodes);
    for (std::uint64_t i = 0; i < nodes; ++i) {
      tags_.add(in_.whole(i32, "the node's tag"));
      position();
      in_.end_item();
    }
  }

  void nodes4() {
    in_.end_line();
    const std::int64_t blocks = in_.whole(u64, "the number of blocks");
    const std::uint64_t nodes = count(in_.whole(u64, "the number of nodes"), "nodes", u64, 4);
    require_few(nodes);
    in_.skip(u64, 2, "the least and the largest tag");
    solid_.positions.reserve(nodes);
    tags_.reserve(nodes);
    for (std::int64_t b = 0; b < blocks; ++b) {
      const std::int64_t dimension = in_.whole(i32, "the entity's dimension");
      in_.skip(i32, 1, "the entity's tag");
      const bool parametric = in_.whole(i32, "whether nodes are parametric") != 0;
      if (dimension < 0 || dimension > 3)
        in_.fail("an entity's dimension is " + std::to_string(dimension));
      const std::uint64_t here =
          count(in_.whole(u64, "the number of nodes of the block"), "nodes in a block", u64, 4);
      if (here > nodes - tags_.size()) more_than("nodes", nodes);
      for (std::uint64_t i = 0; i < here; ++i) tags_.add(in_.whole(u64, "the node's tag"));
      for (std::uint64_t i = 0; i < here; ++i) {
        position();
        if (parametric)
          in_.skip(f64, static_cast<std::uint64_t>(dimension), "the node's parameters");
        in_.end_item();
      }
    }
    if (tags_.size() != nodes) fewer_than("nodes", tags_.size(), nodes);
  }

  // Physical groups belong to the entities that elements are on.
  void entities4() {
    in_.end_line();
    std::array<std::uint64_t, 4> entities{};
    for (std::uint64_t& n : entities)
      n = count(in_.whole(u64, "the number of entities"), "entities", u64, 1);
    for (std::int64_t dimension = 0; dimension < 4; ++dimension)
      for (std::uint64_t i = 0; i < entities[static_cast<std::size_t>(dimension)]; ++i) {
        const std::int64_t tag = in_.whole(i32, "the entity's tag");
        in_.skip(f64, dimension == 0 ? 3 : 6, "the entity's place");
        const std::uint64_t groups =
            count(in_.whole(u64, "the number of physical groups"), "physical groups", i32, 1);
        if (groups > 0) {
          groups_[{dimension, tag}] = in_.whole(i32, "the physical group");
          in_.skip(i32, groups - 1, "the physical group");
        }
        if (dimension == 0) continue;
        const std::uint64_t parts =
            count(in_.whole(u64, "the number of parts of its boundary"), "parts", i32, 1);
        in_.skip(i32, parts, "a part of the entity's boundary");
      }
  }

  void elements2() {
    const std::uint64_t elements =
        count(in_.text_whole("the number of elements"), "elements", i32, 1);
    in_.end_line();
    for (std::uint64_t i = 0; i < elements;) {
      if constexpr (Source::is_text) {
        const std::int64_t number = in_.whole(i32, "the element's number");
        const CellType type = gmsh_cell_type(in_.whole(i32, "the element's type"));
        if (type.kind != CellKind::none) {
          tags2(tag_count());
          element(type, number, i32);
          in_.end_item();
        } else {
          taker_.refuse("elements of an unknown type");
          in_.end_line();
        }
        ++i;
      } else {
        const CellType type = known(in_.whole(i32, "the type of elements"));
        const std::uint64_t here =
            count(in_.whole(i32, "the number of elements"), "elements in a block", i32, 1);
        if (here == 0) in_.fail("a block without elements");
        if (here > elements - i) more_than("elements", elements);
        const std::uint64_t tags = tag_count();
        for (std::uint64_t e = 0; e < here; ++e) {
          const std::int64_t number = in_.whole(i32, "the element's number");
          tags2(tags);
          element(type, number, i32);
        }
        i += here;
      }
    }
  }

  void elements4() {
    in_.end_line();
    const std::int64_t blocks = in_.whole(u64, "the number of blocks");
    const std::uint64_t elements =
        count(in_.whole(u64, "the number of elements"), "elements", u64, 1);
    in_.skip(u64, 2, "the least and the largest tag");
    std::uint64_t seen = 0;
    for (std::int64_t b = 0; b < blocks; ++b) {
      const std::int64_t dimension = in_.whole(i32, "the entity's dimension and tag");
      const std::int64_t tag = in_.whole(i32, "the entity's dimension and tag");
      const auto group = groups_.find({dimension, tag});
      region_ = group == groups_.end() ? 0 : group->second;
      const std::int64_t type_number = in_.whole(i32, "the type of elements");
      const std::uint64_t here = count(in_.whole(u64, "the number of elements of the block"),
                                       "elements in a block", u64, 2);
      if (here > elements - seen) more_than("elements", elements);
      seen += here;
      const CellType type = Source::is_text ? gmsh_cell_type(type_number) : known(type_number);
      if (type.kind == CellKind::none) {
        taker_.refuse("elements of an unknown type", here);
        for (std::uint64_t e = 0; e <= here; ++e) in_.end_line();
        continue;
      }
      for (std::uint64_t e = 0; e < here; ++e) {
        const std::int64_t number = in_.whole(u64, "the element's tag");
        element(type, number, u64);
        in_.end_item();
      }
    }
    if (seen != elements) fewer_than("elements", seen, elements);
  }

  CellType known(std::int64_t number) {
    const CellType type = gmsh_cell_type(number);
    if (type.kind == CellKind::none)
      in_.fail("elements of type " + std::to_string(number) +
               ", whose size is not known; save the file as ascii");
    return type;
  }

  // The first is the physical group, 0 for none.
  void tags2(std::uint64_t tags) {
    region_ = tags == 0 ? 0 : in_.whole(i32, "the element's tags");
    if (tags > 1) in_.skip(i32, tags - 1, "the element's tags");
  }

  std::uint64_t tag_count() {
    return count(in_.whole(i32, "the number of tags"), "tags of an element", i32, 1);
  }

  void element(const CellType& type, std::int64_t number, NumberType numbers) {
    constexpr std::string_view node = "a node of the element";
    std::array<std::uint32_t, 8> corner{};
    const std::uint32_t corners = corners_of(type.kind);
    for (std::uint32_t i = 0; i < corners; ++i) {
      const std::int64_t tag = in_.whole(numbers, node);
      const auto vertex = tags_.find(tag);
      if (!vertex)
        in_.fail(std::string(name_of(type.kind)) + " " + std::to_string(number) + " names node " +
                 std::to_string(tag) + ", which is not among the " + std::to_string(tags_.size()) +
                 " nodes");
      corner[i] = *vertex;
    }
    in_.skip(numbers, type.nodes - corners, node);
    static_cast<void>(taker_.add(type.kind, std::span(corner).first(corners)));
    if (regions_ == nullptr) return;
    regions_->edges.resize(solid_.edges.size(), region_);
    regions_->triangles.resize(solid_.triangles.size(), region_);
    regions_->tets.resize(solid_.tets.size(), region_);
  }

  [[noreturn]] void more_than(std::string_view what, std::uint64_t stated) {
    in_.fail("the blocks hold more than the " + std::to_string(stated) + " " + std::string(what) +
             " that the section states");
  }

  [[noreturn]] void fewer_than(std::string_view what, std::uint64_t have, std::uint64_t stated) {
    in_.fail("the blocks hold " + std::to_string(have) + " " + std::string(what) +
             ", but the section states " + std::to_string(stated));
  }

  Source in_;
  std::string_view name_;
  Regions* regions_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> groups_;  // by dimension and tag
  std::int64_t region_ = 0;  // of the element that is read
  Mixed solid_;
  NodeTags tags_;
  CellTaker taker_{solid_};
  bool has_nodes_ = false;
  bool has_elements_ = false;
};

/// Reads the line under $MeshFormat and leaves the scanner on the next.
Format read_gmsh_format(TextScanner& scanner) {
  if (!scanner.to_content()) scanner.fail("expected $MeshFormat, found the end of the file");
  std::string_view word = scanner.field();
  // $Comments, and whatever else stands before it.
  while (word.starts_with('$') && word != "$MeshFormat" && word != "$NOD") {
    const std::string end = "$End" + std::string(word.substr(1));
    while (word != end) {
      scanner.next_line();
      if (scanner.at_end()) scanner.fail("the file ends before " + quote(end));
      word = scanner.field();
    }
    if (!scanner.next_line() || !scanner.to_content())
      scanner.fail("expected $MeshFormat, found the end of the file");
    word = scanner.field();
  }
  if (word == "$NOD") scanner.fail("version 1 of .msh is not read; save it as version 4.1 or 2.2");
  if (word != "$MeshFormat") scanner.fail("expected $MeshFormat, found " + quote(word));
  if (!scanner.to_content()) scanner.fail("the file ends before the version");
  Format format;
  format.version = scanner.number("the version");
  if (!(format.version >= 2 && format.version < 3) && format.version != 4.1)
    scanner.fail("this version of .msh is not read; save it as version 4.1 or 2.2");
  const std::int64_t type = scanner.integer("the file type");
  if (type != 0 && type != 1) scanner.fail("the file type is neither 0, ascii, nor 1, binary");
  format.binary = type == 1;
  const std::int64_t size = scanner.integer("the data size");
  if (size != 8 && format.binary)
    scanner.fail("the data size is " + std::to_string(size) + "; only 8 is read");
  if (!scanner.next_line()) scanner.fail("the file ends inside $MeshFormat");
  return format;
}

Mixed parse_gmsh_body(std::string_view bytes, std::string_view name, Regions* regions = nullptr) {
  TextScanner scanner(bytes, name);
  const Format format = read_gmsh_format(scanner);
  const bool version4 = format.version > 3;
  if (!format.binary) {
    if (!scanner.to_content() || scanner.field() != "$EndMeshFormat")
      scanner.fail("expected $EndMeshFormat");
    return GmshReader(TextValues(scanner), name, regions).read(version4);
  }
  // A one, as an int, tells the byte order.
  const std::size_t at = bytes.size() - scanner.bytes_left();
  if (scanner.bytes_left() < 4)
    scanner.fail("the file ends before the number that tells the order of bytes");
  std::endian order = std::endian::little;
  if (load<std::int32_t>(bytes.data() + at, order) != 1) order = std::endian::big;
  ByteValues in(bytes, name, order, at);
  if (in.whole(i32, "the number that tells the order of bytes") != 1)
    in.fail("the number that tells the order of bytes is not 1");
  if (in.word() != "$EndMeshFormat") in.fail("expected $EndMeshFormat");
  return GmshReader(in, name, regions).read(version4);
}

}  // namespace

Mixed parse_gmsh(std::string_view bytes, std::string_view name) {
  return parse_gmsh_body(bytes, name);
}

Regions parse_gmsh_regions(std::string_view bytes, std::string_view name) {
  Regions regions;
  (void)parse_gmsh_body(bytes, name, &regions);
  return regions;
}

}  // namespace plexway::io
