// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Plots over time, by uPlot. All share one time axis and one cursor with the animation. With one run
// shown a colour is a quantity; with more it is a run, and the dashes tell quantities apart.

const firstShown = 4;  // series of a plot; the others wait in its legend
const dashes = [[], [8, 4], [2, 3], [10, 3, 2, 3], [14, 5], [5, 2]];

// What can be plotted of the runs: [{title, unit, names}].
function plotGroups(runs) {
  const all = new Map();
  for (const run of runs)
    for (const c of run.columns) if (!c.constant && !c.labels && c.name !== "t" && !all.has(c.name)) all.set(c.name, c.unit);
  const elements = (kind) => new Set(runs.flatMap((r) => r.elements[kind]));
  const bodies = new Set(runs.flatMap((r) => r.drawing.bodies.map((b) => b.name)));
  const drivers = elements("drivers"), joints = elements("joints"), contacts = elements("contacts");
  const groups = [];
  const taken = new Set();
  const group = (title, test) => {
    const byUnit = new Map();
    for (const [name, unit] of all) {
      const dot = name.lastIndexOf(".");
      const owner = dot < 0 ? "" : name.slice(0, dot), field = name.slice(dot + 1);
      if (taken.has(name) || !test(owner, field, unit)) continue;
      taken.add(name);
      if (!byUnit.has(unit)) byUnit.set(unit, []);
      byUnit.get(unit).push(name);
    }
    for (const [unit, names] of byUnit) groups.push({title, unit, names});
  };
  const of = (set, ...fields) => (owner, field) => set.has(owner) && fields.includes(field);
  group("Contact force", of(contacts, "normal_force"));
  group("Friction force", of(contacts, "friction_force"));
  if (groups.some((g) => g.title === "Friction force")) group("Sliding velocity", of(contacts, "tangential_velocity"));
  group("Penetration", of(contacts, "penetration"));
  group("Position", of(bodies, "x", "y"));
  group("Angle", of(bodies, "angle"));
  group("Velocity", of(bodies, "vx", "vy"));
  group("Angular velocity", of(bodies, "omega"));
  group("Driver", (owner) => drivers.has(owner));
  group("Reactions", of(joints, "fx", "fy", "moment"));
  group("Energy", (owner, field, unit) => unit === "J" && owner === "" && ["kinetic", "potential", "stored", "dissipated", "work"].includes(field));
  group("Energy ledger: what is missing", (owner, field) => owner === "" && field === "balance");
  group("Acceleration", of(bodies, "ax", "ay"));
  group("Angular acceleration", of(bodies, "alpha"));
  group("Penetration rate", of(contacts, "penetration_rate"));
  group("Loads and others", (owner, field) => !contacts.has(owner) && field !== "balance");
  return groups;
}

// As uPlot would choose it, but rounding of a constant does not fill the plot.
function readableRange(low, high) {
  if (low === null || high === null) return [0, 1];
  const size = Math.max(Math.abs(low), Math.abs(high));
  return high - low < 1e-9 * size ? [low - 0.1 * size, high + 0.1 * size] : uPlot.rangeNum(low, high, 0.1, true);
}

class TimePlot {
  constructor(app, group) {
    Object.assign(this, {app, group});
    this.box = make("div", {className: "plot"});
    this.heading = make("h3");
    this.place = make("div");
    this.legend = make("div", {className: "legend"});
    this.box.append(this.heading, this.place, this.legend);
    this.box.style.minHeight = "270px";
    this.off = new Set();  // series the user has hidden
    this.on = new Set();   // and shown beyond the first
  }

  // Series of the runs in the plots: [{run, column, name, label}].
  series() {
    const runs = this.app.plotted(), list = [];
    this.group.names.forEach((name, q) => {
      for (const run of runs) {
        const column = run.column(name);
        if (!column || (column.constant && runs.length === 1)) continue;
        list.push({run, column, name, quantity: q, label: runs.length > 1 ? `${name} \u00b7 ${run.label}` : name});
      }
    });
    return list;
  }
  shown(s) {
    if (this.off.has(s.name)) return false;
    return this.on.has(s.name) || s.quantity < firstShown;
  }

  build() {
    for (const plot of this.plots || []) plot.destroy();
    this.place.replaceChildren();
    this.legend.replaceChildren();
    this.values = [];
    this.plots = [];
    this.data = [];
    const list = this.series(), runs = this.app.plotted();
    const differences = this.app.differences && runs.length > 1;
    const shown = list.filter((s) => this.shown(s) && !(differences && s.run === runs[0]));
    const most = Math.max(...shown.map((s) => s.column.largest), 0);
    const {factor, unit} = scaleFor(most, this.group.unit);
    this.heading.textContent = `${this.group.title}${differences ? ", difference from " + runs[0].label : ""}${unit ? " [" + unit + "]" : ""}`;
    const side = this.app.side && runs.length > 1;
    this.place.className = side ? "panels" : "";
    const panels = side ? runs.map((r) => shown.filter((s) => s.run === r)).filter((p) => p.length) : [shown];
    const how = {factor, differences, side, runs};
    this.data = panels.map((panel) => this.dataOf(panel, how));
    panels.forEach((panel, i) => this.addPanel(panel, this.data[i], how));
    this.fillLegend(list, runs);
    this.update();
  }

  valuesOf(s, {factor, differences, runs}) {
    if (!differences) return [s.run.t, Array.from(s.column.values, (v) => v * factor)];
    const base = runs[0].column(s.name);
    return [s.run.t, Array.from(s.column.values, (v, i) => base ? (v - between(runs[0], base, s.run.t[i])) * factor : null)];
  }

  dataOf(shown, how) {
    const tables = shown.map((s) => this.valuesOf(s, how));
    if (shown.length === 0) return [[0, 1]];
    return shown.every((s) => s.run === shown[0].run) ? [tables[0][0], ...tables.map((p) => p[1])] : uPlot.join(tables);
  }

  addPanel(shown, data, {runs, side}) {
    const same = shown.every((s) => s.run === shown[0].run);
    const box = make("div");
    if (side) box.append(make("div", {className: "panel-name", textContent: shown[0].run.label}));
    this.place.append(box);
    const font = "12px system-ui, sans-serif";
    const axis = {stroke: css("--soft"), grid: {stroke: css("--grid"), width: 1}, ticks: {stroke: css("--line"), width: 1}, font};
    const timeScale = scaleFor(Math.max(...runs.map((r) => Math.abs(r.end))), "s");
    const options = {
      width: this.widthOf(side), height: side ? 170 : 210,
      legend: {show: false},
      cursor: {y: false, drag: {x: true, y: false, setScale: false}, sync: {key: "yoke", setSeries: false}, points: {size: 6}},
      scales: {x: {time: false}, y: {range: side ? () => this.commonRange() : (u, low, high) => readableRange(low, high)}},
      series: [{}, ...shown.map((s) => ({
        stroke: this.colorFor(s, runs), width: 1.4, pxAlign: 0, spanGaps: !same, points: {show: false},
        dash: runs.length > 1 ? dashes[s.quantity % dashes.length] : [],
      }))],
      axes: [
        {...axis, label: `t [${timeScale.unit}]`, labelSize: 18, labelFont: font, size: 34, values: (u, ticks) => ticks.map((v) => short(v * timeScale.factor, 6))},
        {...axis, size: 62, values: (u, ticks) => ticks.map((v) => short(v, 5))},
      ],
      hooks: {
        setSelect: [(u) => {
          if (u.select.width < 3) return;
          const from = u.posToVal(u.select.left, "x"), to = u.posToVal(u.select.left + u.select.width, "x");
          u.setSelect({left: 0, width: 0, top: 0, height: 0}, false);
          this.app.setRange(from, to);
        }],
        draw: [(u) => this.drawEvents(u, side && shown.length ? shown[0].run : this.app.run)],
      },
    };
    const plot = new uPlot(options, data, box);
    this.plots.push(plot);
    let dragged = false, downAt = 0;
    plot.over.addEventListener("mousedown", (e) => { dragged = false; downAt = e.clientX; });
    plot.over.addEventListener("mousemove", (e) => { if (e.buttons && Math.abs(e.clientX - downAt) > 3) dragged = true; });
    plot.over.addEventListener("click", (e) => { if (!dragged) this.app.seek(plot.posToVal(e.offsetX, "x")); });
    plot.over.addEventListener("dblclick", () => this.app.setRange(null));
    const [min, max] = this.app.range || this.app.span;
    plot.setScale("x", {min, max});
  }
  get plot() { return this.plots && this.plots[0]; }
  colorFor(s, runs) { return runs.length > 1 ? colorOf(s.run.index) : colorOf(s.quantity); }
  widthOf(side) {
    const width = Math.max(200, this.box.clientWidth);
    return side && width > 620 ? Math.floor(width / Math.floor(width / 310)) - 8 : width;
  }

  // Side by side, all panels have one scale: of what is seen of them.
  commonRange() {
    const [min, max] = this.app.range || this.app.span;
    let low = Infinity, high = -Infinity;
    for (const [t, ...columns] of this.data)
      for (let i = 0; i < t.length; ++i) {
        if (t[i] < min || t[i] > max) continue;
        for (const c of columns) { if (c[i] < low) low = c[i]; if (c[i] > high) high = c[i]; }
      }
    if (!(low <= high)) return [0, 1];
    const room = (high - low || Math.abs(high) || 1) * 0.05;
    return [low - room, high + room];
  }

  // Names every quantity of the plot, one button each.
  fillLegend(list, runs) {
    for (const name of new Set(list.map((s) => s.name))) {
      const sample = list.find((s) => s.name === name), pressed = this.shown(sample);
      const value = make("span", {className: "value"});
      const swatch = make("span", {className: "swatch"});
      swatch.style.background = runs.length > 1 ? css("--soft") : this.colorFor(sample, runs);
      const button = make("button", {type: "button"}, swatch, name, value);
      button.setAttribute("aria-pressed", pressed);
      button.addEventListener("click", () => {
        if (this.shown(sample)) { this.off.add(name); this.on.delete(name); } else { this.off.delete(name); this.on.add(name); }
        this.build();
      });
      this.legend.append(button);
      this.values.push({name, value, pressed});
    }
  }

  // Thin marks where contacts begin.
  drawEvents(u, run) {
    const {min, max} = u.scales.x, impacts = run.impacts.filter((i) => i.onset >= min && i.onset <= max);
    if (impacts.length === 0 || impacts.length > 300) return;
    const g = u.ctx;
    g.save();
    g.strokeStyle = css("--hot");
    g.globalAlpha = 0.25;
    g.lineWidth = 1;
    g.setLineDash([]);
    g.beginPath();
    for (const i of impacts) {
      const x = Math.round(u.valToPos(i.onset, "x", true));
      g.moveTo(x, u.bbox.top), g.lineTo(x, u.bbox.top + u.bbox.height);
    }
    g.stroke();
    g.restore();
  }

  // The cursor at the time of the animation, and the values there.
  update() {
    for (const plot of this.plots || []) {
      const left = plot.valToPos(this.app.time, "x");
      plot.setCursor({left: left >= 0 && left <= plot.over.clientWidth ? left : -10, top: 0}, false);
    }
    for (const {name, value, pressed} of this.values || []) {
      const column = this.app.run.column(name);
      value.textContent = pressed && column ? quantity(between(this.app.run, column, this.app.time), column.unit) : "";
    }
  }
  resize() {
    const side = this.app.side && this.app.plotted().length > 1;
    for (const plot of this.plots || []) plot.setSize({width: this.widthOf(side), height: plot.height});
  }
  setRange(from, to) { for (const plot of this.plots || []) plot.setScale("x", {min: from, max: to}); }
}
