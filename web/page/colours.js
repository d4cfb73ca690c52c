// Colour maps that people who confuse red and green can read, as stops in sRGB.
const maps = {
  viridis: ['#440154', '#482878', '#3e4a89', '#31688e', '#26828e', '#1f9e89', '#35b779', '#6ece58', '#b5de2b', '#fde725'],
  cividis: ['#00224e', '#123570', '#3b496c', '#575d6d', '#707173', '#8a8678', '#a59c74', '#c3b369', '#e1cc55', '#fee838'],
  greys: ['#f4f4f4', '#d9d9d9', '#bdbdbd', '#969696', '#737373', '#525252', '#2b2b2b'],
};
// Eight that stay apart for all eyes (Okabe and Ito 2008).
export const cells = ['#e69f00', '#56b4e9', '#009e73', '#f0e442', '#0072b2', '#d55e00', '#cc79a7', '#999999'];

export const mapNames = Object.keys(maps);

const channels = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));

// 256 colours, RGBA bytes.
export function table(name) {
  const stops = maps[name].map(channels);
  const bytes = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; ++i) {
    const x = (i / 255) * (stops.length - 1);
    const k = Math.min(Math.floor(x), stops.length - 2);
    for (let c = 0; c < 3; ++c)
      bytes[4 * i + c] = Math.round(stops[k][c] + (stops[k + 1][c] - stops[k][c]) * (x - k));
    bytes[4 * i + 3] = 255;
  }
  return bytes;
}

export function gradient(name) {
  return `linear-gradient(to right, ${maps[name].join(', ')})`;
}

// A step of 1, 2 or 5 times a power of ten that cuts `range` into about `parts`.
export function roundStep(range, parts) {
  const raw = range / parts;
  const power = 10 ** Math.floor(Math.log10(raw));
  const share = raw / power;
  return (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10) * power;
}

export function shortNumber(value) {
  if (value === null || !Number.isFinite(value)) return 'unreached';
  return Number(value.toPrecision(5)).toString();
}
