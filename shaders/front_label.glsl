// A domain's labels, for shaders that only move them about, and what tells equal offers apart.

#ifdef PLEXWAY_WIRES
struct Label { uint source; };
uint rank_of(Label label) { return label.source; }
uint mix_of(Label label) { return 0u; }
#elif defined(PLEXWAY_SOLIDS)
struct Label { uvec4 a, b; };  // solid.glsl
uint rank_of(Label label) { return label.b.w << 3 | (label.b.x & 3u); }
uint mix_of(Label label) {
  uvec4 m = label.a * 0x9E3779B1u + label.b * 0x85EBCA77u;
  return (m.x ^ m.y * 3u ^ m.z * 5u ^ m.w * 7u) >> 24;
}
#else
struct Label { uvec4 x, h; };  // surface.glsl
uint rank_of(Label label) { return label.h.y; }
uint mix_of(Label label) {
  uvec4 m = label.x * 0x9E3779B1u + label.h * 0x85EBCA77u;
  return (m.x ^ m.y * 3u ^ m.z * 5u ^ m.w * 7u) >> 24;
}
#endif

layout(std430, binding = 2) buffer Labels { Label labels[]; };
layout(std430, binding = 4) buffer WaitingLabels { Label waiting_labels[]; };

/// Of twins the earlier counts; and where an edge has many triangles, two of one round may be alike
/// in all but their content.
uint age_of(uint round, Label label) { return min(round, 0x7effffu) << 8 | mix_of(label); }
