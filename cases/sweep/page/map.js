// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What two pictures have in common: which axes, and which slice of the others.

class Slices {
  constructor(app, place, onChange) {
    Object.assign(this, {app, place, onChange, fixed: new Map()});
  }
  // A select for each axis that is not among `used`; only a grid has slices.
  build(used) {
    for (const box of this.boxes || []) box.remove();
    this.boxes = [];
    const {sweep} = this.app, rest = sweep.isGrid ? sweep.axes.filter((a) => !used.includes(a) && a.varies) : [];
    for (const axis of [...this.fixed.keys()]) if (!rest.includes(axis)) this.fixed.delete(axis);
    for (const axis of rest) {
      if (!this.fixed.has(axis)) this.fixed.set(axis, axis.distinct[0]);
      const select = make("select");
      for (const v of axis.distinct) select.append(make("option", {value: String(v), textContent: axis.text(v), selected: v === this.fixed.get(axis)}));
      select.addEventListener("change", () => { this.fixed.set(axis, Number(select.value)); this.onChange(); });
      const box = make("label", {}, axis.name + " = ", select);
      this.place.append(box);
      this.boxes.push(box);
    }
  }
  rows() {
    const fixed = [...this.fixed];
    return this.app.rows().filter((row) => fixed.every(([axis, v]) => axis.values[row] === v));
  }
}

function columnSelect(text, columns, chosen, onChange) {
  const select = make("select");
  columns.forEach((c, i) => select.append(make("option", {value: String(i), textContent: c ? c.name : "nothing", selected: c === chosen})));
  select.addEventListener("change", () => onChange(columns[Number(select.value)]));
  return make("label", {}, text + " ", select);
}

// Colour over two parameters: cells of a grid, dots of other points.
class MapPicture {
  constructor(app) {
    this.app = app;
    this.canvas = $("map");
    const axes = app.sweep.axes.filter((a) => a.varies);
    [this.x, this.y] = axes;
    $("map-section").hidden = axes.length < 2;
    $("pair").classList.toggle("two", axes.length >= 2);
    if (axes.length < 2) return;
    this.slices = new Slices(app, $("map-choice"), () => this.draw());
    this.choose(axes);
    this.canvas.addEventListener("click", (e) => app.select(this.nearest(e)));
  }
  choose(axes) {
    $("map-choice").replaceChildren(
      columnSelect("x", axes, this.x, (c) => { if (c === this.y) this.y = this.x; this.x = c; this.choose(axes); this.draw(); }),
      columnSelect("y", axes, this.y, (c) => { if (c === this.x) this.x = this.y; this.y = c; this.choose(axes); this.draw(); }));
    this.slices.build([this.x, this.y]);
  }
  // Borders of cells, half-way between values.
  borders(scale, values) {
    const places = values.map((v) => scale.place(v)), n = places.length;
    const half = n > 1 ? (places[1] - places[0]) / 2 : (scale.to - scale.from) / 2;
    const end = n > 1 ? (places[n - 1] - places[n - 2]) / 2 : half;
    return [places[0] - half, ...places.slice(1).map((p, i) => (p + places[i]) / 2), places[n - 1] + end];
  }
  draw() {
    if (!this.slices) return;
    const {app, x, y} = this, {g, width, height} = prepared(this.canvas);
    const left = leftMargin(g, new Scale(y, 0, 1));
    this.xs = new Scale(x, left, width - 14);
    this.ys = new Scale(y, height - 46, 24);
    const grid = app.sweep.isGrid;
    if (grid) this.makeRoom(x, y);
    drawFrame(g, this.xs, this.ys, x.label, y.label);
    const rows = this.slices.rows();
    if (grid) {
      const bx = this.borders(this.xs, x.distinct), by = this.borders(this.ys, y.distinct);
      for (const row of rows) {
        const i = x.distinct.indexOf(x.values[row]), j = y.distinct.indexOf(y.values[row]);
        g.fillStyle = app.colourOf(row);
        g.fillRect(bx[i], Math.min(by[j], by[j + 1]), bx[i + 1] - bx[i] + 0.5, Math.abs(by[j + 1] - by[j]) + 0.5);
      }
    } else {
      for (const row of rows) {
        g.fillStyle = app.colourOf(row);
        g.beginPath(), g.arc(this.xs.place(x.values[row]), this.ys.place(y.values[row]), rows.length > 2000 ? 2 : 4, 0, 7), g.fill();
      }
    }
    if (app.selected !== null) {
      g.strokeStyle = css("--hot");
      g.lineWidth = 2;
      g.beginPath(), g.arc(this.xs.place(x.values[app.selected]), this.ys.place(y.values[app.selected]), 7, 0, 7), g.stroke();
    }
  }
  // So that the cells at the ends are within the frame.
  makeRoom(x, y) {
    for (const [scale, column] of [[this.xs, x], [this.ys, y]]) {
      if (column.words.length || column.distinct.length < 2) continue;
      const b = this.borders(scale, column.distinct), a = scale.number(b[0]), z = scale.number(b[b.length - 1]);
      scale.low = a, scale.high = z;
    }
  }
  nearest(e) {
    const box = this.canvas.getBoundingClientRect(), px = e.clientX - box.left, py = e.clientY - box.top;
    let best = null, least = Infinity;
    for (const row of this.slices.rows()) {
      const d = Math.hypot(this.xs.place(this.x.values[row]) - px, this.ys.place(this.y.values[row]) - py);
      if (d < least) { least = d; best = row; }
    }
    return best;
  }
}
