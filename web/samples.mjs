// samples.mjs DATA OUT: the page's samples, those of the project and one that is made here.
import { cp, mkdir, writeFile } from 'node:fs/promises';
import { join } from 'node:path';

const [data, out] = process.argv.slice(2);
await mkdir(out, { recursive: true });
for (const name of ['knot.ply', 'elbow.mesh', 'vessels.obj', 'roll.xyz'])
  await cp(join(data, name), join(out, name));
await cp(join(data, 'exact', 'surfaces', 'spot.obj'), join(out, 'spot.obj'));

// A square room, time upwards; a pillar crosses the room and back. Cubes of which a pillar takes
// none, cut into six tetrahedra each along the same diagonal (Kuhn), so that faces agree.
const [nx, ny, nt] = [20, 20, 32];
const blocked = (i, j, k) => {
  const middle = 10 + 6.5 * Math.sin((2 * Math.PI * (k + 0.5)) / nt);
  return Math.abs(i + 0.5 - middle) < 2.6 && Math.abs(j + 0.5 - 10) < 2.6;
};
const orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
const names = new Map(), vertices = [], tets = [];
const vertex = (place) => {
  const key = (place[2] * (ny + 1) + place[1]) * (nx + 1) + place[0];
  if (!names.has(key)) {
    names.set(key, vertices.length + 1);
    vertices.push(`${place[0] / nx} ${place[1] / nx} ${place[2] / nx} 0`);
  }
  return names.get(key);
};
for (let k = 0; k < nt; ++k)
  for (let j = 0; j < ny; ++j)
    for (let i = 0; i < nx; ++i) {
      if (blocked(i, j, k)) continue;
      for (const order of orders) {
        const place = [i, j, k], corners = [vertex(place)];
        for (const axis of order) {
          ++place[axis];
          corners.push(vertex(place));
        }
        tets.push(corners.join(' ') + ' 1');
      }
    }
await writeFile(join(out, 'moving.mesh'), [
  'MeshVersionFormatted 2', 'Dimension 3',
  'Vertices', vertices.length, ...vertices, 'Tetrahedra', tets.length, ...tets, 'End', ''].join('\n'));
