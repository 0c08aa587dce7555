// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A quantity over one parameter, a curve for each value of another.

class Curves {
  constructor(app) {
    this.app = app;
    this.canvas = $("curves");
    const axes = app.sweep.axes.filter((a) => a.varies);
    this.axes = axes.length ? axes : app.sweep.axes;
    this.x = this.axes.find((a) => !a.words.length) || this.axes[0];
    this.by = this.axes.find((a) => a !== this.x && a.distinct.length <= 12) || null;
    this.logY = false;
    this.slices = new Slices(app, $("curves-choice"), () => this.draw());
    this.choose();
    this.canvas.addEventListener("click", (e) => app.select(this.nearest(e)));
  }
  choose() {
    const again = () => { this.choose(); this.draw(); };
    const log = make("input", {type: "checkbox", checked: this.logY});
    log.addEventListener("change", () => { this.logY = log.checked; this.draw(); });
    const children = [columnSelect("over", this.axes, this.x, (c) => { if (c === this.by) this.by = null; this.x = c; again(); })];
    const others = [null, ...this.axes.filter((a) => a !== this.x && a.distinct.length <= 40)];
    if (others.length > 1) children.push(columnSelect("a curve for each", others, this.by, (c) => { this.by = c; again(); }));
    $("curves-choice").replaceChildren(...children, make("label", {}, log, " logarithmic"));
    this.slices.build([this.x, this.by]);
  }
  draw() {
    const {app, x} = this, q = app.colour, {g, width, height} = prepared(this.canvas);
    const rows = this.slices.rows().filter((row) => Number.isFinite(q.values[row]));
    this.drawn = rows;
    const values = rows.map((row) => q.values[row]);
    const span = {...q, words: [], low: Math.min(...values), high: Math.max(...values)};
    this.ys = new Scale(span, height - 46, 24, this.logY);
    if (!this.ys.log) { const room = (this.ys.high - this.ys.low) * 0.04; this.ys.low -= room; this.ys.high += room; }
    this.xs = new Scale(x, leftMargin(g, this.ys), width - 14);
    drawFrame(g, this.xs, this.ys, x.label, q.label);
    const groups = this.by ? this.by.distinct : [null];
    groups.forEach((v, i) => this.curve(g, rows.filter((row) => v === null || this.by.values[row] === v), colorOf(i)));
    if (app.selected !== null && Number.isFinite(q.values[app.selected])) {
      g.strokeStyle = css("--hot");
      g.lineWidth = 2;
      g.beginPath(), g.arc(this.xs.place(x.values[app.selected]), this.ys.place(q.values[app.selected]), 7, 0, 7), g.stroke();
    }
    $("curves-legend").replaceChildren(...(this.by ? groups.map((v, i) => {
      const swatch = make("span", {className: "swatch"});
      swatch.style.background = colorOf(i);
      return make("span", {}, swatch, ` ${this.by.name} ${this.by.text(v)}`);
    }) : []));
  }
  curve(g, rows, colour) {
    const q = this.app.colour.values, x = this.x.values;
    const at = rows.map((row) => [this.xs.place(x[row]), this.ys.place(q[row])]).sort((a, b) => a[0] - b[0]);
    g.strokeStyle = g.fillStyle = colour;
    g.lineWidth = 1.5;
    if (this.app.sweep.isGrid && !this.x.words.length) {
      g.beginPath();
      at.forEach(([px, py], i) => (i ? g.lineTo(px, py) : g.moveTo(px, py)));
      g.stroke();
    }
    if (at.length < 3000) for (const [px, py] of at) { g.beginPath(), g.arc(px, py, at.length > 150 ? 1.6 : 3, 0, 7), g.fill(); }
    else for (const [px, py] of at) g.fillRect(px - 1, py - 1, 2, 2);
  }
  nearest(e) {
    const box = this.canvas.getBoundingClientRect(), px = e.clientX - box.left, py = e.clientY - box.top;
    let best = null, least = Infinity;
    for (const row of this.drawn) {
      const d = Math.hypot(this.xs.place(this.x.values[row]) - px, this.ys.place(this.app.colour.values[row]) - py);
      if (d < least) { least = d; best = row; }
    }
    return best;
  }
}
