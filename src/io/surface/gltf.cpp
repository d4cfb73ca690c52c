// Reading glTF 2.0: JSON, and bytes that its accessors cut into numbers. Source: Khronos Group,
// glTF 2.0 Specification, 2021.

#include <string>

#include <plexway/error.hpp>
#include <plexway/io/mixed.hpp>

#include "io/readers.hpp"

#ifdef PLEXWAY_IO_JSON

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "io/base64.hpp"
#include "io/names.hpp"
#include "io/numbers.hpp"
#include "io/solid/cells.hpp"

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
  GltfReader(std::string_view bytes, std::string_view name, const GltfFiles& beside)
      : name_(name), beside_(beside), size_(bytes.size()) {
    open(bytes);
  }

  Mixed read() {
    for (const auto& needed : list(json_, "extensionsRequired")) {
      const std::string extension = text(needed);
      // Numbers of another kind, and what has to do with looks alone.
      const auto starts = [&](std::string_view what) { return extension.starts_with(what); };
      if (extension == "KHR_mesh_quantization" || starts("KHR_materials_") ||
          starts("KHR_texture_") || starts("EXT_texture_"))
        continue;
      if (extension.find("draco") != extension.npos || extension.find("meshopt") != extension.npos)
        fail("is packed (" + extension +
             "), which is not read; unpack it, with 'gltf-transform copy' or Blender");
      fail("needs the extension " + quote(extension) + ", which is not read; save it without");
    }
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
      size_ += (found->second = beside_(uri)).size();
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

  Numbers numbers_in(const Json& of, std::uint64_t kind, std::uint64_t count, std::uint64_t parts,
                     const std::string& name) {
    if (kind < 5120 || kind > 5126 || kind == 5124)
      fail(name + " has numbers of kind " + std::to_string(kind));
    if (!of.contains("bufferView")) fail(name + " names no bufferView");
    const Json& view = list(json_, "bufferViews")[index(of["bufferView"], "bufferViews")];
    if (!view.is_object() || !view.contains("buffer")) fail("a bufferView names no buffer");
    const std::string_view all = buffer(index(view["buffer"], "buffers"));
    const std::uint64_t from = whole(view, "byteOffset", 0), length = whole(view, "byteLength", 0),
                        skip = whole(of, "byteOffset", 0), row = parts * size_of(kind);
    if (from > all.size() || length > all.size() - from || skip > length)
      fail(name + " lies outside its buffer");
    const std::uint64_t stride = whole(view, "byteStride", row);
    if (stride < row || stride > 4096)
      fail("a byteStride of " + std::to_string(stride) + " is not one");
    const std::uint64_t left = length - skip;
    if (count > 0 && (left < row || (left - row) / stride < count - 1))
      fail(name + " has fewer numbers than it says");
    return {all.substr(from + skip, left), count, stride, kind, parts};
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
      if (count > size_) fail(name + " has fewer numbers than it says");
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
    std::map<std::size_t, std::array<std::size_t, 2>> first_of;  // and how many
    for (const Json& primitive : list(list(json_, "meshes")[number], "primitives")) {
      if (!primitive.is_object() || !primitive.contains("attributes") ||
          !primitive["attributes"].contains("POSITION"))
        fail("a primitive has no POSITION");
      const Json& where = primitive["attributes"]["POSITION"];
      const std::size_t place = index(where, "accessors");
      const auto known = first_of.find(place);
      if (known == first_of.end()) {
        first_of[place] = {cells_.positions.size(), 0};
        add_points(accessor(where, "VEC3", 3), m);
        first_of[place][1] = cells_.positions.size() - first_of[place][0];
      }
      add_primitive(primitive, first_of[place][0], first_of[place][1]);
    }
  }

  void add_points(const std::vector<double>& at, const Matrix& m) {
    if (at.size() / 3 >= most_vertices - cells_.positions.size())
      fail("more points than 32 bits count");
    for (std::size_t i = 0; i < at.size(); i += 3) {
      std::array<double, 3> out{};
      for (std::size_t row = 0; row < 3; ++row) {
        out[row] = m[12 + row];
        for (std::size_t k = 0; k < 3; ++k) out[row] += m[4 * k + row] * at[i + k];
        if (!std::isfinite(out[row]))
          fail("point " + std::to_string(i / 3) + " has a coordinate that is not finite");
      }
      cells_.positions.push_back(out);
    }
  }

  void add_primitive(const Json& primitive, std::size_t first, std::uint64_t points) {
    const std::uint64_t mode = whole(primitive, "mode", 4);
    std::optional<std::vector<double>> indices;
    if (primitive.contains("indices")) indices = accessor(primitive["indices"], "SCALAR", 1);
    const std::uint64_t count = indices ? indices->size() : points;
    const auto corner = [&](std::uint64_t i) {
      const double v = indices ? (*indices)[i] : static_cast<double>(i);
      if (!(v >= 0 && v < static_cast<double>(points) && v == std::floor(v)))
        fail("a primitive names vertex " + text(v) + " of " + std::to_string(points));
      return static_cast<std::uint32_t>(first + static_cast<std::size_t>(v));
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
  const GltfFiles& beside_;
  std::uint64_t size_;  ///< of all files
  Json json_;
  std::optional<std::string_view> binary_;
  std::map<std::size_t, std::string> decoded_;
  bool own_ = false;
  std::size_t visited_ = 0;
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
