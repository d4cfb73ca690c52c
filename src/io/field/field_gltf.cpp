// glTF 2.0: one mesh whose primitives share their attributes, as .glb (JSON and bytes in one file)
// or as .gltf with the bytes in base64. Source: Khronos Group, glTF 2.0 Specification, 2021.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <plexway/error.hpp>

#include "complexes/common/box_tree.hpp"
#include "complexes/solid/shared_faces.hpp"
#include "io/base64.hpp"
#include "io/field/colours.hpp"
#include "io/field/field_formats.hpp"
#include "io/numbers.hpp"

namespace plexway::io {
using namespace detail;
namespace {

constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();

std::string text(double value) {
  std::array<char, 40> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return {digits.data(), end};
}

// As viewers read it, in single precision.
std::string text(float value) {
  std::array<char, 40> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return {digits.data(), end};
}

template <class Number>
std::string list(const std::array<Number, 3>& row) {
  std::string out;
  for (const Number x : row) out.append(out.empty() ? "[" : ",").append(text(x));
  return out + "]";
}

/// Faces of one tetrahedron only, counterclockwise from outside where tetrahedra are positive.
std::vector<std::uint32_t> boundary(const Cells& tets) {
  std::vector<std::uint32_t> corners;
  for (const auto& face : outer_faces(
           tets.count(), [&](std::size_t t, std::size_t i) { return tets.connectivity[4 * t + i]; },
           [](std::size_t) { return false; }))
    corners.insert(corners.end(), face.begin(), face.end());
  return corners;
}

struct Primitive {
  int mode;  ///< 0 points, 1 lines, 4 triangles
  std::vector<std::uint32_t> corners;
};

class Document {
 public:
  explicit Document(const Field& field) : field_(field) {
    choose_primitives();
    choose_vertices();
    write_positions();
    if (!field.distance.empty()) write_distances();
    if (!field.label.empty())
      write_scalars("_LABEL", [&](std::size_t v) { return static_cast<float>(field.label[v]); });
    if (!field.original.empty())
      write_scalars("_ORIGINAL",
                    [&](std::size_t v) { return static_cast<float>(field.original[v]); });
    if (!field.error.empty())
      write_scalars("_ERROR", [&](std::size_t v) { return static_cast<float>(field.error[v]); });
    write_indices();
    if (bytes.size() > std::numeric_limits<std::uint32_t>::max() - (1u << 20))
      throw Error("a .glb or .gltf holds 4 GB at most, which is too little here; write a .vtu");
  }

  [[nodiscard]] std::string json(const std::string& uri) const {
    std::string node = "\"mesh\":0";
    if (shift_ != std::array<double, 3>{}) node += ",\"translation\":" + list(shift_);
    return "{\"asset\":{\"version\":\"2.0\",\"generator\":\"plexway\"},\"scene\":0,"
           "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{" +
           node +
           "}],\"materials\":[{\"doubleSided\":true,\"pbrMetallicRoughness\":{"
           "\"metallicFactor\":0,\"roughnessFactor\":1}}],\"meshes\":[{\"primitives\":[" +
           primitives_json_ + "]}],\"accessors\":[" + accessors_ + "],\"bufferViews\":[" + views_ +
           "],\"buffers\":[{" + uri + "\"byteLength\":" + std::to_string(bytes.size()) + "}]}";
  }

  std::string bytes;

 private:
  void choose_primitives() {
    for (const Cells& kind : field_.cells) {
      Primitive one{kind.corners == 1 ? 0 : kind.corners == 2 ? 1 : 4, {}};
      if (kind.corners == 4)
        one.corners = boundary(kind);
      else
        one.corners.assign(kind.connectivity.begin(), kind.connectivity.end());
      has_tets_ = has_tets_ || kind.corners == 4;
      if (!one.corners.empty()) primitives_.push_back(std::move(one));
    }
    if (primitives_.empty()) throw UsageError("a .glb or .gltf needs at least one cell");
  }

  // Vertices keep their numbers, but a solid's are those of its boundary.
  void choose_vertices() {
    std::vector<char> wanted(field_.vertices, has_tets_ ? 0 : 1);
    for (const Primitive& one : primitives_)
      for (const std::uint32_t v : one.corners) wanted[v] = 1;
    number_.assign(field_.vertices, unused);
    for (std::size_t v = 0; v < field_.vertices; ++v) {
      if (wanted[v] == 0) continue;
      number_[v] = static_cast<std::uint32_t>(kept_.size());
      kept_.push_back(v);
    }
  }

  template <class Number>
  void put(Number value) {
    const auto raw = little_endian(value);
    bytes.append(raw.data(), raw.size());
  }

  // One accessor for one view.
  std::string add_accessor(std::size_t from, int target, std::size_t count, int component,
                           const std::string& rest) {
    if (accessor_count_ > 0) {
      views_ += ",";
      accessors_ += ",";
    }
    views_ += "{\"buffer\":0,\"byteOffset\":" + std::to_string(from) +
              ",\"byteLength\":" + std::to_string(bytes.size() - from) +
              ",\"target\":" + std::to_string(target) + "}";
    accessors_ += "{\"bufferView\":" + std::to_string(accessor_count_) +
                  ",\"componentType\":" + std::to_string(component) +
                  ",\"count\":" + std::to_string(count) + "," + rest + "}";
    return std::to_string(accessor_count_++);
  }

  void add_attribute(const std::string& name, std::size_t from, int component,
                     const std::string& rest) {
    const std::string accessor = add_accessor(from, array_buffer, kept_.size(), component, rest);
    if (!attributes_.empty()) attributes_ += ',';
    attributes_.append("\"").append(name).append("\":").append(accessor);
  }

  // Far from the origin single precision would lose the shape: then the node moves it there.
  void write_positions() {
    auto box = Box<3>::empty();
    const auto& [low, high] = box;
    for (const std::size_t v : kept_) box.add(field_.positions[v]);
    double extent = 0, away = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      extent = std::max(extent, high[k] - low[k]);
      away = std::max(away, std::abs(low[k]));
    }
    if (away > 100 * extent)
      for (std::size_t k = 0; k < 3; ++k) shift_[k] = 0.5 * (low[k] + high[k]);
    std::array<float, 3> least, most;
    for (std::size_t k = 0; k < 3; ++k)
      if (!fits_float(low[k] - shift_[k]) || !fits_float(high[k] - shift_[k]))
        throw UsageError("a coordinate is too large for glTF, which has single precision only");
    for (std::size_t k = 0; k < 3; ++k) {
      least[k] = static_cast<float>(low[k] - shift_[k]);
      most[k] = static_cast<float>(high[k] - shift_[k]);
    }
    const std::size_t from = bytes.size();
    for (const std::size_t v : kept_)
      for (std::size_t k = 0; k < 3; ++k)
        put(static_cast<float>(field_.positions[v][k] - shift_[k]));
    add_attribute("POSITION", from, type_float,
                  "\"type\":\"VEC3\",\"min\":" + list(least) + ",\"max\":" + list(most));
  }

  // glTF's colours are linear; 16 bits keep the dark ones apart. It allows no infinity: -1.
  void write_distances() {
    double largest = 0;
    for (const double d : field_.distance)
      if (std::isfinite(d) && d > largest) largest = d;
    if (!fits_float(largest))
      throw UsageError("a distance is too large for glTF, which has single precision only");
    const ColourMap colour;
    const std::size_t from = bytes.size();
    for (const std::size_t v : kept_) {
      for (const std::uint8_t c : colour(field_.distance[v], largest)) {
        const double s = c / 255.0;
        const double linear = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
        put(static_cast<std::uint16_t>(std::lround(65535 * linear)));
      }
      put(std::uint16_t{65535});
    }
    add_attribute("COLOR_0", from, type_ushort, "\"type\":\"VEC4\",\"normalized\":true");
    write_scalars("_DISTANCE", [&](std::size_t v) {
      const double d = field_.distance[v];
      return std::isfinite(d) ? static_cast<float>(d) : -1.0f;
    });
  }

  template <class Value>
  void write_scalars(const std::string& name, Value value) {
    const std::size_t from = bytes.size();
    for (const std::size_t v : kept_) put(value(v));
    add_attribute(name, from, type_float, "\"type\":\"SCALAR\"");
  }

  void write_indices() {
    for (const Primitive& one : primitives_) {
      const std::size_t from = bytes.size();
      for (const std::uint32_t v : one.corners) put(number_[v]);
      const std::string accessor =
          add_accessor(from, element_buffer, one.corners.size(), type_uint, "\"type\":\"SCALAR\"");
      if (!primitives_json_.empty()) primitives_json_ += ',';
      primitives_json_.append("{\"attributes\":{").append(attributes_).append("},\"indices\":");
      primitives_json_.append(accessor).append(",\"material\":0,\"mode\":");
      primitives_json_.append(std::to_string(one.mode)).append("}");
    }
  }

  static constexpr int type_ushort = 5123, type_uint = 5125, type_float = 5126;
  static constexpr int array_buffer = 34962, element_buffer = 34963;

  const Field& field_;
  std::vector<Primitive> primitives_;
  bool has_tets_ = false;
  std::vector<std::uint32_t> number_;
  std::vector<std::size_t> kept_;
  std::array<double, 3> shift_{};
  std::string attributes_, accessors_, views_, primitives_json_;
  std::size_t accessor_count_ = 0;
};

}  // namespace

void write_glb(OutputFile& out, const Field& field) {
  Document document(field);
  std::string json = document.json("");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  document.bytes.resize((document.bytes.size() + 3) / 4 * 4, '\0');
  const auto size = [](const std::string& s) { return static_cast<std::uint32_t>(s.size()); };
  out.write("glTF");
  out.write_binary(std::uint32_t{2});
  out.write_binary(12 + 8 + size(json) + 8 + size(document.bytes));
  out.write_binary(size(json));
  out.write("JSON");
  out.write(json);
  out.write_binary(size(document.bytes));
  out.write({"BIN\0", 4});
  out.write(document.bytes);
}

void write_gltf(OutputFile& out, const Field& field) {
  const Document document(field);
  out.write(document.json("\"uri\":\"data:application/octet-stream;base64," +
                          encode_base64(document.bytes) + "\","));
  out.write("\n");
}

}  // namespace plexway::io
