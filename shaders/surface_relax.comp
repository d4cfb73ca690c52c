#version 430
// No vertex is farther than a neighbour and the edge between: one pass over all edges of all
// triangles, one invocation a triangle of a field. With `who`, vertices that no triangle named a
// source for take that of the neighbour their path comes from, of several the lowest. A mark, the
// highest bit, says that a lower one may still come: so it does not matter who is asked first.

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
layout(local_size_x = PLEXWAY_GROUP) in;

struct Triangle {
  uint across[3];
  float edge[3];
  float cosine[3];
  float signed_sine[3];
  uint corner[3];
  uint face;
};

layout(std430, binding = 4) coherent buffer Changes { uint changes; };
layout(std430, binding = 5) readonly buffer Triangles { Triangle triangles[]; };
layout(std430, binding = 6) coherent buffer VertexBest { uint vertex_best[]; };
layout(std430, binding = 7) coherent buffer VertexSource { uint vertex_source[]; };

uniform uint triangle_count, cell_count, vertex_count;
uniform uint who;

void relax(uint from, uint to, float edge) {
  uint start = vertex_best[from], end = vertex_best[to];
  if (start >= 0x7f800000u || end >= 0x7f800000u) return;
  uint offer = floatBitsToUint(uintBitsToFloat(start) + edge);
  if (who == 0u) {
    if (offer < end && offer < atomicMin(vertex_best[to], offer)) changes = 1u;
  } else if (offer == end) {
    uint source = vertex_source[from] | 0x80000000u;
    if (source < vertex_source[to] && source < atomicMin(vertex_source[to], source)) changes = 1u;
  }
}

void main() {
  uint cell = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(PLEXWAY_GROUP) +
              gl_LocalInvocationID.x;
  if (cell >= cell_count) return;
  uint f = cell % triangle_count, vertices = cell / triangle_count * vertex_count;
  for (int i = 0; i < 3; ++i) {
    uint v = vertices + triangles[f].corner[i];
    uint w = vertices + triangles[f].corner[i == 2 ? 0 : i + 1];
    relax(v, w, triangles[f].edge[i]);
    relax(w, v, triangles[f].edge[i]);
  }
}
