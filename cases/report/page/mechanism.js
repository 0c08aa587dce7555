// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The mechanism on a canvas. Sizes of symbols are pixels, sizes of bodies and contacts are true.

const roleColor = {joint: "--ink", spring: "--spring", driver: "--driver", load: "--load", contact: "--ink"};

class Painter {
  constructor(context, camera, run, t) {
    Object.assign(this, {g: context, camera, run, t});
    this.poses = posesAt(run, t);
    this.colors = {};
  }
  color(name) { return this.colors[name] ||= css(name); }
  // A point of a body on the screen.
  at(body, x, y) { return this.camera.screen(pointOf(this.poses[body], x, y)); }
  first(s) { return this.at(s.body, s.points[0], s.points[1]); }
  second(s) { return this.at(s.other, s.points[2], s.points[3]); }
  direction(body, x, y) { const [u, v] = turned(this.poses[body], x, y); return [u, -v]; }

  path(points, closed) {
    this.g.beginPath();
    points.forEach(([x, y], i) => (i ? this.g.lineTo(x, y) : this.g.moveTo(x, y)));
    if (closed) this.g.closePath();
  }
  // A colour mixed with the background: opaque, as shapes overlap.
  pale(color) {
    const part = (hex, i) => parseInt(hex.slice(i, i + 2), 16), back = this.color("--panel");
    return `rgb(${[1, 3, 5].map((i) => Math.round(0.3 * part(color, i) + 0.7 * part(back, i))).join(",")})`;
  }
  circle([x, y], r) { this.g.beginPath(); this.g.arc(x, y, Math.max(r, 0), 0, 2 * Math.PI); }
  stroke(color, width = 1.5, dash = []) {
    this.g.strokeStyle = color, this.g.lineWidth = width;
    this.g.setLineDash(dash);
    this.g.stroke();
    this.g.setLineDash([]);
  }
  fill(color) { this.g.fillStyle = color; this.g.fill(); }

  // Short strokes on the right of a line, seen along it: solid ground or material.
  hatch(points, color, spacing = 8, length = 7) {
    this.g.beginPath();
    let left = spacing / 2, drawn = 0;
    for (let i = 0; i + 1 < points.length && drawn < 4000; ++i) {
      const [ax, ay] = points[i], [bx, by] = points[i + 1];
      const size = Math.hypot(bx - ax, by - ay);
      if (!(size > 0)) continue;
      const ux = (bx - ax) / size, uy = (by - ay) / size;
      for (; left < size && drawn < 4000; left += spacing, ++drawn) {
        const x = ax + ux * left, y = ay + uy * left;
        this.g.moveTo(x, y);  // on the screen, y down, the right of u is (-uy, ux)
        this.g.lineTo(x + (-uy - 0.6 * ux) * length, y + (ux - 0.6 * uy) * length);
      }
      left -= size;
    }
    this.stroke(color, 1);
  }

  points(s) {
    const list = [];
    for (let i = 0; i + 1 < s.points.length; i += 2) list.push(this.at(s.body, s.points[i], s.points[i + 1]));
    return list;
  }

  thickness() { return Math.min(Math.max(this.camera.fitted * this.run.size * 0.03, 6), 18) * Math.min(1.6, Math.max(0.6, Math.sqrt(this.camera.scale / this.camera.fitted))); }

  body(index) {
    const body = this.run.drawing.bodies[index], o = body.outline;
    const color = colorOf(index - 1);
    const points = [];
    for (let i = 0; i + 1 < o.length; i += 2) points.push(this.at(index, o[i], o[i + 1]));
    this.g.lineJoin = this.g.lineCap = "round";
    if (points.length === 1) {  // a mass at a joint
      this.circle(points[0], 8);
      this.fill(this.pale(color));
      this.stroke(color);
    } else if (points.length > 1) {
      this.path(points, points.length > 2);
      if (!body.given) {
        // An outline of its own around a hull: stroked twice, wide and then a little less.
        const width = this.widening(index), pale = this.pale(color);
        this.stroke(color, width + 2);
        if (points.length > 2) this.fill(pale);
        if (width > 0) this.stroke(pale, width);
      } else {
        this.fill(this.pale(color));
        this.stroke(color, 1.5);
      }
    } else if (!this.run.drawing.shapes.some((s) => s.body === index && (s.kind === "disc" || s.kind === "gear" || s.kind === "wall"))) {
      this.circle(this.at(index, 0, 0), Math.max(7, Math.min(body.gyration * this.camera.scale, 60)));
      this.fill(this.pale(color));
      this.stroke(color);
    }
  }

  // By how much [pixels] a hull is drawn wider than its points: a block whose corners touch flat walls is
  // as wide as these are round.
  widening(index) {
    const {bodies, shapes} = this.run.drawing, o = bodies[index].outline;
    const flat = (s) => shapes.some((l) => l.kind === "line" && l.element === s.element);
    const corners = shapes.filter((s) => s.kind === "disc" && s.body === index && flat(s));
    let radius = Infinity;
    for (let i = 0; i + 1 < o.length; i += 2) {
      const corner = corners.find((s) => Math.hypot(s.points[0] - o[i], s.points[1] - o[i + 1]) < 1e-6 * this.run.size);
      if (!corner) return this.thickness();
      radius = Math.min(radius, corner.radius || 0);
    }
    return 2 * radius * this.camera.scale;
  }

  center(index) {
    const [x, y] = this.at(index, 0, 0);
    this.g.beginPath();
    this.g.moveTo(x - 4, y), this.g.lineTo(x + 4, y), this.g.moveTo(x, y - 4), this.g.lineTo(x, y + 4);
    this.stroke(colorOf(index - 1), 1);
  }

  pin(s) {
    const [x, y] = this.first(s);
    if (s.body === 0 || s.other === 0) this.foot([x, y]);
    this.circle([x, y], 4.5);
    this.fill(this.color("--back"));
    this.stroke(this.color("--ink"), 1.6);
  }
  // The triangle and hatching of a bearing of the ground.
  foot([x, y]) {
    this.path([[x, y], [x - 9, y + 15], [x + 9, y + 15]], true);
    this.fill(this.color("--panel"));
    this.stroke(this.color("--ink"), 1.3);
    this.hatch([[x + 14, y + 15], [x - 14, y + 15]].reverse(), this.color("--ink"), 6, 5);
    this.path([[x - 14, y + 15], [x + 14, y + 15]]);
    this.stroke(this.color("--ink"), 1.3);
  }

  weld(s) {
    const [x, y] = this.first(s);
    this.g.beginPath();
    this.g.rect(x - 5, y - 5, 10, 10);
    this.fill(this.color("--ink"));
    if (s.body === 0 || s.other === 0) this.hatch([[x - 12, y + 5], [x + 12, y + 5]], this.color("--ink"), 6, 5);
  }

  line(s) {
    const wall = s.role === "contact", color = s.body === 0 ? this.color("--ink") : colorOf(s.body - 1);
    const [px, py] = this.first(s), [ux, uy] = this.direction(s.body, s.points[2], s.points[3]);
    const middle = (this.camera.width / 2 - px) * ux + (this.camera.height / 2 - py) * uy;
    const half = this.camera.width + this.camera.height;
    const ends = [middle - half, middle + half].map((k) => [px + k * ux, py + k * uy]);
    this.path(ends);
    this.stroke(wall ? color : this.color("--soft"), wall ? 1.6 : 1, wall ? [] : [10, 4, 2, 4]);
    if (wall) this.hatch(ends, s.body === 0 ? this.color("--soft") : color, 9, 7);
  }

  block(s) {
    const [x, y] = this.first(s), [ux, uy] = this.direction(s.body, s.points[2], s.points[3]);
    // Smaller than the roller it carries, so that both are seen.
    const roller = this.run.drawing.shapes.find((d) => d.kind === "disc" && d.body === s.body && d.radius > 0 &&
      Math.hypot(d.points[0] - s.points[0], d.points[1] - s.points[1]) < d.radius);
    const a = roller ? Math.min(13, Math.max(5, 0.5 * roller.radius * this.camera.scale)) : 13, b = a * 8 / 13;
    const corner = (i, j) => [x + i * a * ux - j * b * uy, y + i * a * uy + j * b * ux];
    this.path([corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)], true);
    this.fill(this.color("--back"));
    this.stroke(s.body === 0 ? this.color("--ink") : colorOf(s.body - 1), 1.6);
  }

  point(s) {
    this.circle(this.first(s), 4);
    this.fill(this.color("--back"));
    this.stroke(this.color("--ink"), 1.5);
  }

  curve(s) {
    this.path(this.points(s), s.closed);
    this.stroke(this.color("--ink"), 1.4, [7, 3]);
  }

  rod(s) {
    if (s.body === 0) this.foot(this.first(s));
    if (s.other === 0) this.foot(this.second(s));
    this.path([this.first(s), this.second(s)]);
    this.stroke(this.color("--ink"), 3);
    for (const p of [this.first(s), this.second(s)]) this.circle(p, 3.5), this.fill(this.color("--back")), this.stroke(this.color("--ink"));
  }

  spring(s) {
    const [ax, ay] = this.first(s), [bx, by] = this.second(s);
    const size = Math.hypot(bx - ax, by - ay) || 1, ux = (bx - ax) / size, uy = (by - ay) / size;
    const coils = 9, points = [[ax, ay]];
    for (let i = 0; i <= 2 * coils; ++i) {
      const k = size * (0.12 + 0.76 * i / (2 * coils)), w = i === 0 || i === 2 * coils ? 0 : i % 2 ? 7 : -7;
      points.push([ax + k * ux - w * uy, ay + k * uy + w * ux]);
    }
    points.push([bx, by]);
    this.path(points);
    this.stroke(this.color("--spring"), 1.6);
    for (const end of [[ax, ay], [bx, by]]) this.circle(end, 2.5), this.fill(this.color("--spring"));
    // Held by the ground: a wall across its end, the material behind it.
    const across = ([x, y], k) => {
      const ends = [[x - 10 * uy * k, y + 10 * ux * k], [x + 10 * uy * k, y - 10 * ux * k]];
      this.path(ends);
      this.stroke(this.color("--ink"), 1.3);
      this.hatch(ends, this.color("--ink"), 5, 5);
    };
    if (s.body === 0) across([ax, ay], -1);
    if (s.other === 0) across([bx, by], 1);
  }

  disc(s) {
    const radius = (s.radius || 0) * this.camera.scale, center = this.first(s);
    const color = s.body === 0 ? this.color("--steel") : colorOf(s.body - 1);
    if (!(radius > 2)) { this.circle(center, 2.5); this.fill(color); return; }
    this.circle(center, radius);
    this.fill(this.color("--back"));
    this.g.globalAlpha = 0.45;
    this.fill(color);
    this.g.globalAlpha = 1;
    this.stroke(color, 1.4);
    const [ux, uy] = this.direction(s.body, 1, 0);
    this.path([center, [center[0] + radius * ux, center[1] + radius * uy]]);
    this.stroke(color, 1);
  }

  wall(s) {
    const points = this.points(s);
    let area = 0;
    if (s.closed)
      for (let i = 0; i < points.length; ++i) {
        const [ax, ay] = points[i], [bx, by] = points[(i + 1) % points.length];
        area += ax * by - bx * ay;
      }
    const inside = s.closed && area > 0;  // material on the right, y down: clockwise in the world
    const color = s.body === 0 ? this.color("--steel") : colorOf(s.body - 1);
    this.path(points, s.closed);
    if (s.closed) this.fill(inside ? this.pale(color) : this.color("--panel"));
    this.stroke(color, 1.8);
    if (!inside) this.hatch(s.closed ? [...points, points[0]] : points, color, 9, 6);
  }

  turn(s) {
    const [x, y] = this.at(s.other, s.points[0], s.points[1]);
    const color = this.color(roleColor[s.role]);
    this.g.beginPath();
    if (s.role === "spring") {
      for (let i = 0; i <= 60; ++i) {
        const a = i / 60 * 5 * Math.PI - this.poses[s.other].angle, r = 5 + 11 * i / 60;
        this.g.lineTo(x + r * Math.cos(a), y + r * Math.sin(a));
      }
      this.stroke(color, 1.4);
      return;
    }
    this.g.arc(x, y, 15, -0.3 * Math.PI, -1.7 * Math.PI, true);
    this.stroke(color, 2);
    const a = -1.7 * Math.PI, tip = [x + 15 * Math.cos(a), y + 15 * Math.sin(a)];
    this.head(tip, [Math.sin(a), -Math.cos(a)], color);
  }
  head([x, y], [ux, uy], color, size = 7) {
    this.path([[x + size * ux, y + size * uy], [x - size * 0.55 * uy, y + size * 0.55 * ux], [x + size * 0.55 * uy, y - size * 0.55 * ux]], true);
    this.fill(color);
  }
  vector([x, y], [dx, dy], color, width = 2.2) {
    const size = Math.hypot(dx, dy);
    if (!(size > 1)) return;
    const ux = dx / size, uy = dy / size, head = Math.min(8, size);
    this.path([[x, y], [x + dx - head * ux, y + dy - head * uy]]);
    this.stroke(color, width);
    this.head([x + dx - head * ux, y + dy - head * uy], [ux, uy], color, head);
  }

  arrow(s) {
    const [ux, uy] = this.direction(s.other, s.points[2], s.points[3]);
    if (ux === 0 && uy === 0) return;  // its direction changes: drawn with the forces
    const [x, y] = this.first(s), color = this.color(roleColor[s.role]);
    this.vector([x - 34 * ux, y - 34 * uy], [24 * ux, 24 * uy], color);
    this.vector([x - 22 * ux, y - 22 * uy], [-24 * ux, -24 * uy], color);
  }

  gear(s) {
    const center = this.first(s), r = s.radius * this.camera.scale;
    const color = s.body === 0 ? this.color("--steel") : colorOf(s.body - 1);
    this.circle(center, r);
    this.stroke(color, 1.5, [6, 3]);
    const pose = this.poses[s.body], teeth = Math.max(12, Math.min(60, Math.round(r / 4)));
    this.g.beginPath();
    for (let i = 0; i < teeth; ++i) {
      const a = -pose.angle + 2 * Math.PI * i / teeth, c = Math.cos(a), d = Math.sin(a);
      this.g.moveTo(center[0] + (r - 4) * c, center[1] + (r - 4) * d);
      this.g.lineTo(center[0] + (r + 4) * c, center[1] + (r + 4) * d);
    }
    this.stroke(color, 1.2);
    const [ux, uy] = this.direction(s.body, 1, 0);
    this.path([center, [center[0] + r * ux, center[1] + r * uy]]);
    this.stroke(color, 1.4);
  }

  belt(s) {
    const a = this.first(s), b = this.at(s.body, s.points[2], s.points[3]), r = s.radius * this.camera.scale;
    const size = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
    const nx = -(b[1] - a[1]) / size * r, ny = (b[0] - a[0]) / size * r;
    for (const k of [1, -1]) {
      this.path([[a[0] + k * nx, a[1] + k * ny], [b[0] + k * nx, b[1] + k * ny]]);
      this.stroke(this.color("--soft"), 2);
    }
  }
}

// From the ground up: what covers what.
const layers = [["line", "belt"], ["curve", "gear", "rod", "spring"], ["disc"], ["block", "weld", "pin", "point"], ["turn", "arrow"]];

// [m] Of what is drawn of a body, the larger side; rounded, so that equal bodies stay in their order.
function extentOf({outline}) {
  const side = (k) => { const x = outline.filter((_, i) => i % 2 === k); return x.length ? Math.max(...x) - Math.min(...x) : 0; };
  return Number(Math.hypot(side(0), side(1)).toPrecision(3));
}

function drawMechanism(painter, view) {
  const {run} = painter, shapes = run.drawing.shapes;
  const ground = (s) => s.body === 0 && s.kind === "wall";
  for (const s of shapes) if (layers[0].includes(s.kind) || ground(s)) painter[s.kind](s);
  // Bodies with slots below those whose pins are in them, large ones below small ones.
  const carries = (i) => shapes.some((s) => s.kind === "wall" && s.body === i);
  run.order ||= run.drawing.bodies.map((_, i) => i).slice(1).sort((a, b) =>
    carries(b) - carries(a) || extentOf(run.drawing.bodies[b]) - extentOf(run.drawing.bodies[a]));
  for (const i of run.order) {
    painter.body(i);
    for (const s of shapes) if (s.kind === "wall" && s.body === i) painter.wall(s);
  }
  for (const layer of layers.slice(1))
    for (const s of shapes) if (layer.includes(s.kind)) painter[s.kind](s);
  for (let i = 1; i < run.drawing.bodies.length; ++i) painter.center(i);
  for (const trace of view.traces) drawTrace(painter, trace);
  drawForces(painter, view);
  if (view.names) painter.run.boxesOfNames = drawNames(painter);
}

// {body, x, y} over the whole run, the part behind it stronger.
function drawTrace(painter, trace) {
  const {run, camera} = painter;
  if (!trace.path) {
    trace.path = new Float64Array(2 * run.t.length);
    for (let i = 0; i < run.t.length; ++i) trace.path.set(pointOf(posesAt(run, run.t[i])[trace.body], trace.x, trace.y), 2 * i);
  }
  const now = rowAt(run, painter.t);
  for (const [from, to, alpha] of [[0, run.t.length - 1, 0.3], [0, now, 1]]) {
    painter.g.beginPath();
    let px = NaN, py = NaN;
    for (let i = from; i <= to; ++i) {
      const [x, y] = camera.screen([trace.path[2 * i], trace.path[2 * i + 1]]);
      if (Math.abs(x - px) + Math.abs(y - py) < 0.7) continue;
      painter.g.lineTo(x, y);
      px = x, py = y;
    }
    painter.g.globalAlpha = alpha;
    painter.stroke(painter.color("--accent"), 1.3);
    painter.g.globalAlpha = 1;
  }
}

// Contact points and forces: on the disc, against the normal; reactions of joints; loads.
function drawForces(painter, view) {
  const {run, t, poses, camera} = painter;
  const length = 90 * 10 ** view.arrowSize;
  const largest = (columns) => Math.max(...columns.map((c) => (c ? c.largest : 0)), 0);
  const contacts = run.elements.contacts;
  const reference = largest(contacts.map((e) => run.column(`${e}.normal_force`)));
  for (const element of contacts) {
    const contact = contactAt(run, element, t, poses);
    if (!contact || !(contact.force > 0)) continue;
    const point = camera.screen(contact.point), scale = length / (reference || 1);
    const [nx, ny] = contact.normal;
    painter.circle(point, 3.5);
    painter.fill(painter.color("--hot"));
    if (view.arrows !== "none")
      painter.vector(point, [scale * (contact.friction * ny - contact.force * nx), scale * (contact.force * ny + contact.friction * nx)],
                     painter.color("--hot"));
  }
  const arrows = (elements, color) => {
    const pairs = elements.map((e) => [e, run.column(`${e}.fx`), run.column(`${e}.fy`)]).filter((p) => p[1] && p[2]);
    const most = largest(pairs.flatMap((p) => [p[1], p[2]]));
    for (const [element, fx, fy] of pairs) {
      const s = run.drawing.shapes.find((shape) => shape.element === element && ["pin", "weld", "rod", "block", "point", "arrow"].includes(shape.kind));
      if (!s || !(most > 0)) continue;
      const k = length / most;
      painter.vector(painter.first(s), [between(run, fx, t) * k, -between(run, fy, t) * k], painter.color(color));
    }
  };
  if (view.arrows === "all") arrows(run.elements.joints.concat(run.elements.drivers), "--accent");
  if (view.arrows !== "none") arrows(run.drawing.shapes.filter((s) => s.role === "load").map((s) => s.element), "--load");
}

// Names beside what they belong to, none over another and none beyond the picture: bodies above, elements
// below, where there is room. A name stays where it was as long as it can.
function drawNames(painter) {
  const {g, run, camera} = painter, lineHeight = 15;
  const placed = run.placesOfNames ||= new Map(), taken = [];
  g.font = "12px system-ui, sans-serif";
  g.lineWidth = 3;
  const write = (key, text, [x, y], color, down) => {
    if (!(x >= 0 && x <= camera.width && y >= 0 && y <= camera.height)) return;
    const width = g.measureText(text).width;
    // [from, to, above, below] of the k-th place: right, left; a line further; the other way.
    const place = (k) => {
      const left = k % 2 ? x - 7 - width : x + 7, line = Math.floor(k / 2) % 5, way = k >= 10 ? -down : down;
      const base = y + (way > 0 ? 17 : -7) + way * line * lineHeight;
      return [left, left + width, base - 11, base + 4];
    };
    const free = ([a, b, c, d]) => a >= 2 && b <= camera.width - 2 && c >= 2 && d <= camera.height - 2 &&
      !taken.some((t) => a < t[1] && b > t[0] && c < t[3] && d > t[2]);
    const before = placed.get(key) || 0;
    const k = free(place(before)) ? before : Array.from({length: 20}, (_, i) => i).find((i) => free(place(i)));
    const box = place(k ?? 0);
    if (k === undefined) {  // no room: at least within the picture
      const shift = Math.min(0, camera.width - 2 - box[1]) + Math.max(0, 2 - box[0]);
      box[0] += shift, box[1] += shift;
    }
    placed.set(key, k ?? 0);
    taken.push(box);
    g.strokeStyle = painter.color("--panel");
    g.strokeText(text, box[0], box[3] - 4);
    g.fillStyle = color;
    g.fillText(text, box[0], box[3] - 4);
  };
  run.drawing.bodies.forEach((b, i) => { if (i > 0) write(`body ${b.name}`, b.name, painter.at(i, 0, 0), colorOf(i - 1), -1); });
  const seen = new Set();
  for (const s of run.drawing.shapes) {
    if (seen.has(s.element) || !["pin", "weld", "rod", "spring", "block", "point", "disc"].includes(s.kind)) continue;
    seen.add(s.element);
    write(`element ${s.element}`, s.element, painter.first(s), painter.color("--soft"), 1);
  }
  return taken;
}
