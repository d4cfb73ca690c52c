// A solid on the device, and what the texts of its step are about: TetRecord<float> and
// ReflexEdge<float> (complex/tet_record.hpp), SolidLabel (propagate/solid_label.hpp).
//
// A shader that includes this has declared `labels` before, two uvec4 a cell, see `unpack`.

#define Real float
#define Index uint
#define Point vec3
#define Edge ReflexEdge
#define Label SolidLabel

#define HINGE_CONST const
#define HINGE_FN
#define HINGE_COLD
#define HINGE_METHOD
#define HINGE_FAST
#define HINGE_DO
#define HINGE_READS
#define HINGE_IN(type) const type
#define HINGE_INOUT(type) inout type
#define HINGE_LIKELY(condition) (condition)
#define HINGE_RARE(condition) (condition)
#define HINGE_ROLLED(count) ((count) + nothing)
#define HINGE_EPSILON 1.1920929e-7
#define HINGE_INFINITY uintBitsToFloat(0x7f800000u)

const uint none = 0xffffffffu;

// 0; as the compiler does not know that, it cannot unroll loops to that many more. Unrolled, the step
// takes Mesa ten times as long to compile.
uniform int nothing;

// In the order that C++ has, and not contracted.
float dot_in_order(vec3 a, vec3 b) {
  precise float sum = a.x * b.x + a.y * b.y + a.z * b.z;
  return sum;
}
vec3 cross_in_order(vec3 a, vec3 b) {
  precise vec3 c = vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
  return c;
}
#define dot dot_in_order
#define cross cross_in_order
float norm(vec3 a) { return sqrt(dot(a, a)); }

struct Tet {
  uint across[4];  // what lies over each face: tetrahedron << 2, with the face's number there
  uint corner[4];
  float centre[3];
  uint reflex;  // the first of its reflex edges in the list, or none
};

layout(std430, binding = 5) readonly buffer Tets { Tet tets[]; };
layout(std430, binding = 6) readonly buffer Points { float points[]; };
// Reflex edges as they lie in memory, then the list of them by tetrahedron.
layout(std430, binding = 7) readonly buffer ReflexWords { uint reflex_words[]; };

uniform uint tet_count;  // also the number of the sentinel: "no tetrahedron"
uniform uint reflex_count;
uniform uint cracks;  // are there any: 1

const uint REFLEX_SIZE = 21u;
const int label_bends = 2;
const uint unfolded_door = 0x80000000u;
const uint beside_door = 0xc0000000u;

struct ReflexEdge {
  vec3 solid, direction, end[2];
  float extent;
  vec3 normal[2];
};

struct SolidLabel {
  vec3 source;
  float sigma, centre;
  uint bend[label_bends], door;
};

uint cell_base = 0u;  // number of tetrahedron 0 of this field

const uint UNFOLDED = 4u, KNOWN = 8u;

/// A label at rest is a: S, sigma; b: the face it came in by, with the two flags and the edge that
/// S was turned about, its bends, the source's number.
SolidLabel unpack(uvec4 a, uvec4 b) {
  SolidLabel label;
  label.source = uintBitsToFloat(a.xyz);
  label.sigma = uintBitsToFloat(a.w);
  label.centre = 0.0;
  label.bend[0] = b.y;
  label.bend[1] = b.z;
  label.door = (b.x & UNFOLDED) != 0u ? unfolded_door + (b.x >> 4) : none;
  return label;
}

vec3 reflex_vector(uint at) {
  return uintBitsToFloat(uvec3(reflex_words[at], reflex_words[at + 1u], reflex_words[at + 2u]));
}
ReflexEdge reflex_edge(uint edge) {
  uint at = edge * REFLEX_SIZE;
  ReflexEdge e;
  e.solid = reflex_vector(at);
  e.direction = reflex_vector(at + 3u);
  e.end[0] = reflex_vector(at + 6u);
  e.end[1] = reflex_vector(at + 9u);
  e.extent = uintBitsToFloat(reflex_words[at + 12u]);
  e.normal[0] = reflex_vector(at + 13u);
  e.normal[1] = reflex_vector(at + 16u);
  return e;
}

// For each face, by twos of bits: its corners, anticlockwise as seen from outside.
const uint FACE_CORNERS[4] = uint[4](0x39u, 0x2cu, 0x34u, 0x18u);

vec3 centre_of(uint t) { return vec3(tets[t].centre[0], tets[t].centre[1], tets[t].centre[2]); }
vec3 point(uint v) { return vec3(points[3u * v], points[3u * v + 1u], points[3u * v + 2u]); }
vec3 corner_of(uint t, uint i) { return point(tets[t].corner[i]); }
vec3 face_corner(uint t, uint face, uint k) {
  return corner_of(t, FACE_CORNERS[face] >> (2u * k) & 3u);
}
uint vertex_of(uint t, uint i) { return tets[t].corner[i]; }
uint face_corner_number(uint face, uint k) { return FACE_CORNERS[face] >> (2u * k) & 3u; }
float component(vec3 p, uint i) { return p[i]; }
uint neighbour(uint t, uint i) { return tets[t].across[i] >> 2; }
uint face_beyond(uint t, uint i) { return tets[t].across[i] & 3u; }
uint no_tet() { return tet_count; }
uint first_reflex(uint t) { return tets[t].reflex; }
uint reflex_entry(uint e) { return reflex_words[reflex_count * REFLEX_SIZE + e]; }
uint entry_edge(uint entry) { return entry >> 4; }
bool entry_is_last(uint entry) { return (entry & 1u) != 0u; }
bool any_reflex() { return reflex_count != 0u; }
bool any_cracks() { return cracks != 0u; }
uint own_edges() { return reflex_count; }
bool reached(uint t) { return (labels[2u * (cell_base + t) + 1u].x & KNOWN) != 0u; }
SolidLabel label_of(uint t) {
  uint at = 2u * (cell_base + t);
  return unpack(labels[at], labels[at + 1u]);
}
bool same_way(SolidLabel a, SolidLabel b) {
  return a.source == b.source && a.sigma == b.sigma && a.bend[0] == b.bend[0] &&
         a.bend[1] == b.bend[1];
}
/// Labels from outside are of mixed domains.
bool comes_in(SolidLabel label, uint t) { return false; }

//@include propagate/solid_sight.inl
//@include propagate/solid_paths.inl
bool any_lit(HINGE_IN(Point) p) { return false; }
bool is_lit(uint t, HINGE_IN(Point) p) { return false; }
//@include propagate/solid_walk.inl

bool go(HINGE_INOUT(Index) t, HINGE_IN(Point) from, HINGE_IN(Point) to) {
  return walk(t, from, to);
}

bool stand_beside(uint edge, HINGE_IN(Point) p, HINGE_INOUT(Index) t) { return false; }
bool is_clear(uint edge, HINGE_IN(Point) p, HINGE_IN(Point) q) { return false; }

//@include propagate/solid_step.inl

/// Longest way from the centre to a corner.
float size_of(uint t) {
  float longest = 0.0;
  for (uint i = 0u; i < 4u; ++i) longest = max(longest, norm(corner_of(t, i) - centre_of(t)));
  return longest;
}
