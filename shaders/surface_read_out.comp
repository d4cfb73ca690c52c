#version 430
// Every reached triangle offers its corners distances; vertices keep the least. One invocation a
// cell. A second pass of the same program finds out who offered it, so that both compute the same
// bits.

#define Real float
const int K = 1;

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
//@include kernel/hinge_kernel.inl
//@include labels/surface/saddle_step.inl
//@include surface.glsl

layout(local_size_x = PLEXWAY_GROUP) in;

layout(std430, binding = 1) readonly buffer Cells { uint cells[]; };  // four numbers each: front.glsl
layout(std430, binding = 2) readonly buffer Labels { SurfaceLabel labels[]; };
layout(std430, binding = 6) coherent buffer VertexBest { uint vertex_best[]; };
layout(std430, binding = 7) coherent buffer VertexSource { uint vertex_source[]; };

uniform uint cell_count, vertex_count;
uniform uint who;  // 1: the second pass

void main() {
  uint cell = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(PLEXWAY_GROUP) +
              gl_LocalInvocationID.x;
  if (cell >= cell_count || cells[4u * cell + 3u] == 0x7f800000u) return;
  uint f = cell % triangle_count, vertices = cell / triangle_count * vertex_count;
  uint via = labels[cell].h.y, first = via & 3u;
  PosedSaddles label = unpack(labels[cell]);
  float hinge = triangles[f].edge[first];
  for (uint n = 0u; n < 3u; ++n) {
    uint corner = n == 0u ? first : n == 1u ? edge_after(first) : edge_before(first);
    HingePoint q = saddle_point(0.0, 0.0);
    if (n == 1u) q.x[0] = hinge;
    if (n == 2u) q = apex_over(f, first);
    uint offer = floatBitsToUint(path_length(label, hinge, q));
    uint v = vertices + triangles[f].corner[corner];
    if (who == 0u)
      atomicMin(vertex_best[v], offer);
    else if (offer == vertex_best[v])
      atomicMin(vertex_source[v], via >> 2);
  }
}
