// A domain's labels, for shaders that only move them about, and what tells equal offers apart.

#ifdef PLEXWAY_WIRES
struct Label { uint source; };
uint rank_of(Label label) { return label.source; }
#elif defined(PLEXWAY_SOLIDS)
struct Label { uvec4 a, b, c; };  // solid.glsl
uint rank_of(Label label) { return label.c.w << 3 | label.b.x; }
#else
struct Label { uvec4 x, h; };  // surface.glsl
uint rank_of(Label label) { return label.h.y; }
#endif

layout(std430, binding = 2) buffer Labels { Label labels[]; };
layout(std430, binding = 4) buffer WaitingLabels { Label waiting_labels[]; };
