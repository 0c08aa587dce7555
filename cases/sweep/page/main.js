// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The page: all pictures show the same points in the same colours.

class App {
  constructor() {
    this.sweep = new Sweep(JSON.parse($("data").textContent));
    this.selected = null;
    this.filters = new Map();  // column to [low, high]
    this.colour = this.sweep.main.find((q) => q.varies) || this.sweep.main[0];
    this.shown = new Set(this.sweep.main.filter((q) => q.varies).slice(0, 8));
    this.shown.add(this.colour);
    this.head();
    this.chooseColumns();
    this.parallel = new Parallel(this);
    this.map = new MapPicture(this);
    this.curves = new Curves(this);
    showFailures(this);
    window.addEventListener("resize", () => this.draw());
    document.addEventListener("keydown", (e) => this.key(e));
    this.fromAddress();
    window.addEventListener("hashchange", () => this.fromAddress());
  }
  // report.html#point=12 opens with that point.
  fromAddress() {
    const number = Number((location.hash.match(/^#point=(\d+)$/) || [])[1] ?? NaN), row = this.sweep.points.indexOf(number);
    this.select(row < 0 ? null : row);
  }
  head() {
    const {sweep} = this, part = sweep.rows < sweep.done ? `, ${sweep.rows} of them here` : "";
    $("title").textContent = `${sweep.case}: ${sweep.origin}`;
    $("description").textContent = `${sweep.description}. ${sweep.done} of ${sweep.total} points are done, ${sweep.failures} failed${part}.`;
    $("footer").replaceChildren(make("pre", {textContent: sweep.command}), `Yoke ${sweep.yoke}`);
    const colours = $("colour");
    sweep.quantities.forEach((q, k) => {
      if (q.distinct.length) colours.append(make("option", {value: String(k), textContent: q.name, selected: q === this.colour}));
    });
    colours.addEventListener("change", () => { this.colour = sweep.quantities[Number(colours.value)]; this.shown.add(this.colour); this.chooseColumns(); this.draw(); });
    $("colour-log").addEventListener("change", () => this.draw());
    $("clear").addEventListener("click", () => { this.filters.clear(); this.draw(); });
    $("theme").addEventListener("click", () => this.theme());
    if (window.matchMedia("(prefers-color-scheme: dark)").matches) document.documentElement.classList.add("dark");
  }
  theme() { document.documentElement.classList.toggle("dark"); this.draw(); }
  key(e) {
    if (e.target.tagName === "SELECT" || e.target.tagName === "INPUT") return;
    if (e.key === "t") this.theme();
    const step = {ArrowRight: 1, ArrowLeft: -1}[e.key];
    if (!step) return;
    e.preventDefault();
    this.select(Math.min(Math.max((this.selected ?? -step) + step, 0), this.sweep.rows - 1));
  }
  chooseColumns() {
    $("columns").replaceChildren(...this.sweep.quantities.filter((q) => q.varies || q === this.colour).map((q) => {
      const box = make("input", {type: "checkbox", checked: this.shown.has(q)});
      box.addEventListener("change", () => { if (box.checked) this.shown.add(q); else this.shown.delete(q); this.draw(); });
      return make("label", {}, box, q.name);
    }));
  }
  shownColumns() { return [...this.sweep.axes, ...this.sweep.quantities.filter((q) => this.shown.has(q))]; }
  // Rows that all filters leave.
  rows() {
    if (this.kept) return this.kept;
    const filters = [...this.filters];
    this.kept = [];
    for (let row = 0; row < this.sweep.rows; ++row)
      if (filters.every(([c, [low, high]]) => c.values[row] >= low && c.values[row] <= high)) this.kept.push(row);
    return this.kept;
  }
  filter(column, range) {
    if (range) this.filters.set(column, range); else this.filters.delete(column);
    this.draw();
  }
  select(row) {
    this.selected = row;
    showPoint(this.sweep, row);
    this.draw();
  }
  colourOf(row) {
    const v = this.colour.values[row];
    return Number.isFinite(v) ? viridisAt(this.colours.share(v)) : css("--line");
  }
  draw() {
    this.kept = null;
    this.colours = new Scale(this.colour, 8, 252, $("colour-log").checked);
    $("colour-log").parentElement.hidden = !(this.colour.low > 0);
    const {g} = prepared($("colour-bar"));
    for (let x = 8; x < 252; ++x) { g.fillStyle = viridisAt((x - 8) / 244); g.fillRect(x, 2, 1.5, 12); }
    g.fillStyle = css("--soft");
    g.textBaseline = "top";
    g.textAlign = "left";
    g.fillText(short(this.colours.low, 4), 8, 18);
    g.textAlign = "right";
    g.fillText(`${short(this.colours.high, 4)} ${this.colour.unit}`, 252, 18);
    const count = this.rows().length;
    $("count").textContent = count < this.sweep.rows ? `${count} of ${this.sweep.rows} points` : "";
    $("clear").hidden = this.filters.size === 0;
    this.parallel.draw();
    this.map.draw();
    this.curves.draw();
  }
}

window.yokeSweep = new App();
