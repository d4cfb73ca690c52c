#version 430
// No vertex is farther than a neighbour and the edge between: one pass over all edges of all
// tetrahedra, one invocation a tetrahedron of a field. With `who`, vertices that got nearer so take
// the source of the neighbour their path comes from.

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
layout(local_size_x = PLEXWAY_GROUP) in;

layout(std430, binding = 0) coherent buffer VertexBest { uint vertex_best[]; };
layout(std430, binding = 1) coherent buffer VertexSource { uint vertex_source[]; };
layout(std430, binding = 4) coherent buffer Changes { uint changes; };

struct Tet {
  uint across[4];
  uint corner[4];
};
layout(std430, binding = 5) readonly buffer Tets { Tet tets[]; };
layout(std430, binding = 6) readonly buffer Lengths { float lengths[]; };

uniform uint tet_count, cell_count, vertex_count;
uniform uint who, sources_wanted;

void relax(uint from, uint to, float edge) {
  uint start = vertex_best[from], end = vertex_best[to];
  if (start >= 0x7f800000u) return;
  uint offer = floatBitsToUint(uintBitsToFloat(start) + edge);
  if (who == 0u) {
    if (offer >= end || offer >= atomicMin(vertex_best[to], offer)) return;
    if (sources_wanted != 0u) vertex_source[to] = 0xffffffffu;
    changes = 1u;
  } else if (offer == end) {
    uint source = vertex_source[from] | 0x80000000u;
    if (source < vertex_source[to] && source < atomicMin(vertex_source[to], source)) changes = 1u;
  }
}

void main() {
  uint cell = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(PLEXWAY_GROUP) +
              gl_LocalInvocationID.x;
  if (cell >= cell_count) return;
  uint t = cell % tet_count, vertices = cell / tet_count * vertex_count;
  for (int j = 1; j < 4; ++j)
    for (int i = 0; i < 3; ++i) {
      if (i >= j) continue;
      uint v = tets[t].corner[i], w = tets[t].corner[j];
      float edge = sqrt(lengths[6u * t + uint(j * (j - 1) / 2 + i)]);
      relax(vertices + v, vertices + w, edge);
      relax(vertices + w, vertices + v, edge);
    }
}
