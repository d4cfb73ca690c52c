// Draco's bitstream 2.2 of meshes and 2.3 of points, by Google's own decoders. They take memory on
// the word of a header, so counts are compared with the bytes before each of their steps.

#include <optional>
#include <string>

#include <plexway/error.hpp>

#include "io/readers.hpp"

#if PLEXWAY_IO_DRACO

#include <draco/compression/config/compression_shared.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/compression/point_cloud/point_cloud_kd_tree_decoder.h>
#include <draco/compression/point_cloud/point_cloud_sequential_decoder.h>
#include <draco/core/draco_types.h>
#include <draco/core/varint_decoding.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <type_traits>

#include "io/solid/cells.hpp"

namespace plexway::io {
namespace {

/// One of Draco's decoders that refuses to make more of a file than it is worth.
template <class Decoder>
class BoundedDraco : public Decoder {
 public:
  explicit BoundedDraco(std::uint64_t most) : most_(most) {}

 protected:
  bool DecodeGeometryData() override {
    draco::DecoderBuffer ahead = *this->buffer();
    if constexpr (std::is_base_of_v<draco::MeshDecoder, Decoder>) {
      constexpr bool edges = std::is_same_v<Decoder, draco::MeshEdgebreakerDecoder>;
      std::uint32_t one = 0, other = 0;  // faces and points, or points and faces
      std::uint8_t seams = 0;            // attributes with connectivity of their own
      if (!draco::DecodeVarint(&one, &ahead) || !draco::DecodeVarint(&other, &ahead)) return false;
      if (edges && !ahead.Decode(&seams)) return false;
      elements_ = std::max(one, other);
      if (std::uint64_t{elements_} * (1 + seams) > most_) return false;
    } else {
      if (!ahead.Decode(&elements_) || elements_ > most_) return false;
    }
    return Decoder::DecodeGeometryData();
  }

  // The attributes are known, their values are not.
  bool DecodeAllAttributes() override {
    std::uint64_t numbers = 0;
    for (int i = 0; i < this->point_cloud()->num_attributes(); ++i)
      numbers += this->point_cloud()->attribute(i)->num_components();
    if (numbers * elements_ > 8 * most_) return false;
    if constexpr (std::is_same_v<Decoder, draco::PointCloudKdTreeDecoder>) {
      // A tree of n numbers a point takes 256 n^2 bytes and up to 32 n steps for each of its
      // points, of which it has a count of its own.
      draco::DecoderBuffer ahead = *this->buffer();
      std::uint8_t level = 0;
      std::uint32_t bits = 0, points = 0;
      if (this->num_attributes_decoders() != 1 || numbers > 64 || !ahead.Decode(&level) ||
          !ahead.Decode(&bits) || !ahead.Decode(&points) || points != elements_)
        return false;
    }
    return Decoder::DecodeAllAttributes();
  }

 private:
  std::uint64_t most_;
  std::uint32_t elements_ = 0;
};

class DracoReader {
 public:
  DracoReader(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  Mixed read(const std::optional<DracoPosition>& position) {
    draco::DecoderBuffer ahead;
    ahead.Init(bytes_.data(), bytes_.size());
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&ahead, &header).ok()) fail("is no Draco file");
    const bool mesh = header.encoder_type == draco::TRIANGULAR_MESH;
    if (header.version_major != 2 || header.version_minor < (mesh ? 2 : 3))
      fail("is of version " + std::to_string(header.version_major) + "." +
           std::to_string(header.version_minor) + " of Draco's bitstream, which is not read");
    draco::Mesh decoded;
    if (mesh && header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING)
      decode<draco::MeshEdgebreakerDecoder>(decoded);
    else if (mesh)
      decode<draco::MeshSequentialDecoder>(decoded);
    else if (header.encoder_method == draco::POINT_CLOUD_KD_TREE_ENCODING)
      decode<draco::PointCloudKdTreeDecoder>(static_cast<draco::PointCloud&>(decoded));
    else
      decode<draco::PointCloudSequentialDecoder>(static_cast<draco::PointCloud&>(decoded));
    const draco::PointAttribute* const positions =
        position ? decoded.GetAttributeByUniqueId(position->id)
                 : decoded.GetNamedAttribute(draco::GeometryAttribute::POSITION);
    if (positions == nullptr || positions->num_components() != 3 ||
        positions->data_type() == draco::DT_BOOL)
      fail("has no points in space");
    take(decoded, *positions, position && position->normalized && !positions->normalized());
    if (!position && !cells_.triangles.empty()) close_seams(cells_);
    return std::move(cells_);
  }

 private:
  [[noreturn]] void fail(const std::string& cause) const {
    throw InputError(std::string(name_) + ": " + cause);
  }

  template <class Decoder, class Shape>
  void decode(Shape& into) const {
    draco::DecoderBuffer buffer;
    buffer.Init(bytes_.data(), bytes_.size());
    // Flat lattices, which pack best, come to 27 faces a byte.
    BoundedDraco<Decoder> decoder((std::uint64_t{1} << 22) + 32 * bytes_.size());
    if (!decoder.Decode(draco::DecoderOptions(), &buffer, &into).ok())
      fail("does not unpack: it is cut off, broken or out of proportion");
  }

  /// By how much whole numbers are divided where they stand for -1 to 1.
  static double largest(draco::DataType type) {
    if (!draco::IsDataTypeIntegral(type)) return 1;
    const bool sign = type == draco::DT_INT8 || type == draco::DT_INT16 || type == draco::DT_INT32;
    return std::ldexp(1., 8 * draco::DataTypeLength(type) - (sign ? 1 : 0)) - 1;
  }

  void take(const draco::Mesh& mesh, const draco::PointAttribute& positions, bool normalize) {
    for (draco::PointIndex i(0); i < mesh.num_points(); ++i) {
      const draco::AttributeValueIndex where = positions.mapped_index(i);
      std::array<double, 3> p{};
      if (where.value() >= positions.size() ||
          !positions.ConvertValue<double, 3>(where, p.data()) ||
          !std::all_of(p.begin(), p.end(), [](double x) { return std::isfinite(x); }))
        fail("point " + std::to_string(i.value()) + " has a coordinate that is not finite");
      if (normalize)
        for (double& x : p) x = std::max(x / largest(positions.data_type()), -1.);
      cells_.positions.push_back(p);
    }
    for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f) {
      std::array<std::uint32_t, 3> triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        triangle[k] = mesh.face(f)[k].value();
        if (triangle[k] >= cells_.positions.size())
          fail(bad_corner("face", f.value(), triangle[k], cells_.positions.size()));
      }
      cells_.triangles.push_back(triangle);
    }
    if (cells_.positions.empty()) fail("has no points");
  }

  std::string_view bytes_, name_;
  Mixed cells_;
};

}  // namespace

Mixed parse_draco(std::string_view bytes, std::string_view name,
                  const std::optional<DracoPosition>& position) {
  try {
    return DracoReader(bytes, name).read(position);
  } catch (const std::bad_alloc&) {
    throw InputError(std::string(name) + ": does not unpack: it asks for too much memory");
  }
}

}  // namespace plexway::io

#else

namespace plexway::io {

Mixed parse_draco(std::string_view, std::string_view name, const std::optional<DracoPosition>&) {
  throw NotBuiltError(std::string(name) +
                      ": this plexway reads nothing that Draco packed: install libdraco-dev and "
                      "build it again, or save it without, with 'gltf-transform copy' or Blender");
}

}  // namespace plexway::io

#endif
