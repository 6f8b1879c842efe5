// Small vectors and matrices.

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const times = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const lengthOf = (a) => Math.hypot(a[0], a[1], a[2]);
const unit = (a) => times(a, 1 / (lengthOf(a) || 1));

// Products of a matrix of nine numbers, row by row, with a vector, and of its transpose with one.
const product = (m, a) => [dot(m.slice(0, 3), a), dot(m.slice(3, 6), a), dot(m.slice(6, 9), a)];
const transposedProduct = (m, a) => [0, 1, 2].map((k) => m[k] * a[0] + m[k + 3] * a[1] + m[k + 6] * a[2]);

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

// A bound of the factor by which a matrix (rows of numbers) stretches a vector: the root of its norms by rows and columns.
function largestFactor(rows) {
  const sums = (lines) => Math.max(...lines.map((line) => line.reduce((sum, x) => sum + Math.abs(x), 0)));
  return Math.sqrt(sums(rows) * sums(rows[0].map((_, c) => rows.map((row) => row[c]))));
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
