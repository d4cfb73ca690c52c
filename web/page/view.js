// The picture: a domain with a number at each vertex, sources, a path, a cut. Draws when asked.
import * as three from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { Line2 } from 'three/examples/jsm/lines/Line2.js';
import { LineGeometry } from 'three/examples/jsm/lines/LineGeometry.js';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { cells, table } from './colours.js';

const colouring = `
  uniform sampler2D colours;
  uniform float top, lineStep, lineWidth;
  uniform bool byLabel;
  uniform vec3 cellColours[8];
  varying float vValue, vReached, vLabel;

  // Crisp at any distance: the width of a line is in pixels.
  vec3 colourOf() {
    if (vReached < 0.999) return vec3(0.55);
    vec3 colour = byLabel ? cellColours[int(mod(vLabel + 0.5, 8.0))]
                          : texture2D(colours, vec2(clamp(vValue / top, 0.002, 0.998), 0.5)).rgb;
    if (lineStep > 0.0) {
      float at = vValue / lineStep;
      float away = abs(fract(at + 0.5) - 0.5) / max(fwidth(at), 1e-12);
      float line = (1.0 - smoothstep(lineWidth * 0.5, lineWidth * 0.5 + 1.0, away)) * step_visible(at);
      colour = mix(colour, dot(colour, vec3(0.3, 0.6, 0.1)) > 0.35 ? vec3(0.0) : vec3(1.0), 0.75 * line);
    }
    return colour;
  }`.replace('step_visible(at)', '(1.0 - smoothstep(0.25, 0.6, fwidth(at)))');

const valueVertex = `
  attribute float value, label;
  varying float vValue, vReached, vLabel;
  void take(float v, float l) {
    vReached = v < 0.0 ? 0.0 : 1.0;
    vValue = max(v, 0.0);
    vLabel = l;
  }`;

const surfaceVertex = `
  ${valueVertex}
  varying vec3 vPlace;
  #include <clipping_planes_pars_vertex>
  void main() {
    take(value, label);
    vec4 mvPosition = modelViewMatrix * vec4(position, 1.0);
    vPlace = mvPosition.xyz;
    gl_Position = projectionMatrix * mvPosition;
    #include <clipping_planes_vertex>
  }`;
const surfaceFragment = `
  ${colouring}
  varying vec3 vPlace;
  #include <clipping_planes_pars_fragment>
  void main() {
    #include <clipping_planes_fragment>
    vec3 normal = normalize(cross(dFdx(vPlace), dFdy(vPlace)));
    float light = 0.45 + 0.55 * abs(dot(normal, normalize(vec3(0.3, 0.4, 1.0))));
    gl_FragColor = vec4(colourOf() * light, 1.0);
  }`;

const tubeVertex = `
  attribute vec3 from, to;
  attribute vec2 values, labels;
  uniform float radius;
  varying float vValue, vReached, vLabel;
  varying vec3 vNormal;
  void main() {
    float share = position.y + 0.5;
    float least = min(values.x, values.y);
    vReached = least < 0.0 ? 0.0 : 1.0;
    vValue = mix(values.x, values.y, share);
    vLabel = share < 0.5 ? labels.x : labels.y;
    vec3 axis = normalize(to - from + vec3(0.0, 1e-30, 0.0));
    vec3 side = normalize(cross(axis, abs(axis.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
    vec3 out2 = cross(axis, side);
    vec3 normal = position.x * side + position.z * out2;
    vNormal = normalMatrix * normal;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(mix(from, to, share) + radius * normal, 1.0);
  }`;
const tubeFragment = `
  ${colouring}
  varying vec3 vNormal;
  void main() {
    float light = 0.45 + 0.55 * abs(normalize(vNormal).z);
    gl_FragColor = vec4(colourOf() * light, 1.0);
  }`;

const discVertex = `
  ${valueVertex}
  uniform float radius, pixels;
  void main() {
    take(value, label);
    vec4 place = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * place;
    gl_PointSize = clamp(radius * pixels * projectionMatrix[1][1] / gl_Position.w, 2.0, 64.0);
  }`;
const discFragment = `
  ${colouring}
  void main() {
    vec2 at = 2.0 * gl_PointCoord - 1.0;
    float r2 = dot(at, at);
    if (r2 > 1.0) discard;
    gl_FragColor = vec4(colourOf() * (1.0 - 0.35 * r2), 1.0);
  }`;

export class View {
  #renderer; #scene = new three.Scene(); #camera; #controls; #parts = []; #uniforms;
  #markers = new three.Group(); #way = null; #section = null; #clip; #asked = false;
  #size = 1; #pointRadius = 0; #edges = null;
  framesDrawn = 0;
  drawMs = 0;

  constructor(canvas) {
    this.canvas = canvas;
    this.#renderer = new three.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.#renderer.outputColorSpace = three.LinearSRGBColorSpace;
    this.#renderer.localClippingEnabled = true;
    this.#camera = new three.PerspectiveCamera(40, 1, 0.01, 100);
    this.#controls = new OrbitControls(this.#camera, canvas);
    this.#controls.enableDamping = false;
    this.#controls.addEventListener('change', () => this.draw());
    this.#clip = new three.Plane(new three.Vector3(0, 0, 1), 1e9);
    const colours = new three.DataTexture(table('viridis'), 256, 1);
    colours.minFilter = colours.magFilter = three.LinearFilter;
    colours.needsUpdate = true;
    this.#uniforms = {
      colours: { value: colours }, top: { value: 1 }, lineStep: { value: 0 }, lineWidth: { value: 1 },
      byLabel: { value: false },
      cellColours: { value: cells.map((hex) => new three.Color().setStyle(hex, three.LinearSRGBColorSpace)) },
    };
    this.#scene.add(this.#markers);
    new ResizeObserver(() => this.#fit()).observe(canvas.parentElement);
    this.#fit();
  }

  get controls() { return this.#controls; }

  #fit() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (width === 0 || height === 0) return;
    this.#renderer.setSize(width, height, false);
    this.#camera.aspect = width / height;
    this.#camera.updateProjectionMatrix();
    this.draw();
  }

  // Many askings, one picture.
  draw() {
    if (this.#asked) return;
    this.#asked = true;
    requestAnimationFrame(() => {
      this.#asked = false;
      this.drawNow();
    });
  }
  drawNow() {
    const start = performance.now();
    for (const { material } of this.#parts)
      if (material.uniforms.pixels) material.uniforms.pixels.value = this.#renderer.domElement.height / 2;
    for (const marker of this.#markers.children) {
      const away = marker.position.distanceTo(this.#camera.position);
      marker.scale.setScalar(0.012 * away);
    }
    this.#renderer.render(this.#scene, this.#camera);
    this.drawMs = performance.now() - start;
    ++this.framesDrawn;
  }

  // Takes an opened domain: positions, triangles, edges.
  show(domain) {
    for (const part of this.#parts) {
      this.#scene.remove(part);
      part.geometry.dispose();
      part.material.dispose();
    }
    this.#parts = [];
    this.setPath(null);
    this.setSection(null);
    this.setMarkers([]);
    this.#size = domain.size || 1;
    const material = (vertexShader, fragmentShader, own = {}) =>
      new three.ShaderMaterial({
        vertexShader, fragmentShader, side: three.DoubleSide, uniforms: { ...this.#uniforms, ...own },
      });
    const positions = new three.BufferAttribute(domain.positions, 3);
    const vertices = domain.positions.length / 3;
    const values = new three.BufferAttribute(new Float32Array(vertices).fill(-1), 1);
    const labels = new three.BufferAttribute(new Float32Array(vertices), 1);
    const geometry = () => {
      const made = new three.BufferGeometry();
      made.setAttribute('position', positions);
      made.setAttribute('value', values);
      made.setAttribute('label', labels);
      return made;
    };
    this.values = values;
    this.labels = labels;
    this.#edges = null;
    if (domain.triangles.length > 0) {
      const made = geometry();
      made.setIndex(new three.BufferAttribute(domain.triangles, 1));
      const drawn = material(surfaceVertex, surfaceFragment);
      drawn.clipping = true;
      drawn.clippingPlanes = [];
      const mesh = new three.Mesh(made, drawn);
      mesh.name = 'surface';
      this.#parts.push(mesh);
    }
    if (domain.edges.length > 0) this.#addTubes(domain, material);
    if (domain.triangles.length === 0 && domain.edges.length === 0) {
      this.#pointRadius = 1.2 * this.#size / Math.sqrt(vertices);
      const points = new three.Points(geometry(), material(discVertex, discFragment,
        { radius: { value: this.#pointRadius }, pixels: { value: 500 } }));
      this.#parts.push(points);
    }
    for (const part of this.#parts) {
      part.frustumCulled = false;
      this.#scene.add(part);
    }
    this.resetCamera();
  }

  #addTubes(domain, material) {
    const count = domain.edges.length / 2;
    const from = new Float32Array(3 * count), to = new Float32Array(3 * count);
    let length = 0;
    for (let e = 0; e < count; ++e) {
      const a = 3 * domain.edges[2 * e], b = 3 * domain.edges[2 * e + 1];
      for (let i = 0; i < 3; ++i) {
        from[3 * e + i] = domain.positions[a + i];
        to[3 * e + i] = domain.positions[b + i];
      }
      length += Math.hypot(to[3 * e] - from[3 * e], to[3 * e + 1] - from[3 * e + 1],
        to[3 * e + 2] - from[3 * e + 2]);
    }
    const cylinder = new three.CylinderGeometry(1, 1, 1, 7, 1, true);
    const made = new three.InstancedBufferGeometry();
    made.index = cylinder.index;
    made.setAttribute('position', cylinder.getAttribute('position'));
    made.setAttribute('from', new three.InstancedBufferAttribute(from, 3));
    made.setAttribute('to', new three.InstancedBufferAttribute(to, 3));
    made.setAttribute('values', new three.InstancedBufferAttribute(new Float32Array(2 * count).fill(-1), 2));
    made.setAttribute('labels', new three.InstancedBufferAttribute(new Float32Array(2 * count), 2));
    made.instanceCount = count;
    const radius = Math.min(0.18 * length / count, 0.004 * this.#size);
    const mesh = new three.Mesh(made, material(tubeVertex, tubeFragment, { radius: { value: radius } }));
    this.#edges = { ends: domain.edges, geometry: made };
    this.#parts.push(mesh);
  }

  // The next position of the camera is that from which everything is seen.
  resetCamera() {
    const away = 1.35 * this.#size;
    this.#controls.target.set(0, 0, 0);
    this.#camera.position.set(0.45 * away, 0.35 * away, 0.82 * away);
    this.#camera.near = away / 1000;
    this.#camera.far = away * 20;
    this.#camera.updateProjectionMatrix();
    this.#controls.update();
    this.draw();
  }

  // A number a vertex; not finite: unreached. `labels` may be null.
  setValues(numbers, labels, top) {
    const into = this.values.array;
    for (let v = 0; v < into.length; ++v) into[v] = Number.isFinite(numbers[v]) ? numbers[v] : -1;
    this.values.needsUpdate = true;
    if (labels) this.labels.array.set(labels);
    else this.labels.array.fill(0);
    this.labels.needsUpdate = true;
    if (this.#edges) {
      const { ends, geometry } = this.#edges;
      const { array: pairs } = geometry.getAttribute('values');
      const { array: names } = geometry.getAttribute('labels');
      for (let k = 0; k < ends.length; ++k) {
        pairs[k] = into[ends[k]];
        names[k] = this.labels.array[ends[k]];
      }
      geometry.getAttribute('values').needsUpdate = true;
      geometry.getAttribute('labels').needsUpdate = true;
    }
    this.#uniforms.top.value = top > 0 ? top : 1;
    this.draw();
  }

  setLook({ map, step, byLabel }) {
    if (map !== undefined) {
      this.#uniforms.colours.value.image.data.set(table(map));
      this.#uniforms.colours.value.needsUpdate = true;
    }
    if (step !== undefined) this.#uniforms.lineStep.value = step;
    if (byLabel !== undefined) this.#uniforms.byLabel.value = byLabel;
    this.draw();
  }
  setBackground(colour) {
    this.#scene.background = new three.Color().setStyle(colour, three.LinearSRGBColorSpace);
    this.draw();
  }

  // A ball at each place, and what shines through where something hides it.
  setMarkers(places) {
    this.#markers.clear();
    for (const { at, colour } of places) {
      const marker = new three.Group();
      const ball = new three.Mesh(new three.SphereGeometry(1, 16, 12), new three.MeshBasicMaterial({ color: colour }));
      const ring = new three.Mesh(new three.RingGeometry(1.1, 1.5, 24),
        new three.MeshBasicMaterial({ color: colour, depthTest: false, transparent: true, opacity: 0.6, side: three.DoubleSide }));
      ring.renderOrder = 2;
      ring.onBeforeRender = (_r, _s, camera) => {
        ring.quaternion.copy(camera.quaternion);
        ring.updateMatrixWorld();
        ring.modelViewMatrix.multiplyMatrices(camera.matrixWorldInverse, ring.matrixWorld);
      };
      marker.add(ball, ring);
      marker.position.set(...at);
      this.#markers.add(marker);
    }
    this.draw();
  }

  setPath(way) {
    if (this.#way) {
      this.#scene.remove(this.#way);
      this.#way.geometry.dispose();
      this.#way = null;
    }
    if (way && way.length >= 6) {
      const geometry = new LineGeometry();
      geometry.setPositions(way);
      const material = new LineMaterial({ color: '#ff4d6d', linewidth: 4, worldUnits: false, depthTest: false });
      material.resolution.set(this.canvas.width, this.canvas.height);
      this.#way = new Line2(geometry, material);
      this.#way.renderOrder = 1;
      this.#scene.add(this.#way);
    }
    this.draw();
  }

  // x, y, z, value of corners of triangles, on the plane; null takes the cut away.
  setSection(section, normal = [0, 0, 1], offset = 0) {
    if (this.#section) {
      this.#scene.remove(this.#section);
      this.#section.geometry.dispose();
      this.#section = null;
    }
    const surface = this.#parts.find((part) => part.name === 'surface');
    if (surface) surface.material.clippingPlanes = section ? [this.#clip] : [];
    if (section) {
      // What lies beyond the plane, seen from its normal, stays.
      this.#clip.normal.set(-normal[0], -normal[1], -normal[2]);
      this.#clip.constant = offset;
      const made = new three.BufferGeometry();
      const count = section.length / 4;
      const place = new Float32Array(3 * count), value = new Float32Array(count);
      for (let k = 0; k < count; ++k) {
        place.set(section.subarray(4 * k, 4 * k + 3), 3 * k);
        value[k] = Number.isFinite(section[4 * k + 3]) ? section[4 * k + 3] : -1;
      }
      made.setAttribute('position', new three.BufferAttribute(place, 3));
      made.setAttribute('value', new three.BufferAttribute(value, 1));
      made.setAttribute('label', new three.BufferAttribute(new Float32Array(count), 1));
      this.#section = new three.Mesh(made, new three.ShaderMaterial({
        vertexShader: surfaceVertex, fragmentShader: surfaceFragment, side: three.DoubleSide, uniforms: this.#uniforms }));
      this.#section.frustumCulled = false;
      this.#scene.add(this.#section);
    }
    this.draw();
  }

  // The ray under a place of the canvas, in its pixels.
  ray(x, y) {
    const { width, height } = this.canvas.getBoundingClientRect();
    const caster = new three.Raycaster();
    caster.setFromCamera(new three.Vector2((2 * x) / width - 1, 1 - (2 * y) / height), this.#camera);
    // Six pixels, as a share of the way.
    const slack = (6 / height) * 2 * Math.tan((this.#camera.fov * Math.PI) / 360);
    return { from: caster.ray.origin.toArray(), direction: caster.ray.direction.toArray(), slack };
  }

  // Where a place of the domain is on the canvas, in its pixels.
  onCanvas(at) {
    const { width, height } = this.canvas.getBoundingClientRect();
    const placed = new three.Vector3(...at).project(this.#camera);
    return [((placed.x + 1) / 2) * width, ((1 - placed.y) / 2) * height];
  }

  zoom(factor) {
    this.#camera.position.multiplyScalar(factor);
    this.#controls.update();
    this.draw();
  }
  turn(right, up) {
    const place = new three.Spherical().setFromVector3(this.#camera.position);
    place.theta += right;
    place.phi = Math.min(Math.max(place.phi + up, 0.05), Math.PI - 0.05);
    this.#camera.position.setFromSpherical(place);
    this.#controls.update();
    this.draw();
  }

  picture() {
    this.drawNow();
    return new Promise((done) => this.canvas.toBlob(done, 'image/png'));
  }
}
