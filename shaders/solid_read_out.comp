#version 430
// A vertex takes the least distance that its tetrahedra offer, and their source. One invocation
// a vertex of a field.

#ifndef PLEXWAY_GROUP
#define PLEXWAY_GROUP 64
#endif
layout(local_size_x = PLEXWAY_GROUP) in;

layout(std430, binding = 0) buffer VertexBest { uint vertex_best[]; };
layout(std430, binding = 1) buffer VertexSource { uint vertex_source[]; };
layout(std430, binding = 2) readonly buffer Labels { uvec4 labels[]; };
// Where the corners of each vertex begin, then corners: 4 t + i.
layout(std430, binding = 3) readonly buffer Corners { uint corners[]; };

//@include solid.glsl

uniform uint vertex_count, total;
uniform uint sources_wanted;

void main() {
  uint at = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(PLEXWAY_GROUP) +
            gl_LocalInvocationID.x;
  if (at >= total) return;
  uint v = at % vertex_count;
  cell_base = at / vertex_count * tet_count;
  float least = uintBitsToFloat(vertex_best[at]);
  uint source = none;
  bool any = false;
  uint end = corners[v + 1u];
  for (uint n = corners[v]; n < end; ++n) {
    uint corner = corners[vertex_count + 1u + n], t = corner >> 2;
    if (!reached(t)) continue;
    SolidLabel label = label_of(t);
    precise float d = label.sigma + sqrt(label.distance2[corner & 3u]);
    if (!(d < least)) continue;
    least = d;
    any = true;
    source = labels[2u * (cell_base + t) + 1u].w;
  }
  if (!any) return;
  vertex_best[at] = floatBitsToUint(least);
  if (sources_wanted != 0u) vertex_source[at] = source;
}
