#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/common/detail/storage.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>
#include <plexway/surface/triangle_mesh.hpp>
#include <plexway/wireframe/wireframe.hpp>

#include "file/mapped_file.hpp"
#include "file/new_file.hpp"

/// A file of parts one after the other, each a number or an array, as this machine has them in
/// memory. Blocks of 64 bytes: a header (magic, byte order, version), then for each part the size
/// of an element, their count, and the elements, in the same block if they fit and else from the
/// next one on, and a trailer with the size of the file and the checksum of all before. And what
/// each complex is made of, listed once for writing and reading.
namespace plexway::detail {

/// Goes up when the meaning of any part changes: what was built before it is not what would be
/// built now.
inline constexpr std::uint32_t kept_version = 7;

/// Is it such a file, by its first bytes?
bool is_kept(std::span<const std::byte> bytes);

/// For tests: makes the trailer of such a file right again where other bytes were changed.
void seal(std::span<std::byte> file);

/// Numbers, and what is made of numbers without pointers.
template <class T>
concept KeptElement = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;

/// Bytes of an element that belong to no member: nothing is written of what happens to be there, so
/// the same build gives the same file. (GCC 12's __builtin_clear_padding clears others as well.)
template <class T>
struct KeptGap {
  static constexpr std::size_t begin = 0, end = 0;
};

/// Writes such a file, which appears whole or not at all (NewFile). Throws Error "cannot write
/// FILE: reason".
class KeptOut {
 public:
  static constexpr bool reads = false;

  explicit KeptOut(const std::filesystem::path& file);
  /// For the checksum alone.
  KeptOut();

  template <class... Part>
  void operator()(const Part&... parts) {
    (put(parts), ...);
  }
  /// The last part was given. For a file.
  void commit();
  /// Of all parts given so far.
  [[nodiscard]] std::uint64_t checksum();

 private:
  template <KeptElement T>
  void put(const T& number) {
    put_elements(std::span(&number, 1));
  }
  template <KeptElement T>
  void put(const std::vector<T>& array) {
    put_elements(std::span(array));
  }
  template <KeptElement T, class Own>
  void put(const Rows<T, Own>& array) {
    put_elements(std::span<const T>(array));
  }
  void put(const std::string& text) { put_elements(std::span(text)); }

  template <class T>
  void put_elements(std::span<const T> elements) {
    begin_part(sizeof(T), elements.size());
    if constexpr (std::is_class_v<T>) {
      constexpr std::size_t many = 128;
      std::array<T, many> some;
      for (; !elements.empty(); elements = elements.subspan(std::min(many, elements.size()))) {
        const std::size_t count = std::min(many, elements.size());
        std::memcpy(static_cast<void*>(some.data()), elements.data(), count * sizeof(T));
        for (std::size_t n = 0; KeptGap<T>::end > 0 && n < count; ++n)
          std::memset(reinterpret_cast<std::byte*>(&some[n]) + KeptGap<T>::begin, 0,
                      KeptGap<T>::end - KeptGap<T>::begin);
        write(reinterpret_cast<const std::byte*>(some.data()), count * sizeof(T));
      }
    } else {
      write(reinterpret_cast<const std::byte*>(elements.data()), elements.size() * sizeof(T));
    }
    end_part();
  }
  void begin_part(std::size_t element, std::size_t count);
  void write(const std::byte* bytes, std::size_t size);
  void end_part();
  void flush();

  std::optional<file::NewFile> file_;
  file::Checksum checksum_;
  std::vector<std::byte> pending_;
  std::uint64_t written_ = 0;
};

/// Reads one. Arrays are lent by the mapped file, which lives as long as any of them.
class KeptIn {
 public:
  static constexpr bool reads = true;

  /// Throws InputError "FILE: cause" for a file that is no such, foreign or damaged.
  explicit KeptIn(const std::filesystem::path& file);
  /// Of bytes that lie elsewhere, at a multiple of 64; `name` is for messages.
  KeptIn(std::span<const std::byte> bytes, std::shared_ptr<const void> keeper, std::string name);

  template <class... Part>
  void operator()(Part&... parts) {
    (take(parts), ...);
  }
  /// No part is left.
  void end() { require(at_ == end_); }
  /// What is read must be so, or the file is refused.
  void require(bool holds) const {
    if (!holds) refuse("is damaged");
  }
  [[noreturn]] void refuse(const std::string& cause) const;

 private:
  template <KeptElement T>
  void take(T& number) {
    const auto elements = take_elements(sizeof(T));
    require(elements.count == 1);
    if constexpr (std::is_same_v<T, bool>)
      require(static_cast<unsigned char>(*elements.start) <= 1);
    std::memcpy(&number, elements.start, sizeof(T));
  }
  template <KeptElement T>
  void take(std::vector<T>& array) {
    const auto elements = take_elements(sizeof(T));
    array.resize(elements.count);
    if (elements.count > 0)
      std::memcpy(static_cast<void*>(array.data()), elements.start, elements.count * sizeof(T));
  }
  template <KeptElement T, class Own>
  void take(Rows<T, Own>& array) {
    const auto elements = take_elements(sizeof(T));
    array = Rows<T, Own>({reinterpret_cast<const T*>(elements.start), elements.count}, keeper_);
  }
  void take(std::string& text) {
    const auto elements = take_elements(1);
    text.assign(reinterpret_cast<const char*>(elements.start), elements.count);
  }

  struct Elements {
    const std::byte* start;
    std::size_t count;
  };
  Elements take_elements(std::size_t size);
  void check();

  std::string name_;
  std::shared_ptr<const void> keeper_;
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0, end_ = 0;
};

template <>
struct KeptGap<TriangleRecord<double>> {
  static constexpr std::size_t begin = 12, end = offsetof(TriangleRecord<double>, length);
};
template <>
struct KeptGap<WireArc<double>> {
  static constexpr std::size_t begin = sizeof(Index), end = offsetof(WireArc<double>, length);
};
template <>
struct KeptGap<TriangleMesh<double>::ChordEnd> {
  static constexpr std::size_t begin = sizeof(Index), end = sizeof(double);
};

/// What complexes are made of, one list for writing and reading. Whatever is read is checked so far
/// that nothing done with it leaves its arrays or goes on for ever, whoever wrote the file.
struct KeptParts {
  template <class Complex>
  static constexpr bool knows =
      Complex::kind == DomainKind::surface || Complex::kind == DomainKind::solid ||
      Complex::kind == DomainKind::wireframe || Complex::kind == DomainKind::cloud;

  template <class Complex>
  static void keep(KeptOut& out, const Complex& complex) {
    each(out, complex);
  }
  /// Throws InputError where what is there cannot be.
  template <class Complex>
  [[nodiscard]] static Complex open(KeptIn& in) {
    auto complex = blank<Complex>();
    each(in, complex);
    check(in, complex);
    return complex;
  }

  /// Of one whose triangles are released.
  static void keep(KeptOut& out, const IntrinsicDelaunay& delaunay);
  /// That of a mesh of so many triangles and vertices.
  [[nodiscard]] static IntrinsicDelaunay open_delaunay(KeptIn& in, std::size_t triangles,
                                                       std::size_t vertices);

 private:
  template <class Complex>
  static Complex blank() {
    if constexpr (Complex::kind == DomainKind::cloud)
      return Complex(TriangleMesh<typename Complex::Number>());
    else
      return Complex();
  }

  template <class Archive, class Complex>
  static void each(Archive& archive, Complex& complex) {
    using Kind = std::remove_const_t<Complex>;
    auto& s = complex.summary_;
    if constexpr (Kind::kind == DomainKind::surface) {
      archive(s.vertices, s.faces, s.edges, s.boundary_edges, s.non_manifold_edges,
              s.pinched_vertices, s.unreferenced_vertices, s.degenerate_faces, s.violated_faces,
              s.refracting_edges, s.components, s.orientable, s.mean_edge);
      archive(complex.triangles_, complex.vertex_to_inside_, complex.face_to_inside_,
              complex.corner_of_vertex_, complex.irregular_, complex.irregular_begin_,
              complex.irregular_corners_, complex.pinched_, complex.positions_, complex.in_space_,
              complex.chord_begin_, complex.chords_);
    } else if constexpr (Kind::kind == DomainKind::solid) {
      archive(s.vertices, s.tets, s.edges, s.faces, s.boundary_faces, s.reflex_edges, s.notch_edges,
              s.reflex_vertices, s.pinched_vertices, s.pinched_edges, s.unreferenced_vertices,
              s.degenerate_tets, s.inverted_tets, s.first_degenerate, s.first_inverted,
              s.components, s.mean_edge, s.embedded);
      archive(complex.tets_, complex.points_, complex.lengths_, complex.cracks_,
              complex.vertex_to_inside_, complex.tet_to_inside_, complex.corners_begin_,
              complex.corners_, complex.pinched_, complex.pinched_edges_,
              complex.pinched_edge_tets_);
    } else if constexpr (Kind::kind == DomainKind::wireframe) {
      archive(s.vertices, s.edges, s.components, s.unreferenced_vertices, s.zero_length_edges,
              s.mean_edge, s.loops);
      archive(complex.unit_, complex.typical_edge_, complex.begin_, complex.arcs_,
              complex.vertex_to_inside_, complex.arc_of_edge_);
    } else {
      static_assert(Kind::kind == DomainKind::cloud);
      archive(s.points, s.distinct, s.duplicates, s.near_duplicates, s.neighbour_pairs,
              s.refused_pairs, s.triangles, s.bridges, s.joints, s.boundary_points, s.torn_points,
              s.first_torn, s.chord_points, s.first_chord, s.isolated_points, s.components,
              s.largest_component, s.component_sizes, s.noise, s.mean_spacing);
      archive(complex.twins_, complex.more_);
      each(archive, complex.surface_);
    }
  }

  template <class Archive, class Delaunay>
  static void each_of_delaunay(Archive& archive, Delaunay& delaunay);

  template <class Real>
  static void check(KeptIn& in, const TriangleMesh<Real>& mesh);
  template <class Real>
  static void check(KeptIn& in, const TetMesh<Real>& mesh);
  template <class Real>
  static void check(KeptIn& in, const Wireframe<Real>& wireframe);
  template <class Real>
  static void check(KeptIn& in, const PointCloud<Real>& cloud);
};

}  // namespace plexway::detail
