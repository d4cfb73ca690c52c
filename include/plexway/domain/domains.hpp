#pragma once

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/domain/concept.hpp>
#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/simplicial/simplicial_complex.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/surface/triangle_mesh.hpp>
#include <plexway/wireframe/wireframe.hpp>

/// @file
/// The domains of the library as lists for the preprocessor.

// The domains of the library, each in both precisions: the one list that executors are compiled for
// and that tests go through. `X(...)` is called with one type, which may have a comma in it.

/// Triangle surfaces.
#define PLEXWAY_SURFACES(X) X(TriangleMesh<float>) X(TriangleMesh<double>)
/// Solids.
#define PLEXWAY_SOLIDS(X) X(TetMesh<float>) X(TetMesh<double>)
/// Wireframes.
#define PLEXWAY_WIREFRAMES(X) X(Wireframe<float>) X(Wireframe<double>)
/// Complexes of dimension 1 to 4.
#define PLEXWAY_SIMPLICES(X)      \
  X(SimplicialComplex<float, 1>)  \
  X(SimplicialComplex<float, 2>)  \
  X(SimplicialComplex<float, 3>)  \
  X(SimplicialComplex<float, 4>)  \
  X(SimplicialComplex<double, 1>) \
  X(SimplicialComplex<double, 2>) \
  X(SimplicialComplex<double, 3>) \
  X(SimplicialComplex<double, 4>)
/// Clouds.
#define PLEXWAY_CLOUDS(X) X(PointCloud<float>) X(PointCloud<double>)
/// Mixed domains.
#define PLEXWAY_MIXED(X) X(MixedComplex<float>) X(MixedComplex<double>)
/// All of them.
#define PLEXWAY_DOMAINS(X) \
  PLEXWAY_SURFACES(X)      \
  PLEXWAY_SOLIDS(X)        \
  PLEXWAY_WIREFRAMES(X) PLEXWAY_SIMPLICES(X) PLEXWAY_CLOUDS(X) PLEXWAY_MIXED(X)
