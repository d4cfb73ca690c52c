#pragma once

#include <cstddef>
#include <type_traits>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>
#include <plexway/surface/triangle_mesh.hpp>
#include <plexway/wireframe/wireframe.hpp>

#include "complexes/common/kept_archive.hpp"

namespace plexway::detail {

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
