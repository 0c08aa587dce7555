// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Where everything is at any time: rows are not equally spaced, between them poses are cubic from
// values and rates, other columns linear.

// The last row at or before t.
function rowAt(run, t) {
  const times = run.t;
  let low = 0, high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= t) low = middle; else high = middle - 1;
  }
  return low;
}

function cubic(a, b, va, vb, h, s) {
  const r = 1 - s;
  return a * (1 + 2 * s) * r * r + b * (3 - 2 * s) * s * s + h * (va * s * r * r - vb * s * s * r);
}

function between(run, column, t, row = rowAt(run, t)) {
  if (!column) return NaN;
  const v = column.values;
  if (row + 1 >= v.length) return v[row];
  const h = run.t[row + 1] - run.t[row];
  return h > 0 ? v[row] + (v[row + 1] - v[row]) * (t - run.t[row]) / h : v[row];
}

// [{x, y, angle, c, s}] of all bodies, the ground first.
function posesAt(run, t) {
  if (!run.poseColumns)
    run.poseColumns = run.drawing.bodies.slice(1).map((b) =>
      [["x", "vx"], ["y", "vy"], ["angle", "omega"]].map(([q, v]) =>
        [run.column(`${b.name}.${q}`), run.column(`${b.name}.${v}`)]));
  const row = rowAt(run, t), last = row + 1 >= run.t.length;
  const h = last ? 0 : run.t[row + 1] - run.t[row];
  const s = h > 0 ? (t - run.t[row]) / h : 0;
  const poses = [{x: 0, y: 0, angle: 0, c: 1, s: 0}];
  for (const columns of run.poseColumns) {
    const [x, y, angle] = columns.map(([q, v]) => {
      if (!(s > 0)) return q.values[row];
      if (!v) return between(run, q, t, row);
      return cubic(q.values[row], q.values[row + 1], v.values[row], v.values[row + 1], h, s);
    });
    poses.push({x, y, angle, c: Math.cos(angle), s: Math.sin(angle)});
  }
  return poses;
}

const pointOf = (pose, x, y) => [pose.x + pose.c * x - pose.s * y, pose.y + pose.s * x + pose.c * y];
const turned = (pose, x, y) => [pose.c * x - pose.s * y, pose.s * x + pose.c * y];

// A contact at a time: the disc's centre and radius, the unit normal from it to the wall, the
// penetration, and the curvature of the wall. Null for contacts without a disc.
function contactAt(run, element, t, poses) {
  const disc = run.drawing.shapes.find((s) => s.kind === "disc" && s.element === element);
  const px = run.column(`${element}.contact_point_x`), py = run.column(`${element}.contact_point_y`);
  if (!disc || !px || !py) return null;
  const center = pointOf(poses[disc.body], disc.points[0], disc.points[1]);
  const wall = run.drawing.shapes.find((s) => (s.kind === "wall" || s.kind === "line") && s.element === element);
  const row = rowAt(run, t);
  const near = row + 1 < run.t.length && t - run.t[row] > run.t[row + 1] - t ? row + 1 : row;
  // The normal of the nearest row, carried on by the wall.
  const then = posesAt(run, run.t[near]);
  const at = pointOf(then[disc.body], disc.points[0], disc.points[1]);
  let nx = px.values[near] - at[0], ny = py.values[near] - at[1];
  const penetrations = run.column(`${element}.penetration`);
  const depth = between(run, penetrations, t, row);
  const length = Math.hypot(nx, ny);
  if (!(length > 1e-12)) return null;
  const turn = wall ? poses[wall.body].angle - then[wall.body].angle : 0;
  // Within the wall a point looks back to the surface.
  const radius = disc.radius || 0, side = penetrations.values[near] > radius ? -1 : 1;
  const c = side * Math.cos(turn) / length, s = side * Math.sin(turn) / length;
  [nx, ny] = [c * nx - s * ny, s * nx + c * ny];
  const force = between(run, run.column(`${element}.normal_force`), t, row);
  const frictions = run.column(`${element}.friction_force`);
  const curvature = run.column(`${element}.wall_curvature`);
  return {
    element, center, radius, normal: [nx, ny], depth, force, friction: frictions ? between(run, frictions, t, row) : 0,
    wallBody: wall ? wall.body : 0, body: disc.body,
    curvature: curvature ? curvature.values[near] : 0,
    point: [center[0] + (radius - depth) * nx, center[1] + (radius - depth) * ny],
  };
}
