// Reading glTF 2.0: JSON, and bytes that its accessors cut into numbers. Source: Khronos Group,
// glTF 2.0 Specification, 2021.

#include <string>

#include <plexway/error.hpp>
#include <plexway/io/mixed.hpp>

#include "io/readers.hpp"

#ifdef PLEXWAY_IO_JSON

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>

#include "io/base64.hpp"
#include "io/names.hpp"
#include "io/numbers.hpp"
#include "io/solid/cells.hpp"
#include "io/surface/placing.hpp"

namespace plexway::io {
namespace {

using Json = nlohmann::json;
constexpr char draco[] = "KHR_draco_mesh_compression";

class GltfReader {
 public:
  GltfReader(std::string_view bytes, std::string_view name, const GltfFiles& beside)
      : name_(name), beside_(beside), repeats_{bytes.size()} {
    open(bytes);
  }

  Mixed read() {
    for (const auto& needed : list(json_, "extensionsRequired")) {
      const std::string extension = text(needed);
      needs_draco_ = needs_draco_ || extension == draco;
      // Numbers of another kind, and what has to do with looks alone.
      const auto starts = [&](std::string_view what) { return extension.starts_with(what); };
      if (extension == "KHR_mesh_quantization" || extension == draco || starts("KHR_materials_") ||
          starts("KHR_texture_") || starts("EXT_texture_"))
        continue;
      if (extension.find("meshopt") != extension.npos)
        fail("is packed (" + extension +
             "), which is not read; unpack it, with 'gltf-transform copy' or Blender");
      fail("needs the extension " + quote(extension) + ", which is not read; save it without");
    }
    // Seams are cuts of the format, not of the surface.
    const Json asset = json_.value("asset", Json::object());
    own_ = asset.is_object() && asset.contains("generator") && asset["generator"] == "plexway";
    const auto& scenes = list(json_, "scenes");
    if (scenes.empty()) {
      for (std::size_t n = 0; n < list(json_, "nodes").size(); ++n) add_node(n, {}, 0);
      if (list(json_, "nodes").empty())
        for (std::size_t m = 0; m < list(json_, "meshes").size(); ++m) add_mesh(m, {});
    } else {
      const std::size_t scene = json_.contains("scene") ? index(json_["scene"], "scenes") : 0;
      for (const auto& root : list(scenes[scene], "nodes")) add_node(index(root, "nodes"), {}, 0);
    }
    if (!own_) close_seams(cells_);
    if (cells_.positions.empty()) fail("has no points");
    return std::move(cells_);
  }

 private:
  [[noreturn]] void fail(const std::string& cause) const {
    throw InputError(std::string(name_) + ": " + cause);
  }

  static std::string text(const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump(-1, ' ', true);
  }

  static const Json& list(const Json& of, const char* key) {
    static const Json none = Json::array();
    const auto found = of.is_object() ? of.find(key) : of.end();
    return of.is_object() && found != of.end() && found->is_array() ? *found : none;
  }

  std::uint64_t whole(const Json& of, const char* key, std::uint64_t otherwise) const {
    if (!of.is_object() || !of.contains(key)) return otherwise;
    const Json& value = of[key];
    if (!value.is_number_unsigned())
      fail(std::string(key) + " is no whole number: " + quote(text(value)));
    return value.get<std::uint64_t>();
  }

  std::size_t index(const Json& value, const char* of) const {
    const std::size_t count = list(json_, of).size();
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= count)
      fail("names " + quote(text(value)) + " of " + std::to_string(count) + " " + of);
    return value.get<std::size_t>();
  }

  void open(std::string_view bytes) {
    std::string_view document = bytes;
    if (bytes.starts_with("glTF")) {
      if (bytes.size() < 20) fail("ends inside its header");
      if (load<std::uint32_t>(bytes.data() + 4, std::endian::little) != 2)
        fail("is not of version 2 of glTF");
      std::string_view rest = bytes.substr(12);
      for (bool first = true; rest.size() >= 8; first = false) {
        const auto size = load<std::uint32_t>(rest.data(), std::endian::little);
        const std::string_view kind = rest.substr(4, 4);
        if (size > rest.size() - 8)
          fail("ends inside a chunk of " + std::to_string(size) + " bytes");
        const std::string_view chunk = rest.substr(8, size);
        if (first && kind != "JSON") fail("has no JSON at its beginning");
        if (first) document = chunk;
        if (kind == std::string_view("BIN\0", 4) && !binary_) binary_ = chunk;
        rest.remove_prefix(8 + std::size_t{size});
      }
    }
    try {
      json_ = Json::parse(document, nullptr, true, true);
    } catch (const Json::exception&) {
      fail("its JSON is broken");
    }
    if (!json_.is_object()) fail("its JSON is no object");
  }

  std::string_view buffer(std::size_t number) {
    const Json& one = list(json_, "buffers")[number];
    if (!one.is_object() || !one.contains("uri")) {
      if (number == 0 && binary_) return *binary_;
      fail("buffer " + std::to_string(number) + " has no bytes");
    }
    const std::string uri = text(one["uri"]);
    auto [found, added] = decoded_.try_emplace(number);
    if (!added) return found->second;
    const auto comma = uri.find(',');
    if (!uri.starts_with("data:") || comma == uri.npos) {
      if (!beside_) fail("has its numbers in another file, " + quote(uri));
      repeats_.bytes += (found->second = beside_(uri)).size();
    } else if (!decode_base64(std::string_view(uri).substr(comma + 1), found->second)) {
      fail("buffer " + std::to_string(number) + " is no base64");
    }
    return found->second;
  }

  /// Numbers of `kind` in a bufferView, `parts` after each other `count` times.
  struct Numbers {
    std::string_view bytes;  ///< from the first on
    std::uint64_t count = 0, stride = 0, kind = 0, parts = 0;

    [[nodiscard]] double at(std::uint64_t i, std::uint64_t part, bool normalized) const {
      const char* from = bytes.data() + i * stride + part * size_of(kind);
      const auto of = [&]<class Number>(Number, double one) {
        const auto x = static_cast<double>(load<Number>(from, std::endian::little));
        return normalized ? std::max(x / one, -1.0) : x;
      };
      switch (kind) {
        case 5120:
          return of(std::int8_t{}, 127);
        case 5121:
          return of(std::uint8_t{}, 255);
        case 5122:
          return of(std::int16_t{}, 32767);
        case 5123:
          return of(std::uint16_t{}, 65535);
        case 5125:
          return of(std::uint32_t{}, 4294967295.0);
        default:
          return of(float{}, 1);
      }
    }
  };
  static std::uint64_t size_of(std::uint64_t kind) { return kind < 5122 ? 1 : kind < 5124 ? 2 : 4; }

  const Json& view_of(const Json& of, const std::string& name) const {
    if (!of.contains("bufferView")) fail(name + " names no bufferView");
    return list(json_, "bufferViews")[index(of["bufferView"], "bufferViews")];
  }
  std::string_view bytes_of(const Json& view, const std::string& name) {
    if (!view.is_object() || !view.contains("buffer")) fail("a bufferView names no buffer");
    const std::string_view all = buffer(index(view["buffer"], "buffers"));
    const std::uint64_t from = whole(view, "byteOffset", 0), length = whole(view, "byteLength", 0);
    if (from > all.size() || length > all.size() - from) fail(name + " lies outside its buffer");
    return all.substr(from, length);
  }

  Numbers numbers_in(const Json& of, std::uint64_t kind, std::uint64_t count, std::uint64_t parts,
                     const std::string& name) {
    if (kind < 5120 || kind > 5126 || kind == 5124)
      fail(name + " has numbers of kind " + std::to_string(kind));
    const Json& view = view_of(of, name);
    const std::string_view all = bytes_of(view, name);
    const std::uint64_t skip = whole(of, "byteOffset", 0), row = parts * size_of(kind);
    if (skip > all.size()) fail(name + " lies outside its buffer");
    const std::uint64_t stride = whole(view, "byteStride", row);
    if (stride < row || stride > 4096)
      fail("a byteStride of " + std::to_string(stride) + " is not one");
    const std::uint64_t left = all.size() - skip;
    if (count > 0 && (left < row || (left - row) / stride < count - 1))
      fail(name + " has fewer numbers than it says");
    return {all.substr(skip), count, stride, kind, parts};
  }

  /// The numbers of an accessor, `parts` after each other.
  std::vector<double> accessor(const Json& number, const char* type, std::uint64_t parts) {
    const Json& one = list(json_, "accessors")[index(number, "accessors")];
    const std::string name = "accessor " + text(number);
    if (text(one.value("type", Json())) != type) fail(name + " is not of type " + type);
    const std::uint64_t count = whole(one, "count", 0), kind = whole(one, "componentType", 0);
    const bool normalized = one.contains("normalized") && one["normalized"] == true;
    const bool sparse = one.contains("sparse");
    std::vector<double> found;
    const auto take = [&](const Numbers& in, const auto& place) {
      for (std::uint64_t i = 0; i < in.count; ++i)
        for (std::uint64_t part = 0; part < parts; ++part)
          found[place(i) * parts + part] = in.at(i, part, normalized);
    };
    if (one.contains("bufferView")) {
      const Numbers in = numbers_in(one, kind, count, parts, name);
      found.resize(count * parts);
      take(in, [](std::uint64_t i) { return i; });
    } else {
      // Zeros; of those that nothing packs there are no more than bytes.
      if (!sparse) fail(name + " has no numbers");
      if (count > repeats_.bytes) fail(name + " has fewer numbers than it says");
      found.resize(count * parts);
    }
    if (!sparse) return found;
    const Json& other = one["sparse"];
    const auto is_there = [&](const char* key) {
      return other.is_object() && other.contains(key) && other[key].is_object();
    };
    if (!is_there("indices") || !is_there("values"))
      fail(name + " is sparse without indices and values");
    const std::uint64_t some = whole(other, "count", 0);
    take_room(some);
    const Json &where = other["indices"], &what = other["values"];
    const Numbers at = numbers_in(where, whole(where, "componentType", 0), some, 1, name);
    take(numbers_in(what, kind, some, parts, name), [&](std::uint64_t i) {
      const double place = at.at(i, 0, false);
      if (!(place >= 0 && place < static_cast<double>(count)))
        fail(name + " is sparse, with an index out of range");
      return static_cast<std::uint64_t>(place);
    });
    return found;
  }

  std::vector<double> numbers(const Json& of, const char* key, std::size_t count) const {
    const Json& given = list(of, key);
    std::vector<double> found;
    for (const Json& x : given) {
      if (!x.is_number() || !std::isfinite(x.get<double>()))
        fail(std::string(key) + " of a node is not made of numbers");
      found.push_back(x.get<double>());
    }
    if (!found.empty() && found.size() != count)
      fail(std::string(key) + " of a node has " + std::to_string(found.size()) + " numbers");
    return found;
  }

  Affine placed(const Json& node) const {
    Affine m;
    if (const auto given = numbers(node, "matrix", 16); !given.empty()) {
      for (std::size_t i = 0; i < 16; ++i)
        if (i % 4 < 3) m.to[i / 4][i % 4] = given[i];
      return m;
    }
    if (const auto q = numbers(node, "rotation", 4); !q.empty()) {
      const double x = q[0], y = q[1], z = q[2], w = q[3];
      m.to[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)};
      m.to[1] = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)};
      m.to[2] = {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)};
    }
    if (const auto scale = numbers(node, "scale", 3); !scale.empty())
      for (std::size_t k = 0; k < 3; ++k)
        for (double& x : m.to[k]) x *= scale[k];
    if (const auto shift = numbers(node, "translation", 3); !shift.empty())
      std::copy(shift.begin(), shift.end(), m.to[3].begin());
    return m;
  }

  void add_node(std::size_t number, const Affine& above, std::size_t depth) {
    const Json& node = list(json_, "nodes")[number];
    repeats_.take_room(1, depth, name_);
    const Affine m = above.after(placed(node));
    if (node.is_object() && node.contains("mesh")) add_mesh(index(node["mesh"], "meshes"), m);
    for (const Json& child : list(node, "children")) add_node(index(child, "nodes"), m, depth + 1);
  }

  void take_room(std::size_t more) { repeats_.take_room(more, 0, name_); }

  void add_mesh(std::size_t number, const Affine& m) {
    Mixed mesh;
    // Primitives of a mesh may share their vertices.
    std::map<std::size_t, std::array<std::size_t, 2>> first_of;  // and how many
    for (const Json& primitive : list(list(json_, "meshes")[number], "primitives")) {
      if (!primitive.is_object() || !primitive.contains("attributes") ||
          !primitive["attributes"].contains("POSITION"))
        fail("a primitive has no POSITION");
      const Json& where = primitive["attributes"]["POSITION"];
      const std::size_t place = index(where, "accessors");
      const Json& positions = list(json_, "accessors")[place];
      // Where Draco is not needed the same numbers are there unpacked.
      if (primitive.contains("extensions") && primitive["extensions"].contains(draco) &&
          (needs_draco_ || !positions.contains("bufferView"))) {
        add_packed(primitive["extensions"][draco], positions, mesh);
        continue;
      }
      const auto [known, added] = first_of.try_emplace(place);
      if (added) {
        const std::vector<double> at = accessor(where, "VEC3", 3);
        take_room(at.size() / 3);
        known->second = {mesh.positions.size(), at.size() / 3};
        for (std::size_t i = 0; i < at.size(); i += 3)
          mesh.positions.push_back({at[i], at[i + 1], at[i + 2]});
      }
      add_primitive(primitive, known->second[0], known->second[1], mesh);
    }
    append(cells_, mesh, m, name_);
  }

  void add_packed(const Json& packed, const Json& positions, Mixed& mesh) {
    const std::string_view bytes = bytes_of(view_of(packed, draco), draco);
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    const std::uint64_t id = whole(packed.at("attributes"), "POSITION", most + 1);
    if (id > most) fail("names no POSITION that Draco packed");
    const bool normalized = positions.contains("normalized") && positions["normalized"] == true;
    // Nodes share what is decoded once.
    auto [found, added] = unpacked_.try_emplace({bytes.data(), bytes.size(), id, normalized});
    const Mixed& part = found->second;
    if (added)
      found->second =
          parse_draco(bytes, name_, DracoPosition{static_cast<std::uint32_t>(id), normalized});
    if (const std::uint64_t count = whole(positions, "count", part.positions.size());
        count != part.positions.size())
      fail("an accessor has " + std::to_string(count) + " points, but Draco packed " +
           std::to_string(part.positions.size()));
    own_ = false;  // Draco cuts seams, too
    take_room(part.positions.size() + part.triangles.size());
    append(mesh, part, {}, name_);
  }

  void add_primitive(const Json& primitive, std::size_t first, std::uint64_t points, Mixed& mesh) {
    const std::uint64_t mode = whole(primitive, "mode", 4);
    std::optional<std::vector<double>> indices;
    if (primitive.contains("indices")) indices = accessor(primitive["indices"], "SCALAR", 1);
    const std::uint64_t corners = indices ? indices->size() : points;
    take_room(corners);
    const auto corner = [&](std::uint64_t i) {
      const double v = indices ? (*indices)[i] : static_cast<double>(i);
      if (!(v >= 0 && v < static_cast<double>(points) && v == std::floor(v)))
        fail("a primitive names vertex " + text(v) + " of " + std::to_string(points));
      return static_cast<std::uint32_t>(first + static_cast<std::size_t>(v));
    };
    const auto line = [&](std::uint64_t a, std::uint64_t b) {
      mesh.edges.push_back({corner(a), corner(b)});
    };
    const auto triangle = [&](std::uint64_t a, std::uint64_t b, std::uint64_t c) {
      mesh.triangles.push_back({corner(a), corner(b), corner(c)});
    };
    switch (mode) {
      case 0:
        return;
      case 1:
        for (std::uint64_t i = 1; i < corners; i += 2) line(i - 1, i);
        return;
      case 2:
      case 3:
        for (std::uint64_t i = 1; i < corners; ++i) line(i - 1, i);
        if (mode == 2 && corners > 2) line(corners - 1, 0);
        return;
      case 4:
        for (std::uint64_t i = 2; i < corners; i += 3) triangle(i - 2, i - 1, i);
        return;
      case 5:
        for (std::uint64_t i = 2; i < corners; ++i)
          triangle(i - 2, i % 2 == 0 ? i - 1 : i, i % 2 == 0 ? i : i - 1);
        return;
      case 6:
        for (std::uint64_t i = 2; i < corners; ++i) triangle(0, i - 1, i);
        return;
      default:
        fail("primitives of mode " + std::to_string(mode) + " are not read");
    }
  }

  std::string_view name_;
  const GltfFiles& beside_;
  Repeats repeats_;  ///< of nodes, points and corners in the bytes of all files
  Json json_;
  std::optional<std::string_view> binary_;
  std::map<std::size_t, std::string> decoded_;
  /// What Draco packed in these bytes: where, how many, which attribute, normalized.
  std::map<std::tuple<const char*, std::size_t, std::uint64_t, bool>, Mixed> unpacked_;
  bool own_ = false, needs_draco_ = false;
  Mixed cells_;
};

}  // namespace

Mixed parse_gltf(std::string_view bytes, std::string_view name, const GltfFiles& beside) {
  try {
    return GltfReader(bytes, name, beside).read();
  } catch (const Json::exception&) {  // an array where an object should be, and the like
    throw InputError(std::string(name) + ": its JSON is not what glTF has");
  }
}

}  // namespace plexway::io

#else

namespace plexway::io {

Mixed parse_gltf(std::string_view, std::string_view name, const GltfFiles&) {
  throw NotBuiltError(std::string(name) +
                      ": this plexway reads no .glb or .gltf: install nlohmann-json3-dev and build "
                      "it again, or save the file as .ply");
}

}  // namespace plexway::io

#endif
