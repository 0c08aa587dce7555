// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Plots of one quantity over another: hysteresis, orbits, phase planes, pictures of a case. A mark
// shows where the animation is.

class XyPlot {
  // `specOf` makes what is drawn when the plot is first seen: {title, x, y, equal, lines: [{name, color,
  // xy: Float64Array, dots, closed, soft}], mark: (t) => [x, y] or null}, or null if the run has none of it.
  constructor(app, title, specOf) {
    Object.assign(this, {app, title, specOf});
    this.spec = null;
    this.hidden = new Set();
    this.box = make("div", {className: "plot xy"});
    this.canvas = make("canvas");
    this.canvas.setAttribute("aria-label", title);
    this.legend = make("div", {className: "legend"});
    this.tools = make("div");
    this.heading = make("h3", {textContent: title});
    this.box.append(this.heading, this.tools, this.canvas, this.legend);
    this.range = null;  // [left, right, bottom, top] after zooming
    this.listen();
  }
  refresh() {
    this.spec = this.specOf() || this.spec;
    if (!this.spec) return;
    this.range = null;
    this.heading.textContent = this.spec.title;
    this.fillLegend();
    this.draw();
  }

  fillLegend() {
    this.legend.replaceChildren();
    for (const line of this.spec.lines) {
      if (!line.name) continue;
      const swatch = make("span", {className: "swatch"});
      swatch.style.background = line.color;
      const button = make("button", {type: "button"}, swatch, line.name);
      button.setAttribute("aria-pressed", !this.hidden.has(line.name));
      button.addEventListener("click", () => {
        if (!this.hidden.delete(line.name)) this.hidden.add(line.name);
        this.fillLegend();
        this.draw();
      });
      this.legend.append(button);
    }
  }

  bounds() {
    if (this.range) return this.range;
    let [left, right, bottom, top] = [Infinity, -Infinity, Infinity, -Infinity];
    for (const line of this.spec.lines) {
      if (this.hidden.has(line.name)) continue;
      for (let i = 0; i + 1 < line.xy.length; i += 2) {
        const x = line.xy[i], y = line.xy[i + 1];
        if (!(Number.isFinite(x) && Number.isFinite(y))) continue;
        if (x < left) left = x;
        if (x > right) right = x;
        if (y < bottom) bottom = y;
        if (y > top) top = y;
      }
    }
    if (!(left <= right)) return [-1, 1, -1, 1];
    const dx = (right - left || Math.abs(right) || 1) * 0.05, dy = (top - bottom || Math.abs(top) || 1) * 0.05;
    return [left - dx, right + dx, bottom - dy, top + dy];
  }

  draw() {
    if (!this.spec || !this.canvas.clientWidth) return;
    const {context: g, width, height} = contextOf(this.canvas);
    const frame = {left: 62, right: width - 10, top: 10, bottom: height - 40};
    let [x0, x1, y0, y1] = this.bounds();
    if (this.spec.equal) {  // the same length on both axes
      const k = Math.max((x1 - x0) / (frame.right - frame.left), (y1 - y0) / (frame.bottom - frame.top));
      const cx = (x0 + x1) / 2, cy = (y0 + y1) / 2;
      x0 = cx - k * (frame.right - frame.left) / 2, x1 = cx + k * (frame.right - frame.left) / 2;
      y0 = cy - k * (frame.bottom - frame.top) / 2, y1 = cy + k * (frame.bottom - frame.top) / 2;
    }
    this.map = {x0, x1, y0, y1, frame};
    const px = (x) => frame.left + (x - x0) / (x1 - x0) * (frame.right - frame.left);
    const py = (y) => frame.bottom - (y - y0) / (y1 - y0) * (frame.bottom - frame.top);
    this.axes(g, px, py, width, height);
    g.save();
    g.beginPath();
    g.rect(frame.left, frame.top, frame.right - frame.left, frame.bottom - frame.top);
    g.clip();
    for (const line of this.spec.lines) {
      if (this.hidden.has(line.name)) continue;
      g.beginPath();
      let open = false;
      for (let i = 0; i + 1 < line.xy.length; i += 2) {
        const x = px(line.xy[i]), y = py(line.xy[i + 1]);
        if (!(Number.isFinite(x) && Number.isFinite(y))) { open = false; continue; }
        if (line.dots) { g.moveTo(x + 1.8, y); g.arc(x, y, 1.8, 0, 2 * Math.PI); } else if (open) g.lineTo(x, y); else g.moveTo(x, y);
        open = true;
      }
      if (line.closed) g.closePath();
      g.strokeStyle = g.fillStyle = line.color;
      g.lineWidth = line.soft ? 1 : 1.3;
      if (line.dots) g.fill(); else g.stroke();
    }
    const mark = this.spec.mark && this.spec.mark(this.app.time);
    if (mark) {
      g.beginPath();
      g.arc(px(mark[0]), py(mark[1]), 4.5, 0, 2 * Math.PI);
      g.fillStyle = css("--hot");
      g.fill();
    }
    if (this.drag) {
      g.fillStyle = css("--accent");
      g.globalAlpha = 0.2;
      g.fillRect(...this.drag.slice(0, 2), this.drag[2] - this.drag[0], this.drag[3] - this.drag[1]);
    }
    g.restore();
  }

  axes(g, px, py, width, height) {
    const {x0, x1, y0, y1, frame} = this.map;
    const ticks = (a, b, most) => {
      const raw = (b - a) / most, size = 10 ** Math.floor(Math.log10(raw));
      const step = [1, 2, 5, 10].map((k) => k * size).find((s) => s >= raw) || size * 10;
      const list = [];
      for (let k = Math.ceil(a / step); k * step <= b && list.length < 50; ++k) list.push(k * step);
      return list;
    };
    g.font = "12px system-ui, sans-serif";
    g.strokeStyle = css("--grid");
    g.fillStyle = css("--soft");
    g.lineWidth = 1;
    g.textAlign = "center";
    for (const x of ticks(x0, x1, Math.max(2, width / 90))) {
      g.beginPath(), g.moveTo(px(x), frame.top), g.lineTo(px(x), frame.bottom), g.stroke();
      g.fillText(short(x, 4), px(x), frame.bottom + 15);
    }
    g.textAlign = "right";
    for (const y of ticks(y0, y1, 6)) {
      g.beginPath(), g.moveTo(frame.left, py(y)), g.lineTo(frame.right, py(y)), g.stroke();
      g.fillText(short(y, 4), frame.left - 5, py(y) + 4);
    }
    g.textAlign = "center";
    g.fillText(this.spec.x, (frame.left + frame.right) / 2, height - 7);
    g.save();
    g.translate(12, (frame.top + frame.bottom) / 2);
    g.rotate(-Math.PI / 2);
    g.fillText(this.spec.y, 0, 0);
    g.restore();
  }

  listen() {
    const at = (e) => { const r = this.canvas.getBoundingClientRect(); return [e.clientX - r.left, e.clientY - r.top]; };
    this.canvas.addEventListener("pointerdown", (e) => {
      if (!this.map) return;  // not drawn yet
      this.canvas.setPointerCapture(e.pointerId);
      const [x, y] = at(e);
      this.drag = [x, y, x, y];
    });
    this.canvas.addEventListener("pointermove", (e) => {
      if (!this.drag) return;
      [this.drag[2], this.drag[3]] = at(e);
      this.draw();
    });
    this.canvas.addEventListener("pointerup", () => {
      const d = this.drag;
      this.drag = null;
      if (d && Math.abs(d[2] - d[0]) > 6 && Math.abs(d[3] - d[1]) > 6) {
        const {x0, x1, y0, y1, frame} = this.map;
        const x = (p) => x0 + (p - frame.left) / (frame.right - frame.left) * (x1 - x0);
        const y = (p) => y0 + (frame.bottom - p) / (frame.bottom - frame.top) * (y1 - y0);
        this.range = [x(Math.min(d[0], d[2])), x(Math.max(d[0], d[2])), y(Math.max(d[1], d[3])), y(Math.min(d[1], d[3]))];
      }
      this.draw();
    });
    this.canvas.addEventListener("dblclick", () => { this.range = null; this.draw(); });
  }
}

const interleave = (n, pair) => {
  const xy = new Float64Array(2 * n);
  for (let i = 0; i < n; ++i) xy.set(pair(i), 2 * i);
  return xy;
};

// Only what the time axes show, once they are zoomed.
const within = (app, t) => !app.range || (t >= app.range[0] && t <= app.range[1]);

const hysteresisTitle = (element) => `${element}: force over penetration`;

// Force over penetration of a contact, of all runs in the plots.
function hysteresisOf(app, element) {
  const runs = app.plotted().filter((r) => r.column(`${element}.normal_force`));
  const force = (r) => r.column(`${element}.normal_force`), depth = (r) => r.column(`${element}.penetration`);
  const deepest = Math.max(...runs.map((r) => depth(r).values.reduce((a, b) => Math.max(a, b), 0)), 0);
  const f = scaleFor(Math.max(...runs.map((r) => force(r).largest), 0), "N"), d = scaleFor(deepest, "m");
  return {
    title: hysteresisTitle(element), x: `penetration [${d.unit}]`, y: `force [${f.unit}]`,
    lines: runs.map((r) => ({
      name: r.label, color: colorOf(runs.length > 1 ? r.index : 0),
      xy: interleave(r.t.length, (i) => force(r).values[i] > 0 && within(app, r.t[i]) ? [depth(r).values[i] * d.factor, force(r).values[i] * f.factor] : [NaN, NaN]),
    })),
    mark: (t) => {
      const F = between(app.run, force(app.run), t);
      return F > 0 ? [between(app.run, depth(app.run), t) * d.factor, F * f.factor] : null;
    },
  };
}

const discOf = (run, element) => run.drawing.shapes.find((s) => s.kind === "disc" && s.element === element);
const wallOf = (run, element) => run.drawing.shapes.find((s) => (s.kind === "wall" || s.kind === "line") && s.element === element);
const hasOrbit = (run, element) => Boolean(discOf(run, element) && wallOf(run, element));

function orbitTitle(run, element) {
  const bore = boreOf(wallOf(run, element), discOf(run, element));
  return bore ? `${element}: orbit in the clearance` : `${element}: path in its counterpart`;
}

// Where the centre of a disc goes in the body it touches: within its clearance, if that is a bore.
function orbitOf(app, element) {
  const disc = (r) => discOf(r, element), wall = (r) => wallOf(r, element);
  const runs = app.plotted().filter((r) => hasOrbit(r, element));
  if (!hasOrbit(app.run, element)) return null;
  const place = (r, t) => {
    const poses = posesAt(r, t), d = disc(r), b = poses[wall(r).body];
    const [x, y] = pointOf(poses[d.body], d.points[0], d.points[1]);
    return [b.c * (x - b.x) + b.s * (y - b.y), -b.s * (x - b.x) + b.c * (y - b.y)];
  };
  const bore = boreOf(wall(app.run), disc(app.run));
  const origin = bore ? bore.center : [0, 0];
  const paths = runs.map((r) => interleave(r.t.length, (i) => within(app, r.t[i]) ? place(r, r.t[i]).map((v, k) => v - origin[k]) : [NaN, NaN]));
  const most = Math.max(...paths.map((p) => p.reduce((a, b) => (Math.abs(b) > a ? Math.abs(b) : a), 0)));
  const {factor, unit} = scaleFor(most, "m");
  const lines = paths.map((p, i) => ({name: runs[i].label, color: colorOf(runs.length > 1 ? runs[i].index : 0), xy: p.map((v) => v * factor)}));
  if (bore)
    lines.unshift({name: "clearance", color: css("--soft"), soft: true, xy: interleave(181, (i) => [bore.gap * factor * Math.cos(i * Math.PI / 90), bore.gap * factor * Math.sin(i * Math.PI / 90)])});
  return {
    title: orbitTitle(app.run, element),
    x: `x [${unit}]`, y: `y [${unit}]`, equal: true, lines,
    mark: (t) => place(app.run, t).map((v, k) => (v - origin[k]) * factor),
  };
}

// A closed round wall about a disc that is a little smaller.
function boreOf(wall, disc) {
  if (!wall.closed || !(disc.radius > 0)) return null;
  const n = wall.points.length / 2 - 1;  // the last point is the first
  let x = 0, y = 0;
  for (let i = 0; i < n; ++i) x += wall.points[2 * i] / n, y += wall.points[2 * i + 1] / n;
  const radii = Array.from({length: n}, (_, i) => Math.hypot(wall.points[2 * i] - x, wall.points[2 * i + 1] - y));
  const least = Math.min(...radii), most = Math.max(...radii);
  return most - least < 1e-3 * most && least > disc.radius && disc.radius > 0.5 * least ? {center: [x, y], gap: most - disc.radius} : null;
}

// Coordinates that have both a value and a rate.
function phaseChoices(run) {
  const choices = [];
  for (const [q, v] of [["x", "vx"], ["y", "vy"], ["angle", "omega"]])
    for (const body of run.drawing.bodies.slice(1)) {
      const a = run.column(`${body.name}.${q}`), b = run.column(`${body.name}.${v}`);
      if (a && b && !a.constant && !b.constant) choices.push([`${body.name}.${q}`, `${body.name}.${v}`]);
    }
  return choices;
}

const phaseTitle = "Phase plane";

function phaseOf(app, [q, v]) {
  const runs = app.plotted().filter((r) => r.column(q) && r.column(v));
  const x = scaleFor(Math.max(...runs.map((r) => r.column(q).largest), 0), app.run.column(q).unit);
  const y = scaleFor(Math.max(...runs.map((r) => r.column(v).largest), 0), app.run.column(v).unit);
  return {
    title: phaseTitle, x: `${q} [${x.unit}]`, y: `${v} [${y.unit}]`,
    lines: runs.map((r) => ({
      name: r.label, color: colorOf(runs.length > 1 ? r.index : 0),
      xy: interleave(r.t.length, (i) => within(app, r.t[i]) ? [r.column(q).values[i] * x.factor, r.column(v).values[i] * y.factor] : [NaN, NaN]),
    })),
    mark: (t) => [between(app.run, app.run.column(q), t) * x.factor, between(app.run, app.run.column(v), t) * y.factor],
  };
}

// A picture of the case, under a title that names its run where there are several.
function portraitOf(portrait, title) {
  return {
    title, x: portrait.x, y: portrait.y, equal: portrait.equal,
    lines: portrait.lines.map((line, i) => ({name: line.name, color: colorOf(i), dots: line.dots, xy: Float64Array.from(line.points)})),
  };
}
