// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A lens on a clearance. Disc and walls keep their true shapes; only the gap between them is magnified:
// the disc is moved along the normal until it is so many times further from the wall, or deeper in it,
// and where there is a wall on its other side it is drawn smaller by as much as the clearance grows.
// When it would become too small, the lens zooms in for the rest of the magnification.

// Distance [m] from the point c along the unit vector u to the nearest piece of the walls, which are
// lists of world points; far away: infinite.
function rayToWalls(walls, c, u, reach) {
  let best = Infinity;
  for (const wall of walls)
    for (let i = 0; i + 1 < wall.length; ++i) {
      const ax = wall[i][0] - c[0], ay = wall[i][1] - c[1];
      const dx = wall[i + 1][0] - wall[i][0], dy = wall[i + 1][1] - wall[i][1];
      const det = u[0] * dy - u[1] * dx;
      if (det === 0) continue;
      const k = (ax * dy - ay * dx) / det, s = (ax * u[1] - ay * u[0]) / det;
      if (k > 0 && k < best && s >= -1e-9 && s <= 1 + 1e-9) best = k;
    }
  return best <= reach ? best : Infinity;
}

// The walls that a disc may touch, near it, in the world.
function wallsNear(run, disc, poses, center, reach) {
  const walls = [];
  for (const s of run.drawing.shapes) {
    const wall = s.kind === "wall" || (s.kind === "line" && s.role === "contact");
    const same = run.drawing.shapes.some((d) => d.kind === "disc" && d.element === s.element && d.body === disc.body &&
      d.points[0] === disc.points[0] && d.points[1] === disc.points[1]);
    if (!wall || !same) continue;
    const pose = poses[s.body], points = [];
    if (s.kind === "line") {
      const p = pointOf(pose, s.points[0], s.points[1]), u = turned(pose, s.points[2], s.points[3]);
      const middle = (center[0] - p[0]) * u[0] + (center[1] - p[1]) * u[1];
      for (const k of [-1, 1]) points.push([p[0] + (middle + 3 * k * reach) * u[0], p[1] + (middle + 3 * k * reach) * u[1]]);
    } else {
      for (let i = 0; i + 1 < s.points.length; i += 2) points.push(pointOf(pose, s.points[i], s.points[i + 1]));
      if (s.closed) points.push(points[0]);
    }
    // Only the pieces within reach.
    let piece = [];
    for (let i = 0; i + 1 < points.length; ++i) {
      const [a, b] = [points[i], points[i + 1]], size = Math.hypot(b[0] - a[0], b[1] - a[1]);
      const near = Math.hypot((a[0] + b[0]) / 2 - center[0], (a[1] + b[1]) / 2 - center[1]) <= reach + size / 2;
      if (near) { if (!piece.length) piece.push(a); piece.push(b); }
      if (!near && piece.length) walls.push(piece), piece = [];
    }
    if (piece.length) walls.push(piece);
  }
  return walls;
}

const smallestDisc = 0.3;  // of its radius

// What the lens needs of a contact at a time, or null.
function lensAt(run, element, t) {
  const poses = posesAt(run, t), contact = contactAt(run, element, t, poses);
  const disc = run.drawing.shapes.find((s) => s.kind === "disc" && s.element === element);
  if (!contact || !disc) return null;
  const {center, normal, radius, depth} = contact, size = radius || run.size * 0.05;
  const walls = wallsNear(run, disc, poses, center, 6 * size);
  const near = rayToWalls(walls, center, normal, 6 * size);
  const far = rayToWalls(walls, center, [-normal[0], -normal[1]], 6 * size);
  const half = (radius - depth + far) / 2 - radius;  // clearance to each side, in the middle
  return {contact, disc, walls, size, near: Number.isFinite(near) ? near : radius - depth,
    clearance: radius > 0 && half > 0 && half < 0.5 * radius ? half : 0};
}

// How far the disc alone can show the magnification.
const mostByDisc = (look) => (look.clearance > 0 ? 1 + (1 - smallestDisc) * look.contact.radius / look.clearance : 1000);

// So that the clearance, or the deepest penetration of a disc at one wall alone, is easily seen; of a disc
// that never touches, the gap now.
function fittingMagnification(run, element, t) {
  const look = lensAt(run, element, t);
  if (!look) return 100;
  let deepest = 0;
  for (const d of run.column(`${element}.penetration`).values) if (d > deepest) deepest = d;
  const wanted = look.clearance > 0 ? 0.6 * mostByDisc(look) : deepest > 0 ? 0.3 * look.size / deepest
    : Math.min(100, look.size / Math.max(-look.contact.depth, 1e-12));
  return Math.min(1000, Math.max(1, wanted));
}

function drawLens(canvas, run, element, t, magnification, text) {
  const {context: g, width, height} = contextOf(canvas);
  const look = lensAt(run, element, t);
  if (!look) return;
  const {contact, disc, walls, size, near, clearance} = look, {center, normal, depth, radius} = contact;
  const factor = Math.min(magnification, mostByDisc(look)), zoom = magnification / factor;
  const drawn = radius - (factor - 1) * clearance;
  const wall = [center[0] + near * normal[0], center[1] + near * normal[1]];
  const distance = drawn - depth * factor;  // of the disc's centre from the wall
  const middle = [wall[0] - distance * normal[0], wall[1] - distance * normal[1]];
  // The whole disc in the middle; when zoomed, the place where it touches.
  const scale = Math.min(width, height) * 0.3 / size * zoom;
  const looked = zoom > 1.001 ? wall : center;
  const px = ([x, y]) => [width / 2 + (x - looked[0]) * scale, height / 2 - (y - looked[1]) * scale];
  const disk = () => { g.beginPath(); g.arc(...px(middle), Math.max(drawn * scale, 3), 0, 2 * Math.PI); };

  g.fillStyle = css("--gap");
  g.fillRect(0, 0, width, height);
  disk();
  g.fillStyle = disc.body === 0 ? css("--steel") : colorOf(disc.body - 1);
  g.globalAlpha = 0.55;
  g.fill();
  g.globalAlpha = 1;
  // Material: a band on the right of each wall, and in it, in colour, what the disc has of it.
  const bands = walls.map((points) => {
    const path = points.map(px), deep = Math.max(width, height) * 0.5, band = [...path];
    for (let i = path.length - 1; i >= 0; --i) {
      const [ax, ay] = path[Math.max(0, i - 1)], [bx, by] = path[Math.min(path.length - 1, i + 1)];
      const size = Math.hypot(bx - ax, by - ay) || 1;
      band.push([path[i][0] - (by - ay) / size * deep, path[i][1] + (bx - ax) / size * deep]);
    }
    return {path, band};
  });
  const trace = (points) => { g.beginPath(); points.forEach(([x, y], i) => (i ? g.lineTo(x, y) : g.moveTo(x, y))); };
  for (const {path, band} of bands) {
    trace(band);
    g.fillStyle = css("--line");
    g.globalAlpha = 0.9;
    g.fill();
    g.globalAlpha = 1;
    g.strokeStyle = css("--line");  // closes the seam of a wall that goes around
    g.stroke();
    if (depth > 0) {
      g.save();
      trace(band);
      g.clip();
      disk();
      g.fillStyle = css("--hot");
      g.fill();
      g.restore();
    }
    trace(path);
    g.strokeStyle = css("--ink");
    g.lineWidth = 1.5;
    g.stroke();
  }
  disk();
  g.strokeStyle = disc.body === 0 ? css("--steel") : colorOf(disc.body - 1);
  g.stroke();
  const state = depth > 0 ? `penetration ${quantity(depth, "m")}` : `gap ${quantity(-depth, "m")}`;
  text.textContent = `${element}: ${state}\nforce ${quantity(contact.force || 0, "N")}, gap \u00d7 ${short(magnification, 3)}`;
}
