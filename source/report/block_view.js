// SPDX-License-Identifier: LGPL-2.1-or-later
(function () {
const box = document.currentScript.parentElement;
const data = JSON.parse(box.querySelector('script').textContent);
const make = (kind, parent) => parent.appendChild(document.createElement(kind));
const controls = make('div', box), canvas = make('canvas', box);
controls.className = 'controls';
canvas.tabIndex = 0;
canvas.setAttribute('role', 'img');
canvas.setAttribute('aria-label', 'Block and mesh; arrow keys turn it');
box.classList.add('alive');
const labelled = (text, element) => {
  const label = make('label', controls);
  label.append(text + ' ', element);
  return element;
};
const slider = (text, most, value) => {
  const input = document.createElement('input');
  input.type = 'range'; input.min = 0; input.max = most; input.step = 'any';
  input.value = value;
  return labelled(text, input);
};
const field = labelled('Colour', document.createElement('select'));
data.fields.forEach(f => field.add(new Option(f.label)));
const last = data.states.length - 1;
const time = last > 0 ? slider('Time', last, last) : null;
if (time) time.step = 1;
const stretch = slider('Deformation', 2, 1);
const lines = document.createElement('input');
lines.type = 'checkbox'; lines.checked = true;
labelled('Mesh', lines);
const told = make('output', controls);
const home = data.flat ? [0, 0] : [-0.6, 0.45];
let [turn, tilt] = home, zoom = 1, shift = [0, 0];

const colours = [[68,1,84],[65,68,135],[42,120,142],[34,168,132],
                 [122,209,81],[253,231,37]];
const colour = s => {
  s = Math.min(Math.max(s, 0), 1) * 5;
  const i = Math.min(Math.floor(s), 4), a = colours[i], b = colours[i + 1];
  return 'rgb(' + a.map((x, k) => Math.round(x + (b[k] - x) * (s - i))) + ')';
};
const digits = x => String(+x.toPrecision(3));

function draw() {
  const state = data.states[time ? +time.value : 0];
  const shown = data.fields[field.selectedIndex], values = state[shown.key];
  const ratio = window.devicePixelRatio || 1;
  const width = box.clientWidth, height = Math.min(420, 0.75 * width);
  canvas.style.height = height + 'px';
  canvas.width = width * ratio; canvas.height = height * ratio;
  const pen = canvas.getContext('2d');
  pen.scale(ratio, ratio);
  const ink = '#222'; // on white, also where the page is dark
  const scale = data.scale * stretch.value;
  const c = data.centre, ct = Math.cos(turn), st = Math.sin(turn);
  const ce = Math.cos(tilt), se = Math.sin(tilt);
  const room = data.flat ? data.extent
    : Array(2).fill(0.85 * Math.hypot(...data.extent));
  const size = zoom * Math.min((width - 40) / room[0],
                               (height - 90) / room[1]);
  const turned = (x, y, z) => {
    if (data.flat) return [x, y, 0];
    const a = ct * x + st * y, b = -st * x + ct * y;
    return [a, ce * z + se * b, se * z - ce * b];
  };
  const n = state.v.length / 6, place = new Array(n);
  for (let i = 0; i < n; ++i) {
    const v = state.v, k = 6 * i;
    const p = turned(v[k] + scale * v[k + 3] - c[0],
                     v[k + 1] + scale * v[k + 4] - c[1],
                     v[k + 2] + scale * v[k + 5] - c[2]);
    place[i] = [width / 2 + size * p[0] + shift[0],
                (height - 50) / 2 - size * p[1] + shift[1], p[2]];
  }
  const faces = [];
  for (let i = 0; i < values.length; ++i) {
    const four = [0, 1, 2, 3].map(k => place[state.q[4 * i + k]]);
    faces.push([four[0][2] + four[1][2] + four[2][2] + four[3][2], four, i]);
  }
  faces.sort((a, b) => a[0] - b[0]);
  pen.lineWidth = 0.5; pen.lineJoin = 'round';
  for (const [, four, i] of faces) {
    pen.beginPath();
    four.forEach((p, k) => k ? pen.lineTo(p[0], p[1]) : pen.moveTo(p[0], p[1]));
    pen.closePath();
    const share = (values[i] - shown.from) / (shown.to - shown.from);
    const grey = shown.of_contact && !state.contact[i];
    pen.fillStyle = grey ? '#d8d8d8' : colour(share);
    pen.fill();
    pen.strokeStyle = !lines.checked ? pen.fillStyle
      : grey || share > 0.4 ? 'rgba(0,0,0,.5)' : 'rgba(255,255,255,.4)';
    pen.stroke();
  }
  pen.font = '13px "DejaVu Sans", Verdana, sans-serif';
  pen.fillStyle = pen.strokeStyle = ink;
  const bar = Math.min(260, width - 130), left = 90, top = height - 32;
  for (let i = 0; i < bar; ++i) {
    pen.fillStyle = colour(i / bar);
    pen.fillRect(left + i, top, 1.5, 10);
  }
  pen.fillStyle = ink;
  pen.fillText(shown.label, left, top - 6);
  pen.fillText(digits(shown.from), left, top + 25);
  pen.textAlign = 'right';
  pen.fillText(digits(shown.to), left + bar, top + 25);
  pen.textAlign = 'center';
  ['x', 'y', 'z'].slice(0, data.flat ? 2 : 3).forEach((name, k) => {
    const p = turned(+(k === 0), +(k === 1), +(k === 2));
    pen.lineWidth = 1.5;
    pen.beginPath(); pen.moveTo(40, height - 40);
    pen.lineTo(40 + 22 * p[0], height - 40 - 22 * p[1]);
    pen.stroke();
    pen.fillText(name, 40 + 31 * p[0], height - 36 - 31 * p[1]);
  });
  told.textContent = 't = ' + digits(state.t) + ' s, deformation × ' +
    digits(scale);
}

let from = null;
canvas.onpointerdown = e => {
  from = [e.clientX, e.clientY]; canvas.setPointerCapture(e.pointerId);
};
canvas.onpointermove = e => {
  if (!from) return;
  const dx = e.clientX - from[0], dy = e.clientY - from[1];
  if (data.flat || e.shiftKey) { shift[0] += dx; shift[1] += dy; }
  else { turn += 0.01 * dx; tilt += 0.01 * dy; }
  from = [e.clientX, e.clientY];
  draw();
};
canvas.onpointerup = canvas.onpointercancel = () => { from = null; };
canvas.addEventListener('wheel', e => {
  if (!e.ctrlKey && document.activeElement !== canvas) return;
  e.preventDefault(); zoom *= Math.exp(-0.002 * e.deltaY); draw();
}, { passive: false });
canvas.onkeydown = e => {
  const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0],
                 ArrowUp: [0, -1], ArrowDown: [0, 1] }[e.key];
  if (step) { turn += 0.1 * step[0]; tilt += 0.1 * step[1]; }
  else if (e.key === '+') zoom *= 1.2;
  else if (e.key === '-') zoom /= 1.2;
  else return;
  e.preventDefault(); draw();
};
canvas.ondblclick = () => {
  [turn, tilt] = home; zoom = 1; shift = [0, 0]; draw();
};
controls.oninput = draw;
new ResizeObserver(draw).observe(box);
})();
