// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// From metres to pixels: y up in the mechanism, down on the screen.

class Camera {
  constructor() {
    this.x = 0, this.y = 0, this.scale = 1, this.fitted = 1;
    this.width = 1, this.height = 1;
    this.followed = null;  // index of a body
  }
  screen([x, y]) {
    return [this.width / 2 + (x - this.x) * this.scale, this.height / 2 - (y - this.y) * this.scale];
  }
  world([px, py]) {
    return [this.x + (px - this.width / 2) / this.scale, this.y - (py - this.height / 2) / this.scale];
  }
  // The box beside what covers `covered` pixels on the right.
  fit(box, covered = 0) {
    const w = Math.max(box.right - box.left, 1e-9), h = Math.max(box.top - box.bottom, 1e-9);
    this.scale = this.fitted = Math.min((this.width - covered) * 0.86 / w, this.height * 0.8 / h);
    this.x = (box.left + box.right + covered / this.scale) / 2, this.y = (box.bottom + box.top) / 2;
  }
  zoom(factor, at = [this.width / 2, this.height / 2]) {
    const before = this.world(at);
    this.scale = Math.min(Math.max(this.scale * factor, this.fitted * 0.05), this.fitted * 1e5);
    const after = this.world(at);
    this.x += before[0] - after[0], this.y += before[1] - after[1];
  }
  pan(dx, dy) { this.x -= dx / this.scale, this.y += dy / this.scale; }
}

// The box that holds all shapes at some instants of the run.
function boxOf(run) {
  const box = {left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity};
  const hold = ([x, y], r = 0) => {
    box.left = Math.min(box.left, x - r), box.right = Math.max(box.right, x + r);
    box.bottom = Math.min(box.bottom, y - r), box.top = Math.max(box.top, y + r);
  };
  // Of a wall without ends, the place that is nearest to the disc it is for.
  const lines = run.drawing.shapes.filter((s) => s.kind === "line" && s.role === "contact")
    .flatMap((line) => run.drawing.shapes.filter((d) => d.kind === "disc" && d.element === line.element).map((disc) => ({line, disc})));
  const looks = run.moves ? 60 : 1;
  for (let k = 0; k < looks; ++k) {
    const poses = posesAt(run, run.start + (run.end - run.start) * k / Math.max(1, looks - 1));
    run.drawing.bodies.forEach((body, i) => {
      for (let j = 0; j + 1 < body.outline.length; j += 2) hold(pointOf(poses[i], body.outline[j], body.outline[j + 1]));
      if (i > 0) hold([poses[i].x, poses[i].y]);
    });
    for (const {line, disc} of lines) {
      const p = pointOf(poses[line.body], line.points[0], line.points[1]), u = turned(poses[line.body], line.points[2], line.points[3]);
      const c = pointOf(poses[disc.body], disc.points[0], disc.points[1]);
      const along = (c[0] - p[0]) * u[0] + (c[1] - p[1]) * u[1];
      hold([p[0] + along * u[0], p[1] + along * u[1]]);
    }
    for (const s of run.drawing.shapes) {
      if (s.kind === "line" || s.kind === "turn" || s.kind === "arrow" || s.points.length < 2) continue;
      hold(pointOf(poses[s.body], s.points[0], s.points[1]), s.radius || 0);
      if (s.kind === "wall" || s.kind === "curve")
        for (let j = 2; j + 1 < s.points.length; j += 8) hold(pointOf(poses[s.body], s.points[j], s.points[j + 1]));
      if ((s.kind === "rod" || s.kind === "spring") && s.points.length >= 4) hold(pointOf(poses[s.other], s.points[2], s.points[3]));
    }
  }
  if (!(box.left < Infinity)) return {left: -1, right: 1, bottom: -1, top: 1};
  const size = Math.max(box.right - box.left, box.top - box.bottom, 1e-9);
  if (box.right - box.left < 0.1 * size) box.left -= 0.05 * size, box.right += 0.05 * size;
  return box;
}

// A canvas as large as its element, in device pixels; returns its context, in CSS pixels.
function contextOf(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return {context, width, height};
}
