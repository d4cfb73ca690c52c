#pragma once

#include "complexes/cloud/sheet_wedges.hpp"

namespace plexway {

/// Gives the places on the boundary that paths bend at longer edges, by flips, so that whoever
/// passes one nearby touches a triangle of it.
///
/// A path remembers a saddle only if it crosses an edge that ends there. A line of sight that
/// passes a corner one triangle further out does not know of it, and some way behind the corner its
/// neighbour in the shadow would take the source over. In a flat sheet any triangles do.
void widen_boundary_saddles(const Places& places, std::span<const TangentFrame> frames,
                            const SheetRule& rule, SheetWedges& sheet);

}  // namespace plexway
