// The model: reads the data of the page and computes forces and displacements. The same functions in C++ are in
// app/core/page/touch_page.cpp; docs/touchable-page.md describes the data and the equations.

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const times = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const lengthOf = (a) => Math.hypot(a[0], a[1], a[2]);
const unit = (a) => times(a, 1 / (lengthOf(a) || 1));

// Arrays of numbers from the text of base 64. They are stored in little-endian order, as all browsers have it.
function readBlocks(data, text) {
  const characters = atob(text);
  const bytes = new Uint8Array(characters.length);
  for (let k = 0; k < bytes.length; ++k) bytes[k] = characters.charCodeAt(k);
  const types = {f32: Float32Array, i16: Int16Array, u16: Uint16Array, u8: Uint8Array};
  const blocks = {};
  for (const [name, block] of Object.entries(data.blocks)) {
    const Type = types[block.type];
    blocks[name] = new Type(bytes.buffer, block.at, block.bytes / Type.BYTES_PER_ELEMENT);
  }
  return blocks;
}

class Model {
  constructor(data, text) {
    this.data = data;
    Object.assign(this, readBlocks(data, text));
    this.vertexCount = this.positions.length / 3;
    this.triangleCount = this.triangles.length / 3;
    this.placeCount = this.places.length;
    this.radius = data.radius_mm;
    const nu = data.material.poisson_ratio;
    const shear = data.material.youngs_modulus_MPa / (2 * (1 + nu));
    // Factors of the kernel across the surface (less in the direction of the normal).
    this.kernelAcross = (1 - nu / 2) / (2 * Math.PI * shear);
    this.kernelLess = nu / 2 / (2 * Math.PI * shear);
    this.displacement = new Float32Array(this.positions.length);
    this.nodeDisplacement = new Float32Array(3 * data.node_count);
    // Middle and radius of the body, for the view.
    let low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let v = 0; v < this.vertexCount; ++v) {
      const p = this.row(this.positions, v);
      low = low.map((x, k) => Math.min(x, p[k]));
      high = high.map((x, k) => Math.max(x, p[k]));
    }
    this.middle = times(add(low, high), 0.5);
    this.size = 0;
    for (let v = 0; v < this.vertexCount; ++v)
      this.size = Math.max(this.size, lengthOf(subtract(this.row(this.positions, v), this.middle)));
  }

  row(values, index) {
    return [values[3 * index], values[3 * index + 1], values[3 * index + 2]];
  }

  // Interpolation of rows of `width` numbers per vertex at a point {triangle, weights}.
  at(values, point, width = 3) {
    const result = new Array(width).fill(0);
    for (let k = 0; k < 3; ++k) {
      const v = this.triangles[3 * point.triangle + k];
      for (let c = 0; c < width; ++c) result[c] += point.weights[k] * values[width * v + c];
    }
    return result;
  }

  // A point with what every computation there needs.
  prepare(point) {
    const places = new Map();
    const each = this.weights.length / this.vertexCount;
    for (let k = 0; k < 3; ++k) {
      const v = this.triangles[3 * point.triangle + k];
      for (let i = each * v; i < each * (v + 1); ++i) {
        const weight = point.weights[k] * this.weights[i];
        if (weight !== 0) places.set(this.weightPlaces[i], (places.get(this.weightPlaces[i]) || 0) + weight);
      }
    }
    // A bubble over the triangle gives the compliance its known value at the middle.
    const bubble = 27 * point.weights[0] * point.weights[1] * point.weights[2];
    const s = this.at(this.own, {triangle: point.triangle, weights: point.weights.map((w) => w - bubble / 3)}, 6)
        .map((x, k) => x + bubble * this.ownAtMiddles[6 * point.triangle + k]);
    return {
      triangle: point.triangle,
      weights: point.weights,
      position: this.at(this.positions, point),
      normal: unit(this.at(this.normals, point)),
      loaded: this.at(this.meanLoaded, point),
      own: [s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2]],
      places: [...places]
    };
  }

  // Compliance between two different points, mm/N: displacement of the mask at a per force on the mask at b; nine
  // numbers, row by row. Between the places, only what remains without the kernel is interpolated.
  coupling(a, b) {
    const core = this.radius / 2.408;
    const distance = Math.hypot(lengthOf(subtract(a.position, b.position)), core);
    const result = new Array(9).fill(0);
    const rows = 3 * this.placeCount;
    for (let row = 0; row < 3; ++row) {
      for (let column = 0; column < 3; ++column) {
        let sum = ((row === column ? this.kernelAcross : 0) -
                   this.kernelLess * 0.5 * (a.normal[row] * a.normal[column] + b.normal[row] * b.normal[column])) / distance;
        for (const [j, weightB] of b.places) {
          const from = (3 * j + column) * rows + row, scale = this.couplingScales[3 * j + column] * weightB;
          for (const [i, weightA] of a.places) sum += weightA * scale * this.couplings[from + 3 * i];
        }
        result[3 * row + column] = sum;
      }
    }
    return result;
  }

  // Displacement of the mask at a point that other touches with known forces cause, with the loads.
  displacementAt(point, others) {
    let sum = point.loaded;
    for (const other of others) {
      const c = other.point === point ? point.own : this.coupling(point, other.point);
      for (let row = 0; row < 3; ++row) sum = sum.map((x, k) => k === row ? x + dot(c.slice(3 * row, 3 * row + 3), other.force) : x);
    }
    return sum;
  }

  // Sets the force (N) and its error of every touch {point, displacement} that grabs, and {point, depth} that presses:
  // a press prescribes the displacement along the normal and exerts no force along the surface.
  solve(touches) {
    for (const touch of touches) {
      touch.force = [0, 0, 0];
      touch.error = 0;
    }
    let active = touches.slice();
    for (;;) {
      const unknowns = [];
      for (const touch of active) {
        if (touch.depth === undefined) {
          const rise = subtract(touch.displacement, touch.point.loaded);
          for (let k = 0; k < 3; ++k) unknowns.push({touch, along: [0, 1, 2].map((c) => c === k ? 1 : 0), rise: rise[k]});
        } else {
          unknowns.push({touch, along: times(touch.point.normal, -1), rise: touch.depth});
        }
      }
      const n = unknowns.length;
      const blocks = new Map();
      const block = (a, b) => {
        const key = active.indexOf(a) * active.length + active.indexOf(b);
        if (!blocks.has(key)) blocks.set(key, a === b ? a.point.own : this.coupling(a.point, b.point));
        return blocks.get(key);
      };
      const matrix = unknowns.map((a) => unknowns.map((b) => {
        const c = block(a.touch, b.touch);
        let sum = 0;
        for (let row = 0; row < 3; ++row) sum += a.along[row] * dot(c.slice(3 * row, 3 * row + 3), b.along);
        return sum;
      }));
      const inverse = inverseOf(matrix);
      const values = unknowns.map((_, i) => unknowns.reduce((sum, each, k) => sum + inverse[i][k] * each.rise, 0));
      // A finger cannot pull: one that would is lifted, and the others are solved again.
      const lifted = unknowns.findIndex((each, k) => each.touch.depth !== undefined && values[k] < 0);
      if (lifted >= 0) {
        active = active.filter((touch) => touch !== unknowns[lifted].touch);
        continue;
      }
      for (const touch of active) touch.force = [0, 0, 0];
      unknowns.forEach((each, k) => { each.touch.force = add(each.touch.force, times(each.along, values[k])); });
      this.setErrors(active, unknowns, inverse);
      return;
    }
  }

  // Errors of the forces: of the model and of the compliance of the touch itself in proportion; the error of the
  // displacement that other touches cause here, through the inverse. Norms are means over the three directions.
  setErrors(active, unknowns, inverse) {
    const errors = this.data.errors;
    const wrong = active.map((touch) => {
      let sum = 0;
      for (const other of active) {
        if (other === touch) continue;
        const isNear = lengthOf(subtract(touch.point.position, other.point.position)) < 2 * this.radius;
        sum += (isNear ? errors.coupling_near : errors.coupling) * lengthOf(other.force);
      }
      return sum * Math.hypot(...touch.point.own) / Math.sqrt(3);
    });
    active.forEach((touch) => {
      let fromOthers = 0;
      active.forEach((other, j) => {
        let square = 0;
        unknowns.forEach((a, i) => {
          unknowns.forEach((b, k) => {
            if (a.touch === touch && b.touch === other) square += inverse[i][k] * inverse[i][k];
          });
        });
        fromOthers += Math.sqrt(square / 3) * wrong[j];
      });
      touch.pageError = this.forceErrors[touch.point.triangle] * lengthOf(touch.force) + fromOthers;
      touch.error = errors.model * lengthOf(touch.force) + touch.pageError;
    });
  }

  // Displacements of all vertices, mm, in this.displacement: the loads, what remains of the Green's functions at the
  // nodes, and the kernel at the touches themselves.
  deform(touches) {
    const u = this.displacement, atNodes = this.nodeDisplacement, length = atNodes.length;
    u.set(this.loaded);
    atNodes.fill(0);
    const pressed = touches.filter((touch) => lengthOf(touch.force) > 0);
    for (const {point, force} of pressed) {
      for (const [j, weight] of point.places) {
        for (let axis = 0; axis < 3; ++axis) {
          const column = 3 * j + axis, factor = weight * force[axis] * this.fieldScales[column];
          const numbers = this.fields.subarray(column * length, (column + 1) * length);
          for (let k = 0; k < length; ++k) atNodes[k] += factor * numbers[k];
        }
      }
    }
    if (pressed.length === 0) return u;
    for (let k = 0; k < u.length; k += 3) {
      for (let i = k; i < k + 3; ++i) {
        const node = 3 * this.nodes[i], weight = this.nodeWeights[i];
        u[k] += weight * atNodes[node];
        u[k + 1] += weight * atNodes[node + 1];
        u[k + 2] += weight * atNodes[node + 2];
      }
    }
    const core = this.radius / 3.2;
    for (const {point, force} of pressed) this.addKernel(point.position, point.normal, force, core * core);
    // A support holds these vertices, which the interpolation does not know exactly.
    for (let v = 0; v < this.vertexCount; ++v)
      if (this.held[v]) for (let k = 3 * v; k < 3 * v + 3; ++k) u[k] = this.loaded[k];
    return u;
  }

  addKernel(from, normal, force, core2) {
    const along = dot(force, normal), u = this.displacement, p = this.positions;
    const x = this.kernelAcross * force[0] - this.kernelLess * along * normal[0];
    const y = this.kernelAcross * force[1] - this.kernelLess * along * normal[1];
    const z = this.kernelAcross * force[2] - this.kernelLess * along * normal[2];
    for (let k = 0; k < u.length; k += 3) {
      const dx = p[k] - from[0], dy = p[k + 1] - from[1], dz = p[k + 2] - from[2];
      const size = 1 / Math.sqrt(dx * dx + dy * dy + dz * dz + core2);
      u[k] += size * x;
      u[k + 1] += size * y;
      u[k + 2] += size * z;
    }
  }

  // The point of the touchable surface nearest to a place (mm), at rest.
  nearest(place) {
    let best = null, least = Infinity;
    for (let t = 0; t < this.triangleCount; ++t) {
      if (!this.touchable[t]) continue;
      const weights = nearestInTriangle(place, ...[0, 1, 2].map((k) => this.row(this.positions, this.triangles[3 * t + k])));
      const distance = lengthOf(subtract(this.at(this.positions, {triangle: t, weights}), place));
      if (distance < least) {
        least = distance;
        best = {triangle: t, weights};
      }
    }
    return best;
  }
}

// Barycentric coordinates of the point of a triangle nearest to p (Ericson, Real-Time Collision Detection, 5.1.5).
function nearestInTriangle(p, a, b, c) {
  const ab = subtract(b, a), ac = subtract(c, a), ap = subtract(p, a), bp = subtract(p, b), cp = subtract(p, c);
  const d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return [1, 0, 0];
  if (d3 >= 0 && d4 <= d3) return [0, 1, 0];
  if (d6 >= 0 && d5 <= d6) return [0, 0, 1];
  const vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return [1 - d1 / (d1 - d3), d1 / (d1 - d3), 0];
  const vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return [1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)];
  const va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const w = (d4 - d3) / (d4 - d3 + d5 - d6);
    return [0, 1 - w, w];
  }
  const sum = va + vb + vc;
  return [va / sum, vb / sum, vc / sum];
}

// Inverse of a small matrix by Gauss-Jordan elimination with pivots.
function inverseOf(matrix) {
  const n = matrix.length;
  const rows = matrix.map((row, i) => [...row, ...row.map((_, k) => k === i ? 1 : 0)]);
  for (let k = 0; k < n; ++k) {
    let pivot = k;
    for (let i = k + 1; i < n; ++i) if (Math.abs(rows[i][k]) > Math.abs(rows[pivot][k])) pivot = i;
    [rows[k], rows[pivot]] = [rows[pivot], rows[k]];
    const scale = 1 / rows[k][k];
    rows[k] = rows[k].map((x) => x * scale);
    for (let i = 0; i < n; ++i) {
      if (i === k) continue;
      const factor = rows[i][k];
      if (factor !== 0) rows[i] = rows[i].map((x, c) => x - factor * rows[k][c]);
    }
  }
  return rows.map((row) => row.slice(n));
}
