// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The page: one run is animated, one or more are plotted, all share one time.

const nearestContact = "*";  // no element is called so

class App {
  constructor() {
    this.about = JSON.parse($("about").textContent);
    this.runs = readRuns();
    this.run = this.runs[0];
    this.camera = new Camera();
    this.view = {traces: [], arrows: "contacts", arrowSize: 0, names: false, lens: "", magnification: 100};
    this.differences = false;
    this.side = false;      // runs beside one another, not over one another
    this.range = null;      // [from, to] of the time axes after zooming
    this.playing = false;
    this.waiting = false;   // for a frame
    this.plotChoice = new Set([0]);
    if (this.about.kind === "comparison") this.runs.forEach((_, i) => this.plotChoice.add(i));
    this.awaited = [];      // plots that came into view and are not drawn yet
    this.time = this.run.start;
    this.span = [Math.min(...this.runs.map((r) => r.start)), Math.max(...this.runs.map((r) => r.end))];
  }
  plotted() {
    const list = this.runs.filter((r) => this.plotChoice.has(r.index) || r === this.run);
    return list;
  }

  start() {
    $("title").textContent = this.about.title;
    $("description").textContent = this.run.description || "";
    $("footer").textContent = `Yoke ${this.run.yoke}. Keys: space plays, arrows step, n and p go to events, + \u2212 0 zoom, t light or dark.`;
    const dark = window.matchMedia && window.matchMedia("(prefers-color-scheme: dark)").matches;
    document.documentElement.classList.toggle("dark", dark);
    $("theme").addEventListener("click", () => this.toggleTheme());
    $("run-choice").hidden = this.runs.length < 2;
    fillSelect($("run"), this.runs.map((r) => [String(r.index), r.label]), "0");
    $("run").addEventListener("change", (e) => this.choose(Number(e.target.value)));
    $("play").addEventListener("click", () => this.toggle());
    $("back").addEventListener("click", () => this.step(-1));
    $("next").addEventListener("click", () => this.step(1));
    $("scrub").addEventListener("input", (e) => { this.pause(); this.seek(this.run.start + (this.run.end - this.run.start) * e.target.value / 1e5); });
    $("speed").addEventListener("change", (e) => { this.speed = Number(e.target.value); });
    $("fit").addEventListener("click", () => this.fit());
    $("zoom-in").addEventListener("click", () => this.zoom(1.3));
    $("zoom-out").addEventListener("click", () => this.zoom(1 / 1.3));
    $("follow").addEventListener("change", (e) => { this.camera.followed = e.target.value === "" ? null : Number(e.target.value); this.lastFollowed = null; this.redraw(); });
    $("trace").addEventListener("change", (e) => { this.view.traces = this.traces[Number(e.target.value)].of; this.redraw(); });
    $("lens-choice").addEventListener("change", (e) => { this.view.lens = e.target.value; this.showLens(); });
    $("magnification").addEventListener("input", (e) => { this.view.magnification = 10 ** e.target.value; this.redraw(); });
    fillSelect($("arrows"), [["none", "none"], ["contacts", "contacts"], ["all", "all forces"]], "contacts");
    $("arrows").addEventListener("change", (e) => { this.view.arrows = e.target.value; this.redraw(); });
    $("arrow-size").addEventListener("input", (e) => { this.view.arrowSize = Number(e.target.value); this.redraw(); });
    $("names").addEventListener("change", (e) => { this.view.names = e.target.checked; this.redraw(); });
    $("side").addEventListener("change", (e) => { this.side = e.target.checked; this.rebuild(); });
    const views = this.run.views || [];
    $("view-label").hidden = views.length === 0;
    fillSelect($("view"), [["", "whole run"], ...views.map((v, i) => [String(i), v.title])], "");
    $("view").addEventListener("change", (e) => this.showView(e.target.value === "" ? null : views[Number(e.target.value)]));
    $("difference").addEventListener("change", (e) => { this.differences = e.target.checked; this.rebuild(); });
    listenToCanvas(this);
    listenToKeys(this);
    this.table = new EventTable(this);
    this.fillChips();
    fillComparison(this.runs);
    this.makePlots();
    this.choose(0);
    window.addEventListener("resize", () => this.resized());
    window.matchMedia("print").addEventListener("change", () => this.buildAll());
  }

  // ---- what is shown ----

  choose(index) {
    const run = this.run = this.runs[index];
    this.time = Math.min(Math.max(this.time, run.start), run.end);
    $("description").textContent = run.description || "";
    const bodies = run.drawing.bodies.map((b, i) => [String(i), b.name]).slice(1);
    fillSelect($("follow"), [["", "nothing"], ...bodies], "");
    this.camera.followed = null;
    this.traces = this.tracesOf(run);
    const chosen = this.traces.length > 1 && this.traces[1].name === "paths" ? 1 : 0;
    fillSelect($("trace"), this.traces.map((t, i) => [String(i), t.name]), String(chosen));
    this.view.traces = this.traces[chosen].of;
    const lenses = run.elements.contacts.filter((e) => run.column(`${e}.penetration`) && run.drawing.shapes.some((s) => s.kind === "disc" && s.element === e));
    $("lens-choice").parentElement.hidden = lenses.length === 0;
    const choices = [...(lenses.length > 1 ? [[nearestContact, "the nearest contact"]] : []), ...lenses.map((e) => [e, e])];
    this.lenses = lenses;
    fillSelect($("lens-choice"), [["", "none"], ...choices], "");
    // A clearance is not seen without the lens: it is there from the start where there is room.
    if (!choices.some(([value]) => value === this.view.lens))
      this.view.lens = lenses.length && window.innerWidth > 700 ? choices[0][0] : "";
    $("lens-choice").value = this.view.lens;
    this.speed = run.moves ? this.fittingSpeed(run) : 1;
    fillSelect($("speed"), [...new Set([...speeds, this.speed])].sort((a, b) => b - a).map((s) => [String(s), speedText(s)]), String(this.speed));
    $("bar").hidden = !run.moves;
    $("plots-section").hidden = !run.moves;
    $("linked").className = run.moves ? "" : "alone";
    this.table.load(run);
    fillSummary(run);
    this.showLens();
    this.rebuild();
  }
  // The run in about ten seconds, by one of the speeds.
  fittingSpeed(run) {
    const wanted = (run.end - run.start) / 10;
    return speeds.find((s) => s <= wanted * 1.5) || speeds[speeds.length - 1];
  }
  tracesOf(run) {
    const list = [];
    run.drawing.bodies.forEach((b, i) => { if (i > 0) list.push({name: b.name, body: i, x: 0, y: 0}); });
    const paths = list.filter((t) => run.paths.includes(t.name));
    const seen = new Set();
    for (const s of run.drawing.shapes) {
      if (!["pin", "point", "disc"].includes(s.kind) || seen.has(s.element)) continue;
      const second = s.body === 0 && s.points.length >= 4;
      const body = second ? s.other : s.body;
      if (body === 0) continue;
      seen.add(s.element);
      list.push({name: s.element, body, x: s.points[second ? 2 : 0], y: s.points[second ? 3 : 1]});
    }
    const choices = list.map((t) => ({name: t.name, of: [t]}));
    if (paths.length) choices.unshift({name: "paths", of: paths});
    return [{name: "nothing", of: []}, ...choices];
  }
  fillChips() {
    $("run-chips").hidden = $("difference-label").hidden = $("side-label").hidden = this.runs.length < 2;
    $("run-chips").replaceChildren(...this.runs.map((run) => {
      const box = make("input", {type: "checkbox", checked: this.plotChoice.has(run.index)});
      box.addEventListener("change", () => { if (box.checked) this.plotChoice.add(run.index); else this.plotChoice.delete(run.index); this.rebuild(); });
      const swatch = make("span", {className: "swatch"});
      swatch.style.background = colorOf(run.index);
      return make("label", {}, box, swatch, run.label);
    }));
  }

  // ---- plots: made when they are first seen, one a frame, after the mechanism ----

  makePlots() {
    this.timePlots = [], this.xyPlots = [];
    if (!this.runs.some((r) => r.moves)) return;
    this.watch = new IntersectionObserver((entries) => {
      for (const entry of entries) {
        const plot = entry.target.plot;
        plot.seen = entry.isIntersecting;
        if (plot.seen) this.drawSoon(plot);
      }
    }, {rootMargin: "300px"});
    const place = (box, plot, list) => { box.append(plot.box); plot.box.plot = plot; plot.stale = true; list.push(plot); this.watch.observe(plot.box); };
    for (const group of plotGroups(this.runs)) place($("plots"), new TimePlot(this, group), this.timePlots);
    const grid = make("div", {className: "xy-grid"});
    $("plots").append(grid);
    const add = (title, specOf) => {
      const plot = new XyPlot(this, title, specOf);
      place(grid, plot, this.xyPlots);
      return plot;
    };
    const contacts = [...new Set(this.runs.flatMap((r) => r.elements.contacts))].slice(0, 8);
    for (const element of contacts) {
      if (this.runs.some((r) => r.column(`${element}.normal_force`) && r.column(`${element}.normal_force`).largest > 0))
        add(hysteresisTitle(element), () => hysteresisOf(this, element));
      if (hasOrbit(this.run, element)) add(orbitTitle(this.run, element), () => orbitOf(this, element));
    }
    const choices = phaseChoices(this.run);
    if (choices.length) {
      let chosen = 0;
      const plot = add(phaseTitle, () => phaseOf(this, choices[chosen]));
      const select = make("select", {title: "coordinate"});
      fillSelect(select, choices.map((c, i) => [String(i), c[0]]), "0");
      select.addEventListener("change", () => { chosen = Number(select.value); plot.refresh(); });
      plot.tools.append(select);
    }
    for (const run of this.runs)
      for (const portrait of run.portraits) {
        const title = this.runs.length > 1 ? `${portrait.title} \u00b7 ${run.label}` : portrait.title;
        add(title, () => portraitOf(portrait, title));
      }
  }
  // Drawn in one of the next frames: what the user does is answered in between.
  drawSoon(plot) {
    if (this.awaited.push(plot) > 1) return;
    const next = () => {
      const first = this.awaited.find((p) => p.seen);
      this.awaited = first ? this.awaited.filter((p) => p !== first) : [];
      if (first) this.freshen(first);
      if (this.awaited.length) requestAnimationFrame(next);
    };
    requestAnimationFrame(next);
  }
  freshen(plot) {
    if (plot instanceof TimePlot) { if (plot.stale) plot.build(); else plot.update(); } else { if (plot.stale) plot.refresh(); else plot.draw(); }
    plot.stale = false;
  }
  allPlots() { return [...this.timePlots, ...this.xyPlots]; }
  rebuild() {
    for (const plot of this.allPlots()) {
      plot.stale = true;
      if (plot.seen) this.freshen(plot);
    }
  }
  buildAll() { for (const plot of this.allPlots()) this.freshen(plot); }
  setRange(from, to) {
    this.range = from === null ? null : [from, to];
    const [a, b] = this.range || this.span;
    for (const plot of this.timePlots) plot.setRange(a, b);
    for (const plot of this.xyPlots) {
      plot.stale = true;
      if (plot.seen) this.freshen(plot);
    }
  }
  // A stretch of the run that the case offers by name: what is plotted, and when.
  showView(view) {
    if (!view) { this.setRange(null); return; }
    if (view.all) { this.runs.forEach((r) => this.plotChoice.add(r.index)); this.fillChips(); this.rebuild(); }
    this.setRange(view.from, view.to);
    this.seek(view.from);
    const plot = this.timePlots.find((p) => p.group.names.some((n) => view.columns.includes(n)));
    const target = view.over ? this.xyPlots.find((p) => p.title.includes(": force over penetration")) : plot;
    if (!target) return;
    if (!view.over) {
      for (const name of target.group.names) if (view.columns.includes(name)) target.on.add(name), target.off.delete(name); else target.off.add(name);
      target.stale = true;
      if (target.seen) this.freshen(target);
    }
    target.box.scrollIntoView({block: "center"});
  }
  resized() {
    for (const plot of this.timePlots) plot.resize();
    this.redraw();
  }

  // ---- time ----

  toggle() { if (this.playing) this.pause(); else this.play(); }
  play() {
    if (!this.run.moves) return;
    if (this.time >= this.run.end) this.time = this.run.start;
    this.playing = true;
    $("play").textContent = "\u23f8";
    this.clock = null;
    this.redraw();
  }
  pause() { this.playing = false; $("play").textContent = "\u25b6"; }
  seek(t) { this.time = Math.min(Math.max(t, this.run.start), this.run.end); this.redraw(); }
  jump(t) { this.pause(); this.seek(t); this.showAround(t); }
  // The time axes move on if the time is beyond what they show.
  showAround(t) {
    if (!this.range || (t >= this.range[0] && t <= this.range[1])) return;
    const half = (this.range[1] - this.range[0]) / 2;
    this.setRange(t - half, t + half);
  }
  step(direction) {
    const stops = this.run.stops, slack = 1e-12 * Math.max(1, Math.abs(this.run.end));
    const next = direction > 0 ? stops.find((t) => t > this.time + slack) : stops.findLast((t) => t < this.time - slack);
    if (next !== undefined) this.jump(next);
  }
  nudge(count) { this.pause(); const [a, b] = this.range || this.span; this.seek(this.time + count * (b - a) / 400); }
  advance(now) {
    if (this.clock !== null && this.clock !== undefined) this.time += (now - this.clock) / 1000 * this.speed;
    this.clock = now;
    if (this.time >= this.run.end) { this.time = this.run.end; this.pause(); }
    this.showAround(this.time);
  }

  // ---- drawing ----

  redraw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame((now) => {
      this.waiting = false;
      if (this.playing) this.advance(now);
      this.draw();
      if (this.playing) this.redraw();
    });
  }
  draw() {
    const {context, width, height} = contextOf($("mechanism"));
    if (this.camera.width !== width || this.camera.height !== height) {
      Object.assign(this.camera, {width, height});
      this.camera.fit(this.run.box, this.covered());
    }
    const painter = new Painter(context, this.camera, this.run, this.time);
    this.follow(painter.poses);
    drawMechanism(painter, this.view);
    const row = rowAt(this.run, this.time);
    $("readout").textContent = this.run.moves ? `t = ${quantity(this.time, "s", 6)}` + this.touching(row) : "start pose";
    $("scrub").value = this.run.moves ? 1e5 * (this.time - this.run.start) / (this.run.end - this.run.start) : 0;
    $("magnification-text").textContent = ` ${Math.round(this.view.magnification)}`;
    if (this.view.lens) drawLens($("lens"), this.run, this.underLens(), this.time, this.view.magnification, $("lens-text"));
    for (const plot of this.allPlots())
      if (plot.seen && !plot.stale) { if (plot instanceof TimePlot) plot.update(); else plot.draw(); }
    this.table.update(this.time);
  }
  touching() {
    const parts = [];
    for (const e of this.run.elements.contacts) {
      const force = between(this.run, this.run.column(`${e}.normal_force`), this.time);
      if (force > 0 && parts.length < 4) parts.push(`\n${e}: ${quantity(force, "N")}`);
    }
    return parts.join("");
  }
  follow(poses) {
    const body = this.camera.followed;
    if (body === null) return;
    const now = poses[body];
    if (this.lastFollowed) { this.camera.x += now.x - this.lastFollowed.x; this.camera.y += now.y - this.lastFollowed.y; }
    else { this.camera.x = now.x, this.camera.y = now.y; }
    this.lastFollowed = now;
  }
  fit() {
    const canvas = $("mechanism");
    Object.assign(this.camera, {width: canvas.clientWidth, height: canvas.clientHeight});
    this.camera.fit(this.run.box, this.covered());
    this.redraw();
  }
  covered() { return this.view.lens && this.camera.width > 480 ? $("lens-box").offsetWidth + 12 : 0; }
  zoom(factor) { this.camera.zoom(factor); this.redraw(); }
  // The contact chosen, or the one whose disc is nearest to its wall or deepest in it.
  underLens() {
    if (this.view.lens !== nearestContact) return this.view.lens;
    const depth = (e) => between(this.run, this.run.column(`${e}.penetration`), this.time);
    return this.lenses.reduce((a, b) => (depth(b) > depth(a) ? b : a));
  }
  showLens() {
    $("lens-box").hidden = this.view.lens === "";
    $("magnification-label").hidden = this.view.lens === "";
    if (this.view.lens) {
      this.view.magnification = fittingMagnification(this.run, this.underLens(), this.time);
      $("magnification").value = Math.log10(this.view.magnification);
    }
    this.fit();
  }
  toggleTheme() {
    document.documentElement.classList.toggle("dark");
    this.rebuild();
    this.redraw();
  }
}

const app = new App();
app.start();
// For scripts that test the page.
window.yoke = {app};
