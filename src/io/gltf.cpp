// Reading glTF 2.0: JSON, and bytes that its accessors cut into numbers. Source: Khronos Group,
// glTF 2.0 Specification, 2021.

#include <string>

#include <plexway/error.hpp>
#include <plexway/io/mixed.hpp>

#ifdef PLEXWAY_IO_JSON

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "base64.hpp"
#include "bytes.hpp"
#include "quote.hpp"
#include "tet_checks.hpp"

namespace plexway::io {
namespace {

using Json = nlohmann::json;
using Matrix = std::array<double, 16>;  // column by column

constexpr Matrix identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t column = 0; column < 4; ++column)
    for (std::size_t row = 0; row < 4; ++row)
      for (std::size_t k = 0; k < 4; ++k) c[4 * column + row] += a[4 * k + row] * b[4 * column + k];
  return c;
}

class GltfReader {
 public:
  GltfReader(std::string_view bytes, std::string_view name) : name_(name) { open(bytes); }

  Mixed read() {
    for (const auto& needed : list(json_, "extensionsRequired"))
      fail("needs the extension " + quote(text(needed)) + ", which is not read; save it without");
    // Seams are cuts of the format, not of the surface.
    const Json asset = json_.value("asset", Json::object());
    own_ = asset.is_object() && asset.contains("generator") && asset["generator"] == "plexway";
    const auto& scenes = list(json_, "scenes");
    if (scenes.empty()) {
      for (std::size_t n = 0; n < list(json_, "nodes").size(); ++n) add_node(n, identity, 0);
      if (list(json_, "nodes").empty())
        for (std::size_t m = 0; m < list(json_, "meshes").size(); ++m) add_mesh(m, identity);
    } else {
      const std::size_t scene = json_.contains("scene") ? index(json_["scene"], "scenes") : 0;
      for (const auto& root : list(scenes[scene], "nodes"))
        add_node(index(root, "nodes"), identity, 0);
    }
    if (!own_) weld();
    if (cells_.positions.empty()) fail("has no points");
    require_cells(cells_, {}, Take::any, name_);
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
    const auto comma = uri.find(',');
    if (!uri.starts_with("data:") || comma == uri.npos)
      fail("has its numbers in another file, " + quote(uri) + "; save it as .glb");
    auto [found, added] = decoded_.try_emplace(number);
    if (added && !decode_base64(std::string_view(uri).substr(comma + 1), found->second))
      fail("buffer " + std::to_string(number) + " is no base64");
    return found->second;
  }

  struct Accessor {
    std::string_view bytes;  ///< from its first number on
    std::uint64_t count = 0, stride = 0, kind = 0;
  };

  Accessor accessor(const Json& number, const char* type, std::uint64_t parts) {
    const Json& one = list(json_, "accessors")[index(number, "accessors")];
    if (one.contains("sparse")) fail("has a sparse accessor, which is not read");
    if (text(one.value("type", Json())) != type)
      fail("accessor " + text(number) + " is not of type " + type);
    Accessor found;
    found.count = whole(one, "count", 0);
    found.kind = whole(one, "componentType", 0);
    const std::uint64_t size = found.kind == 5121 ? 1 : found.kind == 5123 ? 2 : 4;
    if (found.kind != 5121 && found.kind != 5123 && found.kind != 5125 && found.kind != 5126)
      fail("accessor " + text(number) + " has numbers of kind " + std::to_string(found.kind));
    if (!one.contains("bufferView")) fail("accessor " + text(number) + " has no numbers");
    const Json& view = list(json_, "bufferViews")[index(one["bufferView"], "bufferViews")];
    if (!view.is_object() || !view.contains("buffer")) fail("a bufferView names no buffer");
    const std::string_view all = buffer(index(view["buffer"], "buffers"));
    const std::uint64_t from = whole(view, "byteOffset", 0), length = whole(view, "byteLength", 0),
                        skip = whole(one, "byteOffset", 0);
    if (from > all.size() || length > all.size() - from || skip > length)
      fail("accessor " + text(number) + " lies outside its buffer");
    found.bytes = all.substr(from + skip, length - skip);
    found.stride = whole(view, "byteStride", parts * size);
    if (found.stride < parts * size || found.stride > 4096)
      fail("a byteStride of " + std::to_string(found.stride) + " is not one");
    const std::uint64_t left = found.bytes.size();
    if (found.count > 0 &&
        (left < parts * size || (left - parts * size) / found.stride < found.count - 1))
      fail("accessor " + text(number) + " has fewer numbers than it says");
    return found;
  }

  static std::uint32_t whole_at(const Accessor& of, std::uint64_t i) {
    const char* at = of.bytes.data() + i * of.stride;
    if (of.kind == 5121) return static_cast<unsigned char>(*at);
    if (of.kind == 5123) return load<std::uint16_t>(at, std::endian::little);
    return load<std::uint32_t>(at, std::endian::little);
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

  Matrix placed(const Json& node) const {
    Matrix m = identity;
    if (const auto given = numbers(node, "matrix", 16); !given.empty()) {
      std::copy(given.begin(), given.end(), m.begin());
      return m;
    }
    if (const auto q = numbers(node, "rotation", 4); !q.empty()) {
      const double x = q[0], y = q[1], z = q[2], w = q[3];
      m = {1 - 2 * (y * y + z * z),
           2 * (x * y + z * w),
           2 * (x * z - y * w),
           0,
           2 * (x * y - z * w),
           1 - 2 * (x * x + z * z),
           2 * (y * z + x * w),
           0,
           2 * (x * z + y * w),
           2 * (y * z - x * w),
           1 - 2 * (x * x + y * y),
           0,
           0,
           0,
           0,
           1};
    }
    if (const auto scale = numbers(node, "scale", 3); !scale.empty())
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t row = 0; row < 3; ++row) m[4 * k + row] *= scale[k];
    if (const auto shift = numbers(node, "translation", 3); !shift.empty())
      for (std::size_t k = 0; k < 3; ++k) m[12 + k] = shift[k];
    return m;
  }

  void add_node(std::size_t number, const Matrix& above, std::size_t depth) {
    const Json& node = list(json_, "nodes")[number];
    // A tree is never this deep or this large; a circle is.
    if (depth > 1000 || ++visited_ > 1'000'000) fail("its nodes go round in a circle");
    const Matrix m = product(above, placed(node));
    if (node.is_object() && node.contains("mesh")) add_mesh(index(node["mesh"], "meshes"), m);
    for (const Json& child : list(node, "children")) add_node(index(child, "nodes"), m, depth + 1);
  }

  void add_mesh(std::size_t number, const Matrix& m) {
    // Primitives of a mesh may share their vertices.
    std::map<std::size_t, std::size_t> first_of;
    for (const Json& primitive : list(list(json_, "meshes")[number], "primitives")) {
      if (!primitive.is_object() || !primitive.contains("attributes") ||
          !primitive["attributes"].contains("POSITION"))
        fail("a primitive has no POSITION");
      const Json& where = primitive["attributes"]["POSITION"];
      const std::size_t place = index(where, "accessors");
      const auto known = first_of.find(place);
      const Accessor at = accessor(where, "VEC3", 3);
      const std::size_t first = known == first_of.end() ? cells_.positions.size() : known->second;
      if (known == first_of.end()) {
        first_of[place] = first;
        add_points(at, m);
      }
      add_primitive(primitive, first, at.count);
    }
  }

  void add_points(const Accessor& at, const Matrix& m) {
    if (at.kind != 5126) fail("positions that are whole numbers are not read");
    if (at.count >= most_vertices - cells_.positions.size()) fail("more points than 32 bits count");
    for (std::uint64_t i = 0; i < at.count; ++i) {
      std::array<double, 3> p{}, out{};
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = static_cast<double>(
            load<float>(at.bytes.data() + i * at.stride + 4 * k, std::endian::little));
      for (std::size_t row = 0; row < 3; ++row) {
        out[row] = m[12 + row];
        for (std::size_t k = 0; k < 3; ++k) out[row] += m[4 * k + row] * p[k];
        if (!std::isfinite(out[row]))
          fail("point " + std::to_string(i) + " has a coordinate that is not finite");
      }
      cells_.positions.push_back(out);
    }
  }

  void add_primitive(const Json& primitive, std::size_t first, std::uint64_t points) {
    const std::uint64_t mode = whole(primitive, "mode", 4);
    std::optional<Accessor> indices;
    if (primitive.contains("indices")) {
      indices = accessor(primitive["indices"], "SCALAR", 1);
      if (indices->kind == 5126) fail("indices that are no whole numbers");
    }
    const std::uint64_t count = indices ? indices->count : points;
    const auto corner = [&](std::uint64_t i) {
      const std::uint64_t v = indices ? whole_at(*indices, i) : i;
      if (v >= points)
        fail("a primitive names vertex " + std::to_string(v) + " of " + std::to_string(points));
      return static_cast<std::uint32_t>(first + v);
    };
    const auto line = [&](std::uint64_t a, std::uint64_t b) {
      cells_.edges.push_back({corner(a), corner(b)});
    };
    const auto triangle = [&](std::uint64_t a, std::uint64_t b, std::uint64_t c) {
      cells_.triangles.push_back({corner(a), corner(b), corner(c)});
    };
    switch (mode) {
      case 0:
        return;
      case 1:
        for (std::uint64_t i = 1; i < count; i += 2) line(i - 1, i);
        return;
      case 2:
      case 3:
        for (std::uint64_t i = 1; i < count; ++i) line(i - 1, i);
        if (mode == 2 && count > 2) line(count - 1, 0);
        return;
      case 4:
        for (std::uint64_t i = 2; i < count; i += 3) triangle(i - 2, i - 1, i);
        return;
      case 5:
        for (std::uint64_t i = 2; i < count; ++i)
          triangle(i - 2, i % 2 == 0 ? i - 1 : i, i % 2 == 0 ? i : i - 1);
        return;
      case 6:
        for (std::uint64_t i = 2; i < count; ++i) triangle(0, i - 1, i);
        return;
      default:
        fail("primitives of mode " + std::to_string(mode) + " are not read");
    }
  }

  // Vertices at one place become the first of them. Triangles that strips repeat a corner in are no
  // triangles.
  void weld() {
    const auto& p = cells_.positions;
    std::vector<std::uint32_t> order(p.size()), becomes(p.size());
    for (std::uint32_t v = 0; v < order.size(); ++v) order[v] = v;
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return p[a] != p[b] ? p[a] < p[b] : a < b; });
    for (std::size_t i = 0; i < order.size(); ++i)
      becomes[order[i]] =
          i > 0 && p[order[i]] == p[order[i - 1]] ? becomes[order[i - 1]] : order[i];
    std::vector<std::array<double, 3>> kept;
    std::vector<std::uint32_t> number(p.size());
    for (std::uint32_t v = 0; v < p.size(); ++v)
      if (becomes[v] == v) {
        number[v] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(p[v]);
      }
    const auto renumber = [&](auto& rows) {
      for (auto& row : rows)
        for (std::uint32_t& v : row) v = number[becomes[v]];
    };
    renumber(cells_.edges);
    renumber(cells_.triangles);
    cells_.positions = std::move(kept);
    std::erase_if(cells_.triangles,
                  [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[0] == t[2]; });
  }

  std::string_view name_;
  Json json_;
  std::optional<std::string_view> binary_;
  std::map<std::size_t, std::string> decoded_;
  bool own_ = false;
  std::size_t visited_ = 0;
  Mixed cells_;
};

}  // namespace

Mixed parse_gltf(std::string_view bytes, std::string_view name) {
  try {
    return GltfReader(bytes, name).read();
  } catch (const Json::exception&) {  // an array where an object should be, and the like
    throw InputError(std::string(name) + ": its JSON is not what glTF has");
  }
}

}  // namespace plexway::io

#else

namespace plexway::io {

Mixed parse_gltf(std::string_view, std::string_view name) {
  throw NotBuiltError(std::string(name) +
                      ": this plexway reads no .glb or .gltf: install nlohmann-json3-dev and build "
                      "it again, or save the file as .ply");
}

}  // namespace plexway::io

#endif
