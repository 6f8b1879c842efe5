// The model: reads the data of the page and computes forces and displacements. The same functions in C++ are in
// app/core/page/touch_page.cpp; docs/touchable-page.md describes the data and the equations.

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

  // The forces at the places that replace a unit force at a point: nine numbers for each place.
  placesAt(point) {
    const places = new Map(), each = this.weightPlaces.length / this.vertexCount;
    for (let k = 0; k < 3; ++k) {
      const v = this.triangles[3 * point.triangle + k], scale = point.weights[k] * this.weightScales[v];
      if (scale === 0) continue;
      for (let i = each * v; i < each * (v + 1); ++i) {
        const place = this.weightPlaces[i];
        if (!places.has(place)) places.set(place, new Array(9).fill(0));
        const sum = places.get(place);
        for (let c = 0; c < 9; ++c) sum[c] += scale * this.weights[9 * i + c];
      }
    }
    return [...places];
  }

  // n numbers at a point: quadratic between the corners and edges, with a bubble that has the known value at the middle.
  interpolate(point, n, atVertices, atEdges, atMiddles) {
    const [t, w] = [point.triangle, point.weights], bubble = 27 * w[0] * w[1] * w[2], s = new Array(n).fill(0);
    for (let c = 0; c < n; ++c) {
      s[c] = bubble * atMiddles[n * t + c];
      for (let k = 0; k < 3; ++k) {
        s[c] += (w[k] * (2 * w[k] - 1) + bubble / 9) * atVertices[n * this.triangles[3 * t + k] + c];
        s[c] += 4 * (w[(k + 1) % 3] * w[(k + 2) % 3] - bubble / 9) * atEdges[n * this.edges[3 * t + k] + c];
      }
    }
    return s;
  }

  // Compliance of a touch.
  ownAt(point) {
    const s = this.interpolate(point, 6, this.own, this.ownAtEdges, this.ownAtMiddles);
    return [s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2]];
  }

  // A point with what every computation there needs.
  prepare(point) {
    return {
      triangle: point.triangle,
      weights: point.weights,
      position: this.at(this.positions, point),
      normal: unit(this.at(this.normals, point)),
      loaded: this.interpolate(point, 3, this.meanLoaded, this.meanLoadedAtEdges, this.meanLoadedAtMiddles),
      own: this.ownAt(point),
      places: this.placesAt(point)
    };
  }

  // Displacement of the mask at a (mm) by a force (N) on the mask at b, another point.
  displacementBy(a, b, force) {
    const rows = 3 * this.placeCount, moved = new Array(3).fill(0);
    const atB = b.places.map(([j, w]) => [j, product(w, force)]);
    for (const [i, weightA] of a.places) {
      const here = [0, 0, 0];
      for (const [j, f] of atB) {
        for (let axis = 0; axis < 3; ++axis) {
          const column = 3 * j + axis, from = column * rows + 3 * i, factor = this.couplingScales[column] * f[axis];
          here[0] += factor * this.couplings[from];
          here[1] += factor * this.couplings[from + 1];
          here[2] += factor * this.couplings[from + 2];
        }
      }
      const there = transposedProduct(weightA, here);
      for (let k = 0; k < 3; ++k) moved[k] += there[k];
    }
    return moved;
  }

  // Compliance between two different points, mm/N: nine numbers, row by row.
  coupling(a, b) {
    const columns = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((f) => this.displacementBy(a, b, f));
    return [0, 1, 2].flatMap((row) => columns.map((column) => column[row]));
  }

  // Displacement of the mask at a point that other touches with known forces cause, with the loads.
  displacementAt(point, others) {
    let sum = point.loaded;
    for (const other of others)
      sum = add(sum, other.point === point ? product(point.own, other.force) : this.displacementBy(point, other.point, other.force));
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

  // Errors of the forces: the model's own in proportion; of this page, what is wrong with the displacement of a touch by
  // its own force and by the others, through the inverse.
  setErrors(active, unknowns, inverse) {
    const errors = this.data.errors;
    const ofTouch = active.map((touch) => unknowns.map((each, k) => each.touch === touch ? k : -1).filter((k) => k >= 0));
    const fromOthers = active.map((touch) => active.reduce((sum, other) => other === touch ? sum : sum +
      errors.coupling[this.couplingClass(touch.point, other.point)] * Math.sqrt(Math.hypot(...touch.point.own) * Math.hypot(...other.point.own)) *
      lengthOf(other.force), 0));
    active.forEach((touch, b) => {
      touch.pageError = 0;
      active.forEach((other, a) => {
        const block = ofTouch[b].map((i) => ofTouch[a].map((k) => inverse[i][k]));
        // The own displacement is in proportion to the force: compliance along the unknowns.
        const own = block.map((row) => [0, 1, 2].map((c) => row.reduce((sum, x, k) =>
          sum + x * transposedProduct(other.point.own, unknowns[ofTouch[a][k]].along)[c], 0)));
        touch.pageError += largestFactor(own) * this.forceErrors[other.point.triangle] * lengthOf(other.force);
        touch.pageError += largestFactor(block) * fromOthers[a];
      });
      touch.error = this.modelErrors[touch.point.triangle] * lengthOf(touch.force) + touch.pageError;
    });
  }

  // The class of coupling errors: by the distance in radii.
  couplingClass(a, b) {
    const distance = lengthOf(subtract(a.position, b.position)) / this.radius;
    return this.data.errors.coupling_radii.filter((each) => distance >= each).length;
  }

  // Displacements of all vertices, mm, in this.displacement: the loads, and the fields of the touches at the nodes.
  deform(touches) {
    const u = this.displacement, atNodes = this.nodeDisplacement, length = atNodes.length;
    u.set(this.loaded);
    const forces = new Map();  // at the places
    for (const {point, force} of touches)
      if (lengthOf(force) > 0)
        for (const [j, weight] of point.places) forces.set(j, add(forces.get(j) || [0, 0, 0], product(weight, force)));
    if (forces.size === 0) return u;
    atNodes.fill(0);
    for (const [j, force] of forces) {
      for (let axis = 0; axis < 3; ++axis) {
        const column = 3 * j + axis, factor = force[axis] * this.fieldScales[column];
        const numbers = this.fields.subarray(column * length, (column + 1) * length);
        for (let k = 0; k < length; ++k) atNodes[k] += factor * numbers[k];
      }
    }
    for (let k = 0; k < u.length; k += 3) {
      for (let i = k; i < k + 3; ++i) {
        const node = 3 * this.nodes[i], weight = this.nodeWeights[i];
        u[k] += weight * atNodes[node];
        u[k + 1] += weight * atNodes[node + 1];
        u[k + 2] += weight * atNodes[node + 2];
      }
    }
    return u;
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
