// 3MF: objects of triangles as XML in a zip archive, placed by a list of items. Sources: 3MF
// Consortium, Core Specification 1.3 and Production Extension 1.1; for the archive PKWARE, .ZIP
// File Format Specification, sections 4.3.7 (local header), 4.3.12 (central directory), 4.3.14
// to 4.3.16 (its ends), 4.5.3 (zip64 field).

#include <string>

#include <plexway/error.hpp>

#include "io/readers.hpp"

#if PLEXWAY_IO_PUGIXML

#include <algorithm>
#include <cstdint>
#include <map>
#include <pugixml.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "io/file_bytes.hpp"
#include "io/matrix/npy.hpp"
#include "io/names.hpp"
#include "io/numbers.hpp"
#include "io/surface/placing.hpp"
#include "io/text_scanner.hpp"

namespace plexway::io {
using namespace detail;
namespace {

/// The files in a zip archive (zip64 too), packed by deflate or not at all.
class ZipArchive {
 public:
  /// Both are referred to. Throws InputError "NAME: cause" where the bytes are no archive.
  ZipArchive(std::string_view bytes, std::string_view name);

  /// Unpacks a file; upper and lower case are the same. Throws InputError where it is missing,
  /// encrypted or broken, and where all files unpacked so far come to more than 16 MiB and 50 times
  /// the archive; NotBuiltError without zlib for what is packed.
  [[nodiscard]] std::string unpack(std::string file);

 private:
  struct Entry {
    std::uint16_t flags, method;
    std::uint32_t crc;
    std::uint64_t packed, size, place;
  };

  [[noreturn]] void fail(const std::string& cause) const;
  template <class Number>
  [[nodiscard]] Number number(std::uint64_t place) const;
  void read_directory(std::uint64_t at);

  std::string_view bytes_, name_;
  std::map<std::string, Entry> entries_;  ///< by their names in lower case
  std::uint64_t room_;
};

void ZipArchive::fail(const std::string& cause) const {
  throw InputError(std::string(name_) + ": " + cause);
}

template <class Number>
Number ZipArchive::number(std::uint64_t place) const {
  if (place > bytes_.size() || bytes_.size() - place < sizeof(Number))
    fail("is not a complete zip archive: its directory leads out of it");
  return load<Number>(bytes_.data() + place, std::endian::little);
}

ZipArchive::ZipArchive(std::string_view bytes, std::string_view name)
    : bytes_(bytes), name_(name), room_((std::uint64_t{1} << 24) + 50 * bytes.size()) {
  const std::size_t end = bytes.rfind("PK\x05\x06");
  if (end == bytes.npos) fail("is not a complete zip archive: it has no directory");
  std::uint64_t at = number<std::uint32_t>(end + 16);
  if (end >= 20 && bytes.substr(end - 20).starts_with("PK\x06\x07"))
    at = number<std::uint64_t>(number<std::uint64_t>(end - 12) + 48);
  read_directory(at);
}

void ZipArchive::read_directory(std::uint64_t at) {
  while (number<std::uint32_t>(at) == 0x02014b50) {
    Entry entry{number<std::uint16_t>(at + 8),  number<std::uint16_t>(at + 10),
                number<std::uint32_t>(at + 16), number<std::uint32_t>(at + 20),
                number<std::uint32_t>(at + 24), number<std::uint32_t>(at + 42)};
    const std::uint64_t from = at + 46, extra = from + number<std::uint16_t>(at + 28),
                        end = extra + number<std::uint16_t>(at + 30);
    for (std::uint64_t i = extra; i + 4 <= end; i += 4 + number<std::uint16_t>(i + 2)) {
      if (number<std::uint16_t>(i) != 1) continue;
      std::uint64_t next = i + 4;  // of those numbers that 32 bits do not hold, in this order
      for (std::uint64_t* value : {&entry.size, &entry.packed, &entry.place})
        if (*value == 0xFFFFFFFFU) {
          *value = number<std::uint64_t>(next);
          next += 8;
        }
    }
    const std::uint64_t behind = end + number<std::uint16_t>(at + 32);
    if (behind > bytes_.size())
      fail("is not a complete zip archive: its directory leads out of it");
    const std::string file(bytes_.substr(from, extra - from));
    if (!entries_.emplace(lower_case(file), entry).second) fail("has two files " + quote(file));
    at = behind;
  }
}

std::string ZipArchive::unpack(std::string file) {
  const auto found = entries_.find(lower_case(file));
  if (found == entries_.end()) fail("is a zip archive without " + quote(file));
  const Entry& entry = found->second;
  if ((entry.flags & 1U) != 0) fail("its " + quote(file) + " is encrypted");
  // The local header may have other fields than the directory, so its own lengths count.
  const std::uint64_t from = entry.place + 30 + number<std::uint16_t>(entry.place + 26) +
                             number<std::uint16_t>(entry.place + 28);
  if (from > bytes_.size() || entry.packed > bytes_.size() - from)
    fail("its " + quote(file) + " is cut off");
  if (entry.size > room_) fail("unpacks to more than 16 MiB plus 50 times its size");
  room_ -= entry.size;
  const std::string_view packed = bytes_.substr(from, entry.packed);
  if (entry.method != 0 && entry.method != 8)
    fail("its " + quote(file) + " is packed by method " + std::to_string(entry.method) +
         "; deflate is read");
  std::string out = entry.method == 0 ? std::string(packed)
                                      : inflated(packed, Deflated::alone, entry.size, name_);
  Crc32 crc;
  crc.add(out);
  if (out.size() != entry.size || crc.value() != entry.crc)
    fail("its " + quote(file) + " is damaged (size or checksum)");
  return out;
}

class ThreeMfReader {
 public:
  ThreeMfReader(std::string_view bytes, std::string_view name)
      : name_(name),
        archive_(bytes, name),
        repeats_{bytes.size()},
        tree_room_((std::uint64_t{1} << 28) + 200 * bytes.size()) {}

  Triangles read() {
    std::string root;
    Part relations;
    open("_rels/.rels", relations);
    for (const pugi::xml_node relation : relations.document.document_element().children())
      if (value(relation, "Type").ends_with("/3dmodel")) root = value(relation, "Target");
    if (root.empty()) fail("is no 3MF: its archive names no 3D model");
    for (const pugi::xml_node item : child(model(root).root, "build").children())
      if (is(item, "item")) add(placed(item, root), {}, 0);
    require_faces(surface_, name_);
    return std::move(surface_);
  }

 private:
  /// A file of the archive. The document refers to the text.
  struct Part {
    std::string text;
    pugi::xml_document document;
  };
  struct Placed {
    std::string part, object;
    Affine where;
  };
  struct Object {
    std::string helps;  // its type, where it is no part of the surface
    Triangles mesh;
    std::vector<Placed> components;
  };
  struct Model {
    Part part;
    pugi::xml_node root;
    std::map<std::string, pugi::xml_node, std::less<>> objects;  // by their names
  };

  [[noreturn]] void fail(const std::string& cause) const {
    throw InputError(std::string(name_) + ": " + cause);
  }

  // Names without the prefix of their namespace.
  static std::string_view local(std::string_view name) { return name.substr(name.find(':') + 1); }
  static bool is(pugi::xml_node node, std::string_view name) { return local(node.name()) == name; }
  static pugi::xml_node child(pugi::xml_node of, std::string_view name) {
    return of.find_child([&](pugi::xml_node node) { return is(node, name); });
  }
  static std::string_view value(pugi::xml_node of, std::string_view name) {
    return of.find_attribute([&](pugi::xml_attribute a) { return local(a.name()) == name; })
        .value();
  }

  void open(std::string_view path, Part& into) {
    into.text = archive_.unpack(std::string(path.substr(path.starts_with('/') ? 1 : 0)));
    // Pugixml's tree may take 16 times the text.
    const auto count = [&](char c) {
      return static_cast<std::uint64_t>(std::count(into.text.begin(), into.text.end(), c));
    };
    const std::uint64_t tree = 64 * count('<') + 40 * count('=');
    if (tree > tree_room_)
      fail("its " + quote(path) + " has more XML than an archive of this size is worth");
    tree_room_ -= tree;
    const auto result = into.document.load_buffer_inplace(
        into.text.data(), into.text.size(), pugi::parse_minimal | pugi::parse_escapes);
    if (!result) fail("its " + quote(path) + " is not whole XML: " + result.description());
  }

  const Model& model(const std::string& path) {
    auto [found, added] = models_.try_emplace(path);
    Model& model = found->second;
    if (!added) return model;
    open(path, model.part);
    model.root = model.part.document.document_element();
    if (!is(model.root, "model")) fail("its " + quote(path) + " is no model");
    check_extensions(model.root);
    std::string_view unit = value(model.root, "unit");
    if (unit.empty()) unit = "millimeter";
    if (models_.size() == 1)
      unit_ = unit;
    else if (unit != unit_)
      fail("has parts in different units");
    for (const pugi::xml_node object : child(model.root, "resources").children())
      if (is(object, "object") && !model.objects.emplace(value(object, "id"), object).second)
        fail("has two objects " + quote(value(object, "id")));
    return model;
  }

  // Those that only add looks or other forms of the same meshes do no harm.
  void check_extensions(pugi::xml_node root) const {
    std::string_view list = value(root, "requiredextensions");
    while (!list.empty()) {
      const std::string prefix(list.substr(0, list.find_first_of(" \t\r\n")));
      list.remove_prefix(std::min(prefix.size() + 1, list.size()));
      const std::string_view space = root.attribute(("xmlns:" + prefix).c_str()).value();
      const auto has = [&](const char* what) { return space.find(what) != space.npos; };
      if (!prefix.empty() && !has("/material/") && !has("/production/") && !has("/slice/") &&
          !has("/beamlattice/"))
        fail("needs the extension " + quote(space.empty() ? prefix : space) +
             ", which is not read; save it without");
    }
  }

  Placed placed(pugi::xml_node of, const std::string& path) const {
    const std::string_view part = value(of, "path"), transform = value(of, "transform");
    Affine where;
    if (!transform.empty()) {
      TextScanner in = TextScanner::of_value(transform, name_);
      for (Point3& to : where.to)
        for (double& x : to) x = in.number("one of a transform's 12 numbers");
      in.finish();
    }
    return {part.empty() ? path : std::string(part), std::string(value(of, "objectid")), where};
  }

  const Object& object(const Placed& which) {
    auto [found, added] = objects_.try_emplace({which.part, which.object});
    Object& object = found->second;
    if (!added) return object;
    const auto& known = model(which.part).objects;
    const auto node = known.find(which.object);
    if (node == known.end())
      fail("refers to object " + quote(which.object) + ", which does not exist");
    const std::string_view type = value(node->second, "type");
    if (type == "support" || type == "solidsupport" || type == "other") {
      object.helps = type;
      return object;
    }
    const pugi::xml_node mesh = child(node->second, "mesh"),
                         components = child(node->second, "components");
    if (!mesh && !components) fail("object " + quote(which.object) + " has no mesh");
    read_mesh(mesh, object.mesh);
    for (const pugi::xml_node one : components.children())
      if (is(one, "component")) object.components.push_back(placed(one, which.part));
    if (!value(node->second, "slicestackid").empty())
      surface_.report.pass_over("stacks of slices", 1);
    return object;
  }

  void read_mesh(pugi::xml_node mesh, Triangles& into) {
    for (const pugi::xml_node vertex : child(mesh, "vertices").children()) {
      if (!is(vertex, "vertex")) continue;
      const std::string where =
          std::string(name_) + ": vertex " + std::to_string(into.positions.size());
      const auto axis = [&](const char* name) {
        TextScanner in = TextScanner::of_value(value(vertex, name), where);
        const double x = in.number(name);
        in.finish();
        return x;
      };
      into.positions.push_back({axis("x"), axis("y"), axis("z")});
    }
    for (const pugi::xml_node triangle : child(mesh, "triangles").children()) {
      if (!is(triangle, "triangle")) continue;
      const std::string where =
          std::string(name_) + ": triangle " + std::to_string(into.triangles.size());
      const auto corner = [&](const char* name) {
        TextScanner in = TextScanner::of_value(value(triangle, name), where);
        const std::int64_t v = in.integer(name);
        in.finish();
        if (v < 0 || v >= std::ssize(into.positions))
          fail(bad_corner("triangle", std::ssize(into.triangles), v, into.positions.size()));
        return static_cast<std::uint32_t>(v);
      };
      into.triangles.push_back({corner("v1"), corner("v2"), corner("v3")});
    }
    const auto beams = child(child(mesh, "beamlattice"), "beams").children();
    surface_.report.pass_over("beams",
                              static_cast<std::size_t>(std::distance(beams.begin(), beams.end())));
  }

  void add(const Placed& what, const Affine& above, std::size_t depth) {
    const Object& one = object(what);
    if (!one.helps.empty()) surface_.report.pass_over("objects of type " + one.helps, 1);
    repeats_.take_room(1 + one.mesh.positions.size() + one.mesh.triangles.size(), depth, name_);
    const Affine where = above.after(what.where);
    append(surface_, one.mesh, where, name_);
    for (const Placed& component : one.components) add(component, where, depth + 1);
  }

  std::string_view name_;
  ZipArchive archive_;
  Repeats repeats_;
  std::uint64_t tree_room_;
  std::map<std::string, Model> models_;
  std::map<std::pair<std::string, std::string>, Object> objects_;
  std::string unit_;
  Triangles surface_;
};

}  // namespace

Triangles parse_three_mf(std::string_view bytes, std::string_view name) {
  return ThreeMfReader(bytes, name).read();
}

}  // namespace plexway::io

#else

namespace plexway::io {

Triangles parse_three_mf(std::string_view, std::string_view name) {
  throw NotBuiltError(std::string(name) +
                      ": this plexway reads no .3mf: install libpugixml-dev and build it again, or "
                      "save the surface as .ply");
}

}  // namespace plexway::io

#endif
