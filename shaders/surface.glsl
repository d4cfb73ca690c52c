// A surface on the device: TriangleRecord<float> (plexway/surface/detail/triangle_record.hpp), 64 bytes.

struct Triangle {
  uint across[3];  // what lies over each edge: triangle << 4, with Across's flags
  float edge[3];
  float cosine[3];
  float signed_sine[3];
  uint corner[3];
  uint face;
};

const uint ACROSS_EDGE = 3u;
const uint ACROSS_FLIP = 4u;
const uint ACROSS_FAN = 8u;
const int ACROSS_SHIFT = 4;

layout(std430, binding = 5) readonly buffer Triangles { Triangle triangles[]; };

uniform uint triangle_count;  // also the number of the sentinel: "no triangle"

uint edge_before(uint i) { return (0x12u >> (2u * i)) & 3u; }
uint edge_after(uint i) { return (0x09u >> (2u * i)) & 3u; }

/// The apex over edge i of triangle f, as seen from that edge.
HingePoint apex_over(uint f, uint i) {
  float side = triangles[f].edge[edge_before(i)];
  return saddle_point(side * triangles[f].cosine[i], side * abs(triangles[f].signed_sine[i]));
}

/// A label at rest, by bits: S.x sigma l.x r.x, S.h via l.h r.h; limits as offsets from S. `via` is
/// the edge it came in by, and the source's number shifted by 2.
struct SurfaceLabel {
  uvec4 x, h;
};

/// Instead of the round in which an entry was offered: since it was settled, its label has heard of
/// limits from a neighbour (surface_narrow.comp).
const uint HEARD = 0xffffffffu;

PosedSaddles unpack(SurfaceLabel label) {
  PosedSaddles p;
  vec4 x = uintBitsToFloat(label.x);
  float h = uintBitsToFloat(label.h.x);
  p.source = saddle_point(x.x, h);
  p.limit[0] = saddle_point(x.x + x.z, h + uintBitsToFloat(label.h.z));
  p.limit[1] = saddle_point(x.x + x.w, h + uintBitsToFloat(label.h.w));
  p.sigma = x.y;
  return p;
}

SurfaceLabel pack(PosedSaddles p, uint via) {
  SurfaceLabel label;
  HingePoint S = p.source;
  label.x = floatBitsToUint(vec4(S.x[0], p.sigma, p.limit[0].x[0] - S.x[0],
                                 p.limit[1].x[0] - S.x[0]));
  label.h = floatBitsToUint(vec4(S.h, 0.0, p.limit[0].h - S.h, p.limit[1].h - S.h));
  label.h.y = via;
  return label;
}
