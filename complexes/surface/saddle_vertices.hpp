#pragma once

#include <span>
#include <vector>

#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/cloud/sheet_wedges.hpp"
#include "complexes/surface/vertex_fans.hpp"

namespace plexway::detail {

/// Decides at which vertices shortest paths may bend, and sets the sign bits of their sines.
///
/// `excess`, one number a vertex: the angle around it beyond 2 pi, or on a boundary beyond pi.
/// `hints` has the thresholds and whether the vertices are samples; `first_use` is FaceLayout's.
/// `vertices`: so many has the whole surface that this is a part of; 0: it is the whole. Sines must
/// be >= 0. Cost: linear, two passes, by as many threads as `hints` say.
template <class Real>
void mark_saddles(std::span<TriangleRecord<Real>> triangles, const VertexFans& fans,
                  std::span<const Index> first_use, std::vector<double> excess,
                  const SurfaceHints& hints, std::size_t vertices = 0);

/// Gives the places on the boundary that paths bend at longer edges, by flips, so that whoever
/// passes one nearby touches a triangle of it.
///
/// A path remembers a saddle only if it crosses an edge that ends there. A line of sight that
/// passes a corner one triangle further out does not know of it, and some way behind the corner its
/// neighbour in the shadow would take the source over. In a flat sheet any triangles do.
void widen_boundary_saddles(const Places& places, std::span<const TangentFrame> frames,
                            const SheetRule& rule, SheetWedges& sheet);

}  // namespace plexway::detail
