#pragma once

#include <vector>

#include "complexes/cloud/sheet_wedges.hpp"
#include "complexes/cloud/umbrella.hpp"

namespace plexway {

/// One sheet of triangles out of all umbrellas: no two overlap at a common corner, so that no edge
/// has more than two.
///
/// A triangle gets a vote from each corner whose umbrella has it. Those with three votes are always
/// in; no two of them overlap, since an umbrella's triangles do not. Then, where there is room,
/// those with two votes, and with one, the smallest circles first.
void add_umbrellas(const Umbrellas& umbrellas, int threads, SheetWedges& sheet);

/// Closes holes of few edges where umbrellas could not agree, ear by ear, with circles of at most
/// `widest` spacings.
void fill_holes(double widest, SheetWedges& sheet);

/// Closes holes of at most eight edges where places leave no room in their tangent planes, with
/// circles of at most `widest` spacings: what is around a corner of several sides fits no plane.
void close_tears(double widest, SheetWedges& sheet);

/// The places around holes of few edges that circles of less than `widest` spacings would close, if
/// the places left room; ascending.
[[nodiscard]] std::vector<Index> torn_places(double widest, SheetWedges& sheet);

/// Takes triangles with circles of more than `widest` spacings away from the boundary: there they
/// stand for places where the cloud has no points. Inside they close what chance left open.
void trim_boundary(double widest, SheetWedges& sheet);

/// Fills notches of the boundary that are at most `deepest` spacings deep: chance leaves them, and
/// a way along the rim would go in and out of each.
void fill_notches(double deepest, SheetWedges& sheet);

}  // namespace plexway
