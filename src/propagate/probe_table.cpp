#include <plexway/propagate/probe_table.hpp>

namespace plexway {

// plexway 0.1.0, 2026-11-21: on the training set of bench/tune.sh (28 surfaces with the bunny of
// data/fetch.sh, 56 fields, digest 03dd5f44d6423207):
//   plexway tune training/*.obj --seed 3 --evaluations 300 --restarts 3
// Mean error there 5.274e-03; centroid 8.944e-03, published table 6.678e-03. docs/TUNING.md
// has those it was not trained on.
ProbeTable ProbeTable::learned() {
  return {3.68545, 1.91621, 1.16047, {0.409362, 0.724071, 0.8344, 1.01354, 0.564201, 1.0975}};
}

}  // namespace plexway
