// The view: draws the body with WebGL and finds the place under a finger.

const colourStops = [[0.23, 0.30, 0.75], [0.48, 0.62, 0.98], [0.79, 0.84, 0.94], [0.95, 0.79, 0.71], [0.93, 0.52, 0.41], [0.71, 0.02, 0.15]];

const vertexShader = `
attribute vec3 position;
attribute vec3 normal;
attribute float moved;
uniform mat3 turn;
uniform vec3 middle;
uniform vec3 scale;   // two factors from mm to the window, one for the depth
uniform vec2 shift;
uniform float most;
varying vec3 facing;
varying float share;
void main() {
  vec3 p = turn * (position - middle);
  facing = turn * normal;
  share = clamp(moved / most, 0.0, 1.0);
  gl_Position = vec4(p.xy * scale.xy + shift, -p.z * scale.z, 1.0);
}`;

const fragmentShader = `
precision mediump float;
uniform vec3 stops[6];
varying vec3 facing;
varying float share;
void main() {
  vec3 colour = stops[0];
  for (int k = 0; k < 5; ++k) colour = mix(colour, stops[k + 1], clamp(share * 5.0 - float(k), 0.0, 1.0));
  vec3 n = normalize(facing);
  float light = 0.45 + 0.5 * max(0.0, dot(n, normalize(vec3(-0.3, 0.5, 0.8)))) + 0.1 * max(0.0, n.x);
  float glint = max(0.0, dot(n, vec3(-0.185, 0.324, 0.928)));
  glint *= glint;
  glint *= glint;
  glint *= glint;
  float high = glint * glint;
  glint *= high * high;  // the 40th power, cheaper than pow()
  gl_FragColor = vec4(colour * light + 0.12 * glint, 1.0);
}`;

class View {
  // Throws an Error if the browser has no WebGL.
  constructor(canvas, model) {
    this.canvas = canvas;
    this.model = model;
    this.positions = new Float32Array(model.positions);
    this.normals = new Float32Array(model.normals);
    this.moved = new Float32Array(model.vertexCount);
    this.most = 1;
    this.home();
    this.start();
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => this.start());
  }

  start() {
    const gl = this.gl = this.canvas.getContext("webgl", {antialias: true, alpha: true, premultipliedAlpha: true});
    if (!gl) throw new Error("This browser cannot draw with WebGL. Switch on hardware acceleration, or use another browser.");
    const program = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error("The body cannot be drawn: " + gl.getProgramInfoLog(program));
    gl.useProgram(program);
    this.uniform = (name) => gl.getUniformLocation(program, name);
    this.buffers = {};
    for (const [name, width] of [["position", 3], ["normal", 3], ["moved", 1]]) {
      const buffer = this.buffers[name] = gl.createBuffer();
      const place = gl.getAttribLocation(program, name);
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, width, gl.FLOAT, false, 0, 0);
    }
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, this.model.triangles, gl.STATIC_DRAW);
    gl.uniform3fv(this.uniform("stops"), colourStops.flat());
    gl.enable(gl.DEPTH_TEST);
    // Bodies are closed: their inside is never seen, and costs as much as the outside without a graphics card.
    gl.enable(gl.CULL_FACE);
  }

  // The whole body, seen obliquely from above; z is up.
  home() {
    this.yaw = -0.6;
    this.tilt = -1.15;
    this.zoom = 1;
    this.shift = [0, 0];
  }

  // Rows: the directions of the window's right, its top, and towards the eye.
  axes() {
    const [cy, sy, ct, st] = [Math.cos(this.yaw), Math.sin(this.yaw), Math.cos(this.tilt), Math.sin(this.tilt)];
    return [[cy, -sy, 0], [ct * sy, ct * cy, -st], [st * sy, st * cy, ct]];
  }

  // CSS pixels per mm.
  pixelsPerLength() {
    return 0.42 * this.zoom * Math.min(this.canvas.clientWidth, this.canvas.clientHeight) / this.model.size;
  }

  turnBy(right, down) {
    this.yaw -= 0.01 * right;
    this.tilt = Math.min(0.05, Math.max(-Math.PI - 0.05, this.tilt - 0.01 * down));
  }

  // Keeps what is under the pixel (from the middle of the canvas) in its place.
  zoomBy(factor, x = 0, y = 0) {
    const zoom = Math.min(40, Math.max(0.3, this.zoom * factor));
    const ratio = zoom / this.zoom;
    this.shift = [x + (this.shift[0] - x) * ratio, y + (this.shift[1] - y) * ratio];
    this.zoom = zoom;
  }

  // Displacements of the vertices, mm: true to scale.
  setShape(u) {
    const {positions, normals, moved, model} = this;
    for (let k = 0; k < positions.length; ++k) positions[k] = model.positions[k] + u[k];
    this.largest = 0;
    for (let v = 0; v < moved.length; ++v) {
      moved[v] = Math.hypot(u[3 * v], u[3 * v + 1], u[3 * v + 2]);
      if (moved[v] > this.largest) this.largest = moved[v];
    }
    normals.fill(0);
    const t = model.triangles;
    for (let k = 0; k < t.length; k += 3) {
      const a = 3 * t[k], b = 3 * t[k + 1], c = 3 * t[k + 2];
      const x1 = positions[b] - positions[a], y1 = positions[b + 1] - positions[a + 1], z1 = positions[b + 2] - positions[a + 2];
      const x2 = positions[c] - positions[a], y2 = positions[c + 1] - positions[a + 1], z2 = positions[c + 2] - positions[a + 2];
      const x = y1 * z2 - z1 * y2, y = z1 * x2 - x1 * z2, z = x1 * y2 - y1 * x2;
      for (const v of [a, b, c]) {
        normals[v] += x;
        normals[v + 1] += y;
        normals[v + 2] += z;
      }
    }
  }

  draw() {
    const gl = this.gl, canvas = this.canvas, dense = window.devicePixelRatio || 1;
    const width = Math.max(1, Math.round(canvas.clientWidth * dense)), height = Math.max(1, Math.round(canvas.clientHeight * dense));
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    for (const [name, values] of [["position", this.positions], ["normal", this.normals], ["moved", this.moved]]) {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
    }
    const [right, top, eye] = this.axes(), pixels = this.pixelsPerLength();
    gl.uniformMatrix3fv(this.uniform("turn"), false, [0, 1, 2].flatMap((k) => [right[k], top[k], eye[k]]));
    gl.uniform3fv(this.uniform("middle"), this.model.middle);
    gl.uniform3f(this.uniform("scale"), 2 * pixels / canvas.clientWidth, 2 * pixels / canvas.clientHeight, 0.4 / this.model.size);
    gl.uniform2f(this.uniform("shift"), 2 * this.shift[0] / canvas.clientWidth, 2 * this.shift[1] / canvas.clientHeight);
    gl.uniform1f(this.uniform("most"), this.most);
    gl.drawElements(gl.TRIANGLES, this.model.triangles.length, gl.UNSIGNED_SHORT, 0);
  }

  // Position in the window (CSS pixels from the middle, y upwards, and mm towards the eye) of a place.
  project(place) {
    const p = subtract(place, this.model.middle), pixels = this.pixelsPerLength();
    const [right, top, eye] = this.axes();
    return [dot(right, p) * pixels + this.shift[0], dot(top, p) * pixels + this.shift[1], dot(eye, p)];
  }

  // The point {triangle, weights} of the surface under a pixel (from the middle, y upwards); null beside the body. The
  // surface as it is drawn, or at rest.
  pick(x, y, atRest = false) {
    const p = atRest ? this.model.positions : this.positions, t = this.model.triangles;
    const [right, top, eye] = this.axes(), pixels = this.pixelsPerLength(), m = this.model.middle;
    const across = (x - this.shift[0]) / pixels, up = (y - this.shift[1]) / pixels;
    const flat = new Float64Array(p.length);
    for (let k = 0; k < p.length; k += 3) {
      const d = [p[k] - m[0], p[k + 1] - m[1], p[k + 2] - m[2]];
      flat[k] = dot(right, d) - across;
      flat[k + 1] = dot(top, d) - up;
      flat[k + 2] = dot(eye, d);
    }
    let best = null, nearest = -Infinity;
    for (let k = 0; k < t.length; k += 3) {
      const a = 3 * t[k], b = 3 * t[k + 1], c = 3 * t[k + 2];
      const wa = flat[b] * flat[c + 1] - flat[c] * flat[b + 1];
      const wb = flat[c] * flat[a + 1] - flat[a] * flat[c + 1];
      const wc = flat[a] * flat[b + 1] - flat[b] * flat[a + 1];
      if (wa < 0 || wb < 0 || wc < 0) continue;
      const area = wa + wb + wc;
      if (!(area > 0)) continue;
      const depth = (wa * flat[a + 2] + wb * flat[b + 2] + wc * flat[c + 2]) / area;
      if (depth > nearest) {
        nearest = depth;
        best = {triangle: k / 3, weights: [wa / area, wb / area, wc / area]};
      }
    }
    return best;
  }
}
