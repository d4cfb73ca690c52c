#pragma once

#include <string_view>

namespace plexway::io {

/// The page around its data: up to where they begin, and from where they end. WebGL 2 by hand; it
/// loads nothing, so it works from a disk and without a network.
inline constexpr std::string_view page_head = R"page(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
html, body { margin: 0; height: 100%; overflow: hidden; background: #fff; color: #22272e;
  font: 14px/1.3 system-ui, sans-serif; }
canvas { width: 100%; height: 100%; display: block; touch-action: none; cursor: grab; }
canvas:active { cursor: grabbing; }
#bar { position: fixed; right: 18px; top: 14%; height: 60%; display: flex; gap: 6px;
  pointer-events: none; }
#scale { width: 18px; height: 100%; border: 1px solid #22272e; }
#marks { position: relative; width: 64px; }
#marks span { position: absolute; transform: translateY(50%); white-space: nowrap; }
#title { position: fixed; right: 18px; top: calc(14% - 28px); font-weight: 600; }
#hint { position: fixed; left: 14px; bottom: 10px; color: #6b7280; font-size: 12px; }
#problem { position: fixed; inset: 40% 10% auto; text-align: center; }
</style>
<canvas id="view" tabindex="0" aria-label="three-dimensional view"></canvas>
<div id="title"></div>
<div id="bar"><div id="scale"></div><div id="marks"></div></div>
<div id="hint">drag: turn &nbsp; wheel, two fingers: nearer &nbsp; shift: move &nbsp; double click: back</div>
<div id="problem"></div>
<script>
'use strict';
const data = )page";

inline constexpr std::string_view page_tail = R"page(;
const at = (id) => document.getElementById(id);

const bytesOf = (text) => {
  const raw = atob(text), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes.buffer;
};
const positions = new Float32Array(bytesOf(data.positions));
const triangles = new Uint32Array(bytesOf(data.triangles));
const edges = new Uint32Array(bytesOf(data.edges));
const value = new Float32Array(bytesOf(data.value));
const colour = new Uint8Array(bytesOf(data.colour));
const vertices = positions.length / 3;

document.title = data.title;

// Vectors of three, matrices of rows.
const plus = (a, b) => a.map((x, k) => x + b[k]);
const times = (s, a) => a.map((x) => s * x);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]];
const unit = (a) => times(1 / (Math.hypot(...a) || 1), a);
const across = (a) => unit(cross(a, Math.abs(a[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0]));

const corner = (v) => [positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]];

// The mean of the triangles around each vertex, by area. Where they face both ways the shader takes
// each triangle's own.
function normalsOf() {
  const sum = new Float32Array(3 * vertices);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => corner(triangles[t + k]));
    const n = cross(plus(b, times(-1, a)), plus(c, times(-1, a)));
    for (let k = 0; k < 3; ++k)
      for (let d = 0; d < 3; ++d) sum[3 * triangles[t + k] + d] += n[d];
  }
  return sum;
}

// Balls and lines, each vertex a place, a normal and a colour.
const extra = { position: [], normal: [], colour: [] };
function corners3(points, normals, rgb) {
  for (let k = 0; k < points.length; ++k) {
    extra.position.push(...points[k]);
    extra.normal.push(...normals[k]);
    extra.colour.push(...rgb, 255);
  }
}
function ball(centre, radius, rgb) {
  const rings = 10, sides = 16;
  const on = (r, s) => {
    const polar = Math.PI * r / rings, turn = 2 * Math.PI * s / sides;
    return [Math.sin(polar) * Math.cos(turn), Math.sin(polar) * Math.sin(turn), Math.cos(polar)];
  };
  for (let r = 0; r < rings; ++r)
    for (let s = 0; s < sides; ++s) {
      const [a, b, c, d] = [on(r, s), on(r + 1, s), on(r + 1, s + 1), on(r, s + 1)];
      const normals = [a, b, c, a, c, d];
      corners3(normals.map((n) => plus(centre, times(radius, n))), normals, rgb);
    }
}
function tube(from, to, radius, rgb) {
  const along = unit(plus(to, times(-1, from))), x = across(along), y = cross(along, x);
  const round = (k) => plus(times(Math.cos(Math.PI * k / 4), x), times(Math.sin(Math.PI * k / 4), y));
  for (let k = 0; k < 8; ++k) {
    const a = round(k), b = round(k + 1);
    const normals = [a, a, b, a, b, b];
    corners3([plus(from, times(radius, a)), plus(to, times(radius, a)), plus(to, times(radius, b)),
              plus(from, times(radius, a)), plus(to, times(radius, b)),
              plus(from, times(radius, b))], normals, rgb);
  }
}
for (const path of data.paths)
  for (let k = 1; k < path.length; ++k) tube(path[k - 1], path[k], 0.0035, [40, 44, 52]);
for (const p of data.dots) ball(p, 0.006, [35, 40, 50]);
for (const p of data.targets) ball(p, 0.009, [250, 250, 250]);
for (const p of data.sources) ball(p, 0.011, [225, 60, 40]);

const vertexText = `#version 300 es
in vec3 place; in vec3 across; in float value; in vec4 paint;
uniform mat4 seen; uniform mat3 turn; uniform float dot_size;
out vec3 n; out vec3 here; out float v; flat out vec4 own;
void main() {
  gl_Position = seen * vec4(place, 1.0);
  gl_PointSize = clamp(dot_size / gl_Position.w, 1.5, 60.0);
  n = turn * across; here = turn * place; v = value; own = paint;
}`;
const pixelText = `#version 300 es
precision highp float;
in vec3 n; in vec3 here; in float v; flat in vec4 own;
uniform sampler2D map; uniform vec3 range; uniform bool dots; uniform bool lit;
out vec4 result;
void main() {
  float lines = range.z > 0.0 ? v / range.z : 0.0;
  float width = fwidth(lines);
  vec3 side = cross(dFdx(here), dFdy(here));
  if (dots && length(gl_PointCoord - 0.5) > 0.5) discard;
  vec3 base = vec3(0.59);
  if (own.a > 0.5) base = own.rgb;
  else if (v < 1e37) {
    float t = clamp((v - range.x) / (range.y - range.x), 0.0, 1.0);
    base = texture(map, vec2((255.0 * t + 0.5) / 256.0, 0.5)).rgb;
    float off = abs(lines - round(lines));
    if (!dots && round(lines) * range.z > range.x + 0.01 * range.z && width < 0.4)
      base *= mix(0.4, 1.0, smoothstep(0.4 * width, 1.4 * width, off));
  }
  float light = 1.0;
  if (lit) {
    vec3 up = dot(n, n) > 1e-20 ? normalize(n) : normalize(side);
    if (up.z < 0.0) up = -up;
    light = 0.45 + 0.1 * up.y + 0.5 * max(dot(up, normalize(vec3(-0.4, 0.5, 0.8))), 0.0);
  }
  result = vec4(base * light, 1.0);
}`;

const gl = at('view').getContext('webgl2', { antialias: true });
if (!gl) at('problem').textContent = 'This browser shows no WebGL 2.';
else start();

function start() {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertexText], [gl.FRAGMENT_SHADER, pixelText]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  ['place', 'across', 'value', 'paint'].forEach((name, k) => gl.bindAttribLocation(program, k, name));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    at('problem').textContent = gl.getProgramInfoLog(program) || 'WebGL: the program does not link.';
    return;
  }
  gl.useProgram(program);
  const uniform = (name) => gl.getUniformLocation(program, name);
  const fill = (place, size, numbers, type = gl.FLOAT) => {
    if (!numbers) return gl.vertexAttrib4f(place, 0, 0, 0, 0);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, type, type !== gl.FLOAT, 0, 0);
  };
  const mesh = gl.createVertexArray();
  gl.bindVertexArray(mesh);
  fill(0, 3, positions);
  fill(1, 3, normalsOf());
  fill(2, 1, value.length ? value : new Float32Array(vertices).fill(3e38));
  fill(3, 4, colour.length ? colour : new Uint8Array(4 * vertices), gl.UNSIGNED_BYTE);
  const index = gl.createBuffer();
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, index);
  const both = new Uint32Array(triangles.length + edges.length);
  both.set(triangles);
  both.set(edges, triangles.length);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, both, gl.STATIC_DRAW);
  const marks = gl.createVertexArray();
  gl.bindVertexArray(marks);
  fill(0, 3, new Float32Array(extra.position));
  fill(1, 3, new Float32Array(extra.normal));
  fill(2, 1, new Float32Array(extra.position.length / 3));
  fill(3, 4, new Uint8Array(extra.colour), gl.UNSIGNED_BYTE);

  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB, 256, 1, 0, gl.RGB, gl.UNSIGNED_BYTE,
                new Uint8Array(data.map.flat()));
  for (const kind of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
    gl.texParameteri(gl.TEXTURE_2D, kind, gl.LINEAR);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  gl.uniform3f(uniform('range'), data.range[0], data.range[1], data.step);
  gl.enable(gl.DEPTH_TEST);

  // A little right of the front and above, as pictures are.
  const withUp = (p) => data.up === 'y' ? [p[0], p[2], -p[1]]
                      : data.up === 'x' ? [p[2], p[0], p[1]] : p;
  const az = 28 * Math.PI / 180, el = 24 * Math.PI / 180;
  let rows, far, shift;
  const back = () => {
    const toward = [Math.sin(az) * Math.cos(el), -Math.cos(az) * Math.cos(el), Math.sin(el)];
    const right = [Math.cos(az), Math.sin(az), 0];
    rows = [right, cross(toward, right), toward].map(withUp);
    far = 2.7;
    shift = [0, 0];
  };
  back();
  const slope = 0.21;

  let asked = false;
  const ask = () => { if (!asked) { asked = true; requestAnimationFrame(draw); } };
  function draw() {
    asked = false;
    const canvas = at('view'), ratio = Math.min(window.devicePixelRatio || 1, 2);
    const w = Math.round(canvas.clientWidth * ratio), h = Math.round(canvas.clientHeight * ratio);
    if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
    gl.viewport(0, 0, w, h);
    gl.clearColor(1, 1, 1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const narrow = Math.min(1, w / h), near = Math.max(far - 1.2, 0.01), end = far + 1.2;
    const sy = narrow / slope, sx = sy * h / w;
    const z = -(end + near) / (end - near), z0 = -2 * end * near / (end - near);
    const [r, u, t] = rows, m = [];
    for (let k = 0; k < 3; ++k) m.push(sx * r[k], sy * u[k], z * t[k], -t[k]);
    m.push(sx * shift[0], sy * shift[1], -z * far + z0, far);
    gl.uniformMatrix4fv(uniform('seen'), false, m);
    gl.uniformMatrix3fv(uniform('turn'), false,
                        [0, 1, 2].flatMap((k) => [r[k], u[k], t[k]]));
    gl.uniform1f(uniform('dot_size'), data.spacing * h / slope * narrow);
    gl.bindVertexArray(mesh);
    const pass = (lit, dots, call) => {
      gl.uniform1i(uniform('lit'), lit);
      gl.uniform1i(uniform('dots'), dots);
      call();
    };
    if (triangles.length)
      pass(1, 0, () => gl.drawElements(gl.TRIANGLES, triangles.length, gl.UNSIGNED_INT, 0));
    if (edges.length)
      pass(0, 0, () => gl.drawElements(gl.LINES, edges.length, gl.UNSIGNED_INT,
                                       4 * triangles.length));
    if (!triangles.length && !edges.length)
      pass(0, 1, () => gl.drawArrays(gl.POINTS, 0, vertices));
    gl.bindVertexArray(marks);
    if (extra.position.length)
      pass(1, 0, () => gl.drawArrays(gl.TRIANGLES, 0, extra.position.length / 3));
    document.body.dataset.drawn = 1 + Number(document.body.dataset.drawn || 0);
  }

  const turned = (a, b, angle) => {
    const c = Math.cos(angle), s = Math.sin(angle);
    const [p, q] = [rows[a], rows[b]];
    rows[a] = unit(plus(times(c, p), times(-s, q)));
    rows[b] = plus(times(s, p), times(c, q));
    rows[b] = unit(plus(rows[b], times(-dot(rows[a], rows[b]), rows[a])));
  };
  const held = new Map();
  const view = at('view');
  view.addEventListener('pointerdown', (e) => {
    view.setPointerCapture(e.pointerId);
    held.set(e.pointerId, [e.clientX, e.clientY]);
  });
  for (const end of ['pointerup', 'pointercancel'])
    view.addEventListener(end, (e) => held.delete(e.pointerId));
  view.addEventListener('pointermove', (e) => {
    if (!held.has(e.pointerId)) return;
    const apart = () => {
      const [a, b] = [...held.values()];
      return b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0;
    };
    const before = apart(), [x, y] = held.get(e.pointerId);
    held.set(e.pointerId, [e.clientX, e.clientY]);
    const dx = e.clientX - x, dy = e.clientY - y, side = Math.min(view.clientWidth, view.clientHeight);
    if (held.size > 1 || e.shiftKey || e.buttons === 2 || e.buttons === 4) {
      const step = 2 * slope * far / side / held.size;
      shift = [shift[0] + step * dx, shift[1] - step * dy];
      if (before > 0 && apart() > 0) nearer(before / apart());
    } else {
      turned(0, 2, -3.5 * dx / side);
      turned(1, 2, 3.5 * dy / side);
    }
    ask();
  });
  const nearer = (by) => { far = Math.min(Math.max(far * by, 0.05), 20); ask(); };
  view.addEventListener('wheel', (e) => {
    e.preventDefault();
    nearer(Math.exp(0.0012 * e.deltaY));
  }, { passive: false });
  view.addEventListener('contextmenu', (e) => e.preventDefault());
  view.addEventListener('dblclick', () => { back(); ask(); });
  view.addEventListener('keydown', (e) => {
    const way = { ArrowLeft: [0, 2, 0.1], ArrowRight: [0, 2, -0.1], ArrowUp: [1, 2, -0.1],
                  ArrowDown: [1, 2, 0.1] }[e.key];
    if (way) turned(...way);
    else if (e.key === '+') nearer(0.9);
    else if (e.key === '-') nearer(1.1);
    else return;
    ask();
  });
  window.addEventListener('resize', ask);
  ask();
}

at('title').textContent = data.bar ? data.title : '';
if (data.bar) {
  const stops = data.map.map((c, k) => `rgb(${c}) ${(100 * k / 255).toFixed(2)}%`);
  at('scale').style.background = `linear-gradient(to top, ${stops})`;
  for (const mark of data.marks) {
    const span = document.createElement('span');
    span.textContent = mark[1];
    span.style.bottom = 100 * mark[0] + '%';
    at('marks').append(span);
  }
} else {
  at('bar').style.display = 'none';
}
</script>
</html>
)page";

}  // namespace plexway::io
