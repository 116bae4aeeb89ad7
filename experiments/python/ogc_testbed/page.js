// Draws the motions of the page with WebGL 2. Positions and values were quantised by page.py, which says how.
const $ = (id) => document.getElementById(id);
const data = JSON.parse($("data").textContent);

async function bytesOf(text) {
  const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Low bytes come first, then high bytes.
function wordsOf(bytes) {
  const count = bytes.length / 2, words = new Uint16Array(count);
  for (let i = 0; i < count; ++i) words[i] = bytes[i] | (bytes[count + i] << 8);
  return words;
}

// Undoes the differences between frames, modulo the range of the type.
function summed(values, width) {
  for (let i = width; i < values.length; ++i) values[i] += values[i - width];
  return values;
}

async function load(motion) {
  const ints = async (text) => new Int32Array((await bytesOf(text)).buffer);
  motion.triangles = new Uint32Array((await bytesOf(motion.triangles)).buffer);
  motion.edges = await ints(motion.edges);
  motion.body = await ints(motion.body);
  motion.words = summed(wordsOf(await bytesOf(motion.positions)), 3 * motion.vertices);
  for (const field of motion.fields) field.values = summed(await bytesOf(field.values), motion.vertices);
  if (motion.contacts) {
    motion.contacts.first = await ints(motion.contacts.first);
    motion.contacts.ends = wordsOf(await bytesOf(motion.contacts.ends));
  }
  motion.points = new Float32Array(3 * motion.vertices);
  motion.normals = new Float32Array(3 * motion.vertices);
  motion.colours = new Uint8Array(8 * motion.vertices);
  const wires = new Set();
  for (let t = 0; t < motion.triangles.length; t += 3)
    for (let k = 0; k < 3; ++k) {
      const a = motion.triangles[t + k], b = motion.triangles[t + (k + 1) % 3];
      wires.add(Math.min(a, b) * motion.vertices + Math.max(a, b));
    }
  motion.wires = Uint32Array.from([...wires].flatMap((w) => [Math.floor(w / motion.vertices), w % motion.vertices]));
}

function widened(motion, words, from, to, out) {
  for (let i = from; i < to; ++i) out[i - from] = motion.low[(i - from) % 3] + words[i] * motion.step;
  return out;
}

function setFrame(motion, frame) {
  const width = 3 * motion.vertices, { points, normals, triangles } = motion;
  widened(motion, motion.words, frame * width, (frame + 1) * width, points);
  normals.fill(0);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ux = points[b] - points[a], uy = points[b + 1] - points[a + 1], uz = points[b + 2] - points[a + 2];
    const vx = points[c] - points[a], vy = points[c + 1] - points[a + 1], vz = points[c + 2] - points[a + 2];
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    for (const i of [a, b, c]) { normals[i] += nx; normals[i + 1] += ny; normals[i + 2] += nz; }
  }
}

const parts = (colour) => [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));
const stops = data.scale.map(parts), none = parts(data.none);

function shade(share) {
  const at = Math.min(Math.max(share, 0), 1) * (stops.length - 1), k = Math.min(Math.floor(at), stops.length - 2);
  return stops[k].map((low, i) => low + (at - k) * (stops[k + 1][i] - low));
}

// The value of a vertex; null where there is none. Byte 0 means none, and 1 to 255 are the range.
function valueOf(motion, field, frame, vertex) {
  const byte = field.values[(field.frames > 1 ? frame : 0) * motion.vertices + vertex];
  return byte === 0 ? null : field.low + (byte - 1) / 254 * (field.high - field.low);
}

function setColours(motion, frame) {
  const field = motion.fields.find((f) => f.name === $("colour").value), range = limits();
  for (let v = 0; v < motion.vertices; ++v) {
    const value = field ? valueOf(motion, field, frame, v) : null;
    const body = motion.bodies[motion.body[v]];
    const front = !field ? parts(body.front) : value === null ? none
      : shade((value - range[0]) / Math.max(range[1] - range[0], 1e-300));
    motion.colours.set(front, 8 * v);
    motion.colours.set(field ? front : parts(body.back), 8 * v + 4);
  }
}

// Both runs share one scale.
function limits() {
  const found = data.motions.flatMap((m) => m.fields.filter((f) => f.name === $("colour").value));
  return [Math.min(...found.map((f) => f.low)), Math.max(...found.map((f) => f.high))];
}

// ---- vectors and the camera

const sub = (a, b) => a.map((x, i) => x - b[i]), add = (a, b, s = 1) => a.map((x, i) => x + s * b[i]);
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.max(Math.hypot(...a), 1e-30));
const home = () => ({ turn: Math.atan2(0.55, 1), lift: 0.3, distance: 3.5 * data.radius, target: [...data.target] });
let camera = home();

function axes() {
  const { turn, lift } = camera;
  const away = [Math.sin(turn) * Math.cos(lift), Math.sin(lift), Math.cos(turn) * Math.cos(lift)];
  const right = [Math.cos(turn), 0, -Math.sin(turn)];
  return { away, right, up: cross(away, right) };
}

function matrix(aspect) {
  const { away, right, up } = axes(), eye = add(camera.target, away, camera.distance);
  const near = camera.distance / 100, far = camera.distance + 60 * data.radius;
  const f = Math.min(1, aspect) / Math.tan(0.5 * data.angle), d = near - far;
  const view = [[...right, -dot(right, eye)], [...up, -dot(up, eye)], [...away, -dot(away, eye)]];
  const rows = [view[0].map((x) => x * f / aspect), view[1].map((x) => x * f),
    view[2].map((x, i) => x * (far + near) / d + (i === 3 ? 2 * far * near / d : 0)), view[2].map((x) => -x)];
  return { eye, values: Float32Array.from([0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column]))) };
}

function projected(values, p) {
  const at = [0, 1, 2, 3].map((i) => values[i] * p[0] + values[4 + i] * p[1] + values[8 + i] * p[2] + values[12 + i]);
  return [(at[0] / at[3] + 1) / 2 * canvas.clientWidth, (1 - at[1] / at[3]) / 2 * canvas.clientHeight, at[3]];
}

// ---- drawing

const canvas = $("canvas"), gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
const VERTEX = `#version 300 es
in vec3 point, normal; in vec4 front, back; uniform mat4 camera; uniform vec3 offset; uniform float nearer;
out vec3 n, place; out vec4 f, b;
void main() { n = normal; f = front; b = back; place = point + offset; gl_Position = camera * vec4(place, 1.0);
  gl_Position.z -= nearer * gl_Position.w; gl_PointSize = 11.0; }`;
const FRAGMENT = `#version 300 es
precision highp float; in vec3 n, place; in vec4 f, b; uniform vec3 eye; uniform vec4 flat_colour; out vec4 colour;
void main() {
  if (flat_colour.a > 0.0) { colour = flat_colour; return; }
  if (length(n) == 0.0) { colour = vec4(f.rgb, 1.0); return; }  // curves have no normal
  vec3 normal = normalize(n), toward = normalize(eye - place);
  bool front = gl_FrontFacing;
  if (!front) normal = -normal;
  float key = max(dot(normal, normalize(toward + vec3(0.4, 0.7, 0.2))), 0.0), sky = 0.5 + 0.5 * normal.y;
  colour = vec4((front ? f : b).rgb * (0.5 + 0.15 * sky + 0.42 * key), 1.0);
}`;

function program() {
  const made = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  ["point", "normal", "front", "back"].forEach((name, i) => gl.bindAttribLocation(made, i, name));
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
  gl.useProgram(made);
  return (name) => gl.getUniformLocation(made, name);
}

function buffer(kind, values, usage = gl.STATIC_DRAW) {
  const made = gl.createBuffer();
  gl.bindBuffer(kind, made);
  gl.bufferData(kind, values, usage);
  return made;
}

function bind(place, made, size, type = gl.FLOAT, stride = 0, offset = 0) {
  gl.bindBuffer(gl.ARRAY_BUFFER, made);
  gl.enableVertexAttribArray(place);
  gl.vertexAttribPointer(place, size, type, type !== gl.FLOAT, stride, offset);
}

function upload(motion) {
  motion.buffers ??= { triangles: buffer(gl.ELEMENT_ARRAY_BUFFER, motion.triangles),
    wires: buffer(gl.ELEMENT_ARRAY_BUFFER, motion.wires),
    edges: buffer(gl.ELEMENT_ARRAY_BUFFER, Uint32Array.from(motion.edges)),
    points: gl.createBuffer(), normals: gl.createBuffer(), colours: gl.createBuffer(), lines: gl.createBuffer() };
  for (const name of ["points", "normals", "colours"]) {
    gl.bindBuffer(gl.ARRAY_BUFFER, motion.buffers[name]);
    gl.bufferData(gl.ARRAY_BUFFER, motion[name], gl.DYNAMIC_DRAW);
  }
}

function contactEnds(motion) {
  const { first, ends } = motion.contacts, from = 6 * first[motion.frame], to = 6 * first[motion.frame + 1];
  return widened(motion, ends, from, to, new Float32Array(to - from));
}

// A cross of the contact radius in the plane across the middle of each contact, as motion.py has it.
function planeEnds(motion) {
  const ends = contactEnds(motion), out = [];
  for (let i = 0; i < ends.length; i += 6) {
    const a = [...ends.subarray(i, i + 3)], b = [...ends.subarray(i + 3, i + 6)], n = unit(sub(b, a));
    const least = n.reduce((best, x, k) => Math.abs(x) < Math.abs(n[best]) ? k : best, 0);
    const u = unit(cross(n, [0, 1, 2].map((k) => Number(k === least)))), middle = a.map((x, k) => (x + b[k]) / 2);
    for (const side of [u, cross(n, u)])
      out.push(...add(middle, side, -motion.contact_radius / 2), ...add(middle, side, motion.contact_radius / 2));
  }
  return Float32Array.from(out);
}

let uniform, picked = null;

function flat(colour, nearer) {
  gl.uniform4f(uniform("flat_colour"), ...(colour ? [...parts(colour).map((x) => x / 255), 1] : [0, 0, 0, 0]));
  gl.uniform1f(uniform("nearer"), nearer);
}

function drawMotion(motion) {
  const { buffers } = motion;
  gl.uniform3f(uniform("offset"), ...motion.offset);
  bind(0, buffers.points, 3);
  bind(1, buffers.normals, 3);
  bind(2, buffers.colours, 4, gl.UNSIGNED_BYTE, 8, 0);
  bind(3, buffers.colours, 4, gl.UNSIGNED_BYTE, 8, 4);
  const elements = (kind, name, count) => {
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers[name]);
    gl.drawElements(kind, count, gl.UNSIGNED_INT, 0);
  };
  flat(null, 0);
  elements(gl.TRIANGLES, "triangles", motion.triangles.length);
  elements(gl.LINES, "edges", motion.edges.length);
  flat("#202020", 2e-4);
  if ($("wires").checked) elements(gl.LINES, "wires", motion.wires.length);
  for (const n of [1, 2, 3]) gl.disableVertexAttribArray(n);
  for (const [box, ends, colour] of [["contacts", contactEnds, data.contacts], ["planes", planeEnds, data.planes]])
    if ($(box).checked && motion.contacts) points(ends(motion), gl.LINES, colour);
  if (picked && picked.motion === motion)
    points(motion.points.slice(3 * picked.vertex, 3 * picked.vertex + 3), gl.POINTS, "#000000");

  function points(values, kind, colour) {
    gl.bindBuffer(gl.ARRAY_BUFFER, buffers.lines);
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
    bind(0, buffers.lines, 3);
    flat(colour, 0);
    gl.disable(gl.DEPTH_TEST);  // contacts lie between surfaces, which would hide them
    gl.drawArrays(kind, 0, values.length / 3);
    gl.enable(gl.DEPTH_TEST);
  }
}

function draw() {
  const scale = window.devicePixelRatio || 1;
  canvas.width = canvas.clientWidth * scale;
  canvas.height = canvas.clientHeight * scale;
  const { eye, values } = matrix(canvas.width / Math.max(canvas.height, 1));
  gl.viewport(0, 0, canvas.width, canvas.height);
  gl.clearColor(1, 1, 1, 1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.enable(gl.DEPTH_TEST);
  gl.uniformMatrix4fv(uniform("camera"), false, values);
  gl.uniform3f(uniform("eye"), ...eye);
  data.motions.forEach(drawMotion);
}

// ---- what the reader does

const number = (x) => Number(x.toPrecision(4)).toString();

// The frame of a motion whose time is nearest; times ascend.
function nearest(times, time) {
  let best = 0;
  times.forEach((t, i) => { if (Math.abs(t - time) < Math.abs(times[best] - time)) best = i; });
  return best;
}

function show() {
  const main = data.motions[0], frame = Number($("frame").value), time = main.times[frame];
  data.motions.forEach((motion, i) => {
    motion.frame = i === 0 ? frame : nearest(motion.times, time);
    setFrame(motion, motion.frame);
    setColours(motion, motion.frame);
    upload(motion);
  });
  $("when").textContent = `step ${main.steps[frame]}, ${number(time)} s (frame ${frame + 1} of ${main.steps.length})`;
  describe();
  draw();
}

function describe() {
  const field = data.motions.flatMap((m) => m.fields).find((f) => f.name === $("colour").value), range = limits();
  $("scale").hidden = !field;
  if (field) {
    $("bar").style.background = `linear-gradient(to right, ${data.scale.join(", ")})`;
    $("least").textContent = `${number(range[0])} ${field.unit}`;
    $("most").textContent = `${number(range[1])} ${field.unit}`;
    $("meaning").textContent = field.meaning;
  }
  const rows = [];
  if (picked) {
    const { motion, vertex } = picked, point = [...motion.points.subarray(3 * vertex, 3 * vertex + 3)];
    if (data.motions.length > 1) rows.push(["run", motion.name]);
    rows.push(["vertex", vertex], ["body", motion.bodies[motion.body[vertex]].name],
      ["position", `${point.map((x) => Number(x.toPrecision(6))).join(", ")} m`]);
    for (const f of motion.fields) {
      const value = valueOf(motion, f, motion.frame, vertex);
      rows.push([f.name, value === null ? "none" : `${number(value)} ${f.unit} ± ${number((f.high - f.low) / 508)}`]);
    }
  }
  $("row").replaceChildren(...rows.map(([name, text]) => {
    const line = document.createElement("tr"), head = document.createElement("th"), cell = document.createElement("td");
    head.textContent = name;
    cell.textContent = text;
    line.append(head, cell);
    return line;
  }));
}

function pick(motion, vertex) {
  picked = motion && vertex >= 0 && vertex < motion.vertices ? { motion, vertex } : null;
  $("vertex").value = picked ? vertex : "";
  if (picked) $("which").value = data.motions.indexOf(motion);
  describe();
  draw();
}

// The corner nearest to the click of the first triangle under it; without one the nearest vertex within 12 pixels.
function pickAt(x, y) {
  const { eye, values } = matrix(canvas.clientWidth / canvas.clientHeight);
  const { away, right, up } = axes(), aspect = canvas.clientWidth / canvas.clientHeight;
  const reach = Math.tan(0.5 * data.angle) / Math.min(1, aspect);
  const side = (2 * x / canvas.clientWidth - 1) * reach * aspect, high = (1 - 2 * y / canvas.clientHeight) * reach;
  const ray = add(add(away.map((a) => -a), right, side), up, high);
  let best = { at: Infinity }, near = { at: 12 };
  for (const motion of data.motions) {
    const start = sub(eye, motion.offset), p = motion.points, at = (v) => [p[3 * v], p[3 * v + 1], p[3 * v + 2]];
    const pixels = (v) => {
      const [px, py] = projected(values, add(at(v), motion.offset));
      return Math.hypot(px - x, py - y);
    };
    for (let t = 0; t < motion.triangles.length; t += 3) {
      const corners = [...motion.triangles.subarray(t, t + 3)], [a, b, c] = corners.map(at);
      const u = sub(b, a), v = sub(c, a), h = cross(ray, v), d = dot(u, h), s = sub(start, a), q = cross(s, u);
      const [i, j, k] = [dot(s, h) / d, dot(ray, q) / d, dot(v, q) / d];
      if (i >= 0 && j >= 0 && i + j <= 1 && k > 0 && k < best.at)
        best = { at: k, motion, vertex: corners.reduce((m, w) => pixels(w) < pixels(m) ? w : m) };
    }
    for (let v = 0; v < motion.vertices; ++v) if (pixels(v) < near.at) near = { at: pixels(v), motion, vertex: v };
  }
  const found = best.motion ? best : near;
  pick(found.motion, found.vertex);
}

const pointers = new Map();
let moved = 0, playing = null;

function onMove(event) {
  const last = pointers.get(event.pointerId);
  if (!last) return;
  const dx = event.clientX - last.x, dy = event.clientY - last.y, { right, up } = axes();
  const others = [...pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
  moved += Math.abs(dx) + Math.abs(dy);
  if (others.length > 0) {
    const before = Math.hypot(last.x - others[0].x, last.y - others[0].y);
    const now = Math.hypot(event.clientX - others[0].x, event.clientY - others[0].y);
    camera.distance *= before / Math.max(now, 1);
  }
  if (others.length > 0 || last.button === 2 || event.shiftKey) {
    const size = 2 * camera.distance * Math.tan(0.5 * data.angle) / canvas.clientHeight;
    camera.target = add(add(camera.target, right, -dx * size), up, dy * size);
  } else turnBy(-dx * 0.008, dy * 0.008);
  pointers.set(event.pointerId, { ...last, x: event.clientX, y: event.clientY });
  draw();
}

function turnBy(turn, lift) {
  camera.turn += turn;
  camera.lift = Math.min(Math.max(camera.lift + lift, -1.55), 1.55);
}

function step(count) {
  const last = Number($("frame").max);
  $("frame").value = Math.min(Math.max(Number($("frame").value) + count, 0), last);
  show();
}

function play() {
  $("play").textContent = playing ? "Play" : "Pause";
  if (playing) { cancelAnimationFrame(playing.request); playing = null; return; }
  const times = data.motions[0].times, last = times.length - 1;
  if (Number($("frame").value) >= last) $("frame").value = 0;
  playing = { at: performance.now(), time: times[Number($("frame").value)] };
  const tick = (now) => {
    playing.time += (now - playing.at) / 1000 * Number($("pace").value);
    playing.at = now;
    $("frame").value = nearest(times, playing.time);
    show();
    if (playing.time >= times[last]) { play(); return; }
    playing.request = requestAnimationFrame(tick);
  };
  playing.request = requestAnimationFrame(tick);
}

const KEYS = { " ": play, ",": () => step(-1), ".": () => step(1) };
const CANVAS_KEYS = { ArrowLeft: () => turnBy(-0.1, 0), ArrowRight: () => turnBy(0.1, 0), ArrowUp: () => turnBy(0, 0.1),
  ArrowDown: () => turnBy(0, -0.1), "+": () => { camera.distance /= 1.15; }, "-": () => { camera.distance *= 1.15; } };

function listen() {
  canvas.addEventListener("pointerdown", (e) => {
    canvas.setPointerCapture(e.pointerId);
    pointers.set(e.pointerId, { x: e.clientX, y: e.clientY, button: e.button });
    moved = 0;
  });
  canvas.addEventListener("pointermove", onMove);
  canvas.addEventListener("pointerup", (e) => {
    const box = canvas.getBoundingClientRect();
    if (moved < 4 && e.button === 0) pickAt(e.clientX - box.left, e.clientY - box.top);
    pointers.delete(e.pointerId);
  });
  canvas.addEventListener("pointercancel", (e) => pointers.delete(e.pointerId));
  canvas.addEventListener("contextmenu", (e) => e.preventDefault());
  canvas.addEventListener("wheel", (e) => {
    e.preventDefault();
    camera.distance *= Math.exp(0.001 * e.deltaY);
    draw();
  }, { passive: false });
  canvas.addEventListener("keydown", (e) => {
    if (!CANVAS_KEYS[e.key]) return;
    e.preventDefault();
    CANVAS_KEYS[e.key]();
    draw();
  });
  document.addEventListener("keydown", (e) => {
    if (!KEYS[e.key] || /INPUT|SELECT|BUTTON|SUMMARY/.test(e.target.tagName)) return;
    e.preventDefault();
    KEYS[e.key]();
  });
  for (const id of ["frame", "colour", "contacts", "planes", "wires"]) $(id).addEventListener("input", show);
  for (const id of ["vertex", "which"])
    $(id).addEventListener("change", () => pick(data.motions[Number($("which").value)], Number($("vertex").value)));
  $("play").addEventListener("click", play);
  $("back").addEventListener("click", () => step(-1));
  $("on").addEventListener("click", () => step(1));
  $("reset").addEventListener("click", () => { camera = home(); draw(); });
  new ResizeObserver(draw).observe(canvas);
}

async function begin() {
  if (!gl) throw new Error("this browser has no WebGL 2");
  await Promise.all(data.motions.map(load));
  uniform = program();
  $("title").textContent = data.title;
  $("panel").open = window.innerWidth > 700;
  $("frame").max = data.motions[0].steps.length - 1;
  $("frame").value = data.frame;
  const names = ["body", ...new Set(data.motions.flatMap((m) => m.fields.map((f) => f.name)))];
  for (const name of names) $("colour").add(new Option(name, name, false, name === data.colour));
  data.motions.forEach((motion, i) => $("which").add(new Option(motion.name, i)));
  $("which").hidden = data.motions.length === 1;
  const has = data.motions.some((m) => m.contacts);
  for (const name of ["contacts", "planes"]) {
    $(`${name}-label`).hidden = !has;
    $(name).checked = data.shown.includes(name);
  }
  $("error").textContent = data.error;
  listen();
  show();
  document.documentElement.dataset.ready = "yes";
}

begin().catch((error) => {
  const text = document.createElement("p");
  text.id = "problem";
  text.textContent = `The page can't be drawn: ${error.message}. Firefox 113, Chrome 103, Safari 16.4 or later can.`;
  document.querySelector("main").replaceChildren(text);
});
