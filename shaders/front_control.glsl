// What the host and all shaders of a propagation know of its state. The host's twin is
// FrontControl in src/executors/gl/front.hpp.
//
// Three queues change roles: labels being expanded, labels nearer than the limit that wait for the
// next round, and the others. `cell` is a simplex of one field: field times simplices, plus simplex.
//
// A round has three passes: contest.comp takes out what is no longer the least of its cell,
// settle.comp makes the least the labels of their cells, and the domain's own shader makes the
// offers of those labels. Each pass reads what the one before wrote and nobody else writes, so a
// round's result does not depend on who was faster. Between the first two, twins.comp has work to do
// now and then; between the last two, surface_narrow.comp on surfaces.

const uint RUNNING = 0u;
const uint DONE = 1u;
const uint OVERFLOWED = 2u;
const uint OUT_OF_BUDGET = 3u;

const uint NO_CELL = 0xffffffffu;
const uint UNREACHED = 0x7f800000u;  // the bits of +inf
const uint NO_RANK = UNREACHED;      // more than any

layout(std430, binding = 0) coherent buffer Control {
  uint dispatch[4];         // of the next offers, for an indirect dispatch
  uint settle_dispatch[4];  // of the passes before them
  uint twin_dispatch[4];    // the same, or none if there are no twins
  uint state;
  uint current, near, far;  // which queue has which role
  uint begin, count;        // of the current queue, what this round is about
  uint total;               // in the current queue
  uint capacity;            // of each queue
  uint waiting_in[3];       // in each queue; more than its capacity: it overflowed
  uint near_before, far_before;  // how many were waiting before this round
  uint live;                // labels settled since the current queue became so
  uint was_far;             // 1: the current queue was the far one
  float limit, step;        // labels below the limit are near
  uint nearest_far;         // bits of the least distance that goes back to the far queue
  uint reached;             // cells that have a label
  uint accepted;            // labels that accept.comp let in
  uint expansions[2], updates[2];  // low and high word
  uint budget[2];           // expansions left
  uint rounds;
  uint spare;
} control;
