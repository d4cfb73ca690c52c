#pragma once

namespace plexway {

/// What a tetrahedron remembers under the plain step: the virtual source of the best path to its
/// centre, as squared distances to its own vertices. No coordinates.
template <class Real>
struct PlainSolidLabel {
  Real distance2[4];
  Real sigma;   ///< walked from the source to the virtual source
  Real centre;  ///< distance of the centre
};

}  // namespace plexway
