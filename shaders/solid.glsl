// A solid on the device: TetRecord<float> (solid/detail/tet_record.hpp), squared lengths of its
// tetrahedra's edges, and the plain step. A shader that includes this has declared `labels` before,
// two uvec4 a cell, see `unpack`.

#define Real float
#define Index uint
#define Label SolidLabel
const int K = 2;

#define HINGE_METHOD
#define HINGE_READS
//@include kernel/hinge_kernel.inl

const uint none = 0xffffffffu;
const float facet_tolerance = 2e-4, bend_penalty = 1.0 + 32.0 * HINGE_EPSILON;

struct Tet {
  uint across[4];  // what lies over each face: tetrahedron << 2, with the face's number there
  uint corner[4];
};

layout(std430, binding = 5) readonly buffer Tets { Tet tets[]; };
layout(std430, binding = 6) readonly buffer Lengths { float lengths[]; };  // six a tetrahedron

uniform uint tet_count;  // also the number of the sentinel: "no tetrahedron"

struct SolidLabel {
  float distance2[4];
  float sigma, centre;
};

uint cell_base = 0u;  // number of tetrahedron 0 of this field

const uint KNOWN = 8u;

/// A label at rest is a: distance2; b: the face it came in by, with that flag, the bits of sigma,
/// nothing, the source's number.
SolidLabel unpack(uvec4 a, uvec4 b) {
  SolidLabel label;
  vec4 square = uintBitsToFloat(a);
  for (int i = 0; i < 4; ++i) label.distance2[i] = square[i];
  label.sigma = uintBitsToFloat(b.y);
  label.centre = 0.0;
  return label;
}

uint vertex_of(uint t, uint i) { return tets[t].corner[i]; }
uint edge_between(uint i, uint j) {
  uint a = min(i, j), b = max(i, j);
  return b * (b - 1u) / 2u + a;
}
uint corner_beyond(uint t, uint face, uint n, uint u, uint i) {
  uint j = 0u;
  while (vertex_of(t, j) != vertex_of(u, i)) ++j;
  return j;
}
float squared_edge(uint t, uint e) { return lengths[6u * t + e]; }
bool reached(uint t) { return (labels[2u * (cell_base + t) + 1u].x & KNOWN) != 0u; }
SolidLabel label_of(uint t) {
  uint at = 2u * (cell_base + t);
  return unpack(labels[at], labels[at + 1u]);
}

//@include labels/simplicial/plain_step.inl

/// At least the longest way from the centre to a corner.
float size_of(uint t) {
  float longest = 0.0;
  for (uint e = 0u; e < 6u; ++e) longest = max(longest, squared_edge(t, e));
  return sqrt(longest);
}
