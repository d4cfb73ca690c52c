#version 430 core
// Colour of a place: by its value, or by the cell that it is in; isolines; light.

in vec3 place;
in vec3 across;
in vec3 values;
flat in vec4 paints[3];

uniform vec4 eye;         // the camera; or where it lies, fourth 0
uniform mat3 axes;        // columns: right, up, toward the camera
uniform vec2 range;       // values at the ends of the map
uniform vec4 isolines;    // the first, their spacing, how many, half their width in pixels
uniform vec4 tint;        // fourth > 0: everything has this colour and opacity, unshaded
uniform int look;         // 0 lit, 1 cap, 2 ghost
uniform float border;     // half the width of lines between cells, in pixels
uniform vec3 colours[33]; // the map, sRGB

out vec4 colour;

vec3 linear_of(vec3 c) {
  return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c));
}
vec3 srgb_of(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

vec3 map_colour(float v) {
  float t = clamp((v - range.x) / (range.y - range.x), 0.0, 1.0) * 32.0;
  int k = min(int(t), 31);
  return linear_of(mix(colours[k], colours[k + 1], t - float(k)));
}

// How much of a pixel a line covers whose middle is so many pixels away.
float line(float pixels, float half_width) {
  return 1.0 - smoothstep(half_width - 0.6, half_width + 0.6, pixels);
}

void main() {
  vec3 dx = dFdx(values), dy = dFdy(values);
  vec3 toward = eye.w > 0.5 ? normalize(eye.xyz - place) : eye.xyz;
  if (tint.a > 0.0) {
    colour = tint;
    return;
  }
  vec3 n = normalize(across);
  if (look == 2) {
    // One colour over itself in any order gives the same: no sorting.
    float edge_on = 1.0 - abs(dot(n, toward));
    colour = vec4(0.36, 0.42, 0.5, 0.07 + 0.4 * edge_on * edge_on * edge_on);
    return;
  }
  if (!gl_FrontFacing) n = -n;

  int least = values.y < values.x ? 1 : 0;
  if (values.z < values[least]) least = 2;
  float v = values[least];
  vec4 paint = paints[least];
  vec3 base = paint.a < 0.25 ? map_colour(v) : linear_of(paint.rgb);

  if (paint.a < 0.75 && isolines.z > 0.5) {
    float slope = length(vec2(dx[least], dy[least])) / isolines.y;
    float phase = (v - isolines.x) / isolines.y;
    float number = clamp(round(phase), 0.0, isolines.z - 1.0);
    float cover = line(abs(phase - number) / max(slope, 1e-9), isolines.w);
    cover *= 1.0 - smoothstep(0.12, 0.4, slope);  // too dense to be told apart
    vec3 there = paint.a < 0.25 ? map_colour(isolines.x + number * isolines.y) : base;
    float light = dot(there, vec3(0.2126, 0.7152, 0.0722));
    vec3 ink = light > 0.12 ? 0.22 * there : mix(there, vec3(1.0), 0.35);
    base = mix(base, ink, (paint.a < 0.25 ? 0.75 : 0.3) * cover);
  }
  if (paint.a > 0.25 && paint.a < 0.75) {
    float nearest = 1e9;
    for (int k = 0; k < 3; ++k) {
      if (k == least || values[k] > 1e29) continue;
      float slope = length(vec2(dx[k] - dx[least], dy[k] - dy[least]));
      nearest = min(nearest, (values[k] - v) / max(slope, 1e-9));
    }
    base = mix(base, vec3(0.03, 0.035, 0.05), 0.9 * line(nearest, border));
  }

  vec3 seen = n * axes;  // in the camera's axes
  float light = 1.0, shine = 0.0;
  if (look == 0) {
    vec3 key = normalize(vec3(-0.5, 0.65, 0.75));
    vec3 fill = normalize(vec3(0.8, -0.1, 0.5));
    float sky = 0.5 + 0.5 * seen.y;
    light = 0.36 + 0.14 * sky + 0.52 * max(dot(seen, key), 0.0) + 0.14 * max(dot(seen, fill), 0.0);
    vec3 half_way = normalize(key + toward * axes);
    shine = 0.07 * pow(max(dot(seen, half_way), 0.0), 36.0);
  }
  colour = vec4(srgb_of(base * light + shine), 1.0);
}
