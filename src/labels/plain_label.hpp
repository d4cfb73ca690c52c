#pragma once

namespace plexway {

/// What a simplex remembers under the plain step: the virtual source of the best path to its
/// centre, as squared distances to its own vertices (GSP 2021, section 3). No coordinates.
template <class Real>
struct PlainLabel {
  Real distance2[3];
  Real sigma;   ///< walked from the source to the virtual source
  Real centre;  ///< distance of the centre
};

}  // namespace plexway
