"use strict";
// Makes the figures of the page live: zoom, reset, values under the cursor, legend toggles, logarithmic axis, files, data tables.
// Figures over time share one cursor and one range. The static picture stays for print and for browsers without scripts.
(() => {
  const page = JSON.parse(document.getElementById("strutt-data").textContent);
  const root = document.documentElement;
  const words = page.words;

  // ---- numbers
  const digitsUp = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };
  const raised = (n) => String(n).replace(/./g, (c) => digitsUp[c] || "");
  const local = (text) => text.replace("-", "−").replace(".", page.mark);
  function number(v, digits) {
    if (v == null || !isFinite(v)) return "–";
    if (v === 0) return "0";
    const size = Math.abs(v);
    if (size >= 1e6 || size < 1e-4) {
      const [m, e] = v.toExponential(digits - 1).split("e");
      return local(m) + "·10" + raised(+e);
    }
    return local(v.toPrecision(digits).includes("e") ? v.toFixed(0) : v.toPrecision(digits));
  }
  function tick(v, step) {
    if (v == null) return "";
    if (Math.abs(v) < step * 1e-6) v = 0;
    if (v === 0 && step < 1e-4) return "0";
    if (Math.abs(v) >= 1e6 || step < 1e-4) {
      const decimals = Math.max(0, Math.floor(Math.log10(Math.abs(v)) + 1e-9) - Math.floor(Math.log10(step) + 1e-9));
      const [m, e] = v.toExponential(Math.min(decimals, 12)).split("e");
      return local(m) + "·10" + raised(+e);
    }
    return local(v.toFixed(Math.max(0, -Math.floor(Math.log10(step) + 1e-9))));
  }
  function decade(v) {
    const power = v > 0 ? Math.log10(v) : NaN;
    if (!(Math.abs(power - Math.round(power)) < 1e-9)) return "";
    return Math.abs(power) <= 2 ? local(String(+v.toPrecision(1))) : "10" + raised(Math.round(power));
  }
  const format = { number, tick };

  // ---- look
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const isDark = () => (root.dataset.theme ? root.dataset.theme === "dark" : dark.matches);
  function look() {
    const style = getComputedStyle(root), get = (name) => style.getPropertyValue("--" + name).trim();
    return { dark: isDark(), ink: get("ink"), soft: get("soft"), faint: get("faint"), shade: get("shade"), ground: get("ground") };
  }

  function element(tag, attributes, ...children) {
    const e = document.createElement(tag);
    for (const [key, value] of Object.entries(attributes || {})) key === "html" ? (e.innerHTML = value) : e.setAttribute(key, value);
    e.append(...children);
    return e;
  }
  function swatch(series) {
    const colour = series.colour[isDark() ? 1 : 0];
    return element("span", {
      html: `<svg width="30" height="8" aria-hidden="true">${series.dots ? `<circle cx="15" cy="4" r="3" fill="${colour}"/>` : `<path d="M0 4h30" stroke="${colour}" stroke-width="2" stroke-dasharray="${series.dash.join(" ")}"/>`}</svg>`,
    }).firstChild;
  }

  // ---- curves over a growing x, by uPlot
  // steps of 1, 2, 5: the labels have as many decimals as the step, which 2.5 would break
  const incrs = [];
  for (let power = -15; power <= 15; power++) for (const m of [1, 2, 5]) incrs.push(+`${m}e${power}`);
  const timed = [];
  let sharing = false;
  function Curves(host, figure, shown, tip) {
    const visible = figure.series.map(() => true);
    let log = figure.y.log, plot = null, range = null;
    const same = figure.series.every((s, i) => i === 0 || s.x === null);
    const data = same
      ? [figure.series[0].x, ...figure.series.map((s) => s.y)]
      : uPlot.join(figure.series.map((s) => [s.x, s.y]));
    const positive = (a) => a.map((v) => (v > 0 ? v : null));
    const canLog = figure.series.some((s) => s.y.some((v) => v > 0));

    function behind(u) {
      const c = u.ctx, b = u.bbox, ratio = devicePixelRatio || 1, theme = look();
      c.save();
      for (const [from, to] of figure.strip) {
        if (to <= from) continue;
        const [p, q] = [from, to].map((v) => Math.min(b.left + b.width, Math.max(b.left, u.valToPos(v, "x", true))));
        c.fillStyle = theme.shade;
        c.fillRect(p, b.top, q - p, b.height);
      }
      c.strokeStyle = theme.soft; c.lineWidth = ratio;
      for (const [from, to] of figure.strip) {
        const p = u.valToPos(from, "x", true);
        if (to > from || p < b.left || p > b.left + b.width) continue;
        c.globalAlpha = 0.45; c.setLineDash([3 * ratio, 3 * ratio]);
        c.beginPath(); c.moveTo(p, b.top); c.lineTo(p, b.top + b.height); c.stroke();
        c.globalAlpha = 1; c.setLineDash([]); c.fillStyle = theme.soft;
        c.beginPath(); c.moveTo(p, b.top + b.height - 6 * ratio); c.lineTo(p - 4 * ratio, b.top + b.height); c.lineTo(p + 4 * ratio, b.top + b.height); c.fill();
      }
      c.restore();
    }
    function front(u) {
      const c = u.ctx, b = u.bbox, ratio = devicePixelRatio || 1, theme = look();
      c.save();
      c.font = `${12 * ratio}px 'DejaVu Sans', Verdana, Arial, sans-serif`;
      c.fillStyle = theme.ink; c.strokeStyle = theme.soft; c.lineWidth = ratio;
      const taken = [];
      for (const [x, y, label] of figure.marks) {
        const p = x == null ? b.left : u.valToPos(x, "x", true), q = y == null ? b.top + 18 * ratio : u.valToPos(y, "y", true);
        if (p < b.left || p > b.left + b.width || q < b.top || q > b.top + b.height) continue;
        c.beginPath();
        if (x != null && y != null) { c.arc(p, q, 3.5 * ratio, 0, 7); c.fill(); }
        else {
          c.setLineDash([3 * ratio, 3 * ratio]);
          x == null ? (c.moveTo(b.left, q), c.lineTo(b.left + b.width, q)) : (c.moveTo(p, b.top), c.lineTo(p, b.top + b.height));
          c.stroke(); c.setLineDash([]);
        }
        const end = p > b.left + b.width / 2;
        c.textAlign = end ? "right" : "left";
        // labels of near lines stand below one another
        const wide = c.measureText(label).width, from = end ? p - 6 * ratio - wide : p + 6 * ratio;
        let row = q - 5 * ratio;
        while (y == null && taken.some((t) => t[2] === row && from < t[1] && t[0] < from + wide)) row += 14 * ratio;
        taken.push([from, from + wide, row]);
        c.fillText(label, p + (end ? -6 : 6) * ratio, row);
      }
      c.restore();
    }
    function build() {
      const theme = look(), y = log ? data.slice(1).map(positive) : data.slice(1);
      const axis = {
        stroke: theme.ink, font: "12px 'DejaVu Sans', Verdana, 'Segoe UI', Arial, sans-serif",
        grid: { stroke: theme.faint, width: 1 }, ticks: { stroke: theme.soft, width: 1, size: 5 },
      };
      const gaps = (u, splits) => (splits.length > 1 ? Math.abs(splits[1] - splits[0]) : 1);
      const options = {
        width: host.clientWidth, height: 250, legend: { show: false }, padding: [8, 18, 0, 0],
        scales: { x: { time: false, distr: figure.x.log ? 3 : 1 }, y: { distr: log ? 3 : 1 } },
        axes: [
          { ...axis, size: 30, ...(figure.x.log ? {} : { incrs }), values: (u, s) => s.map((v) => (figure.x.log ? decade(v) : tick(v, gaps(u, s)))) },
          { ...axis, size: 64, ...(log ? {} : { incrs }), values: (u, s) => s.map((v) => (log ? decade(v) : tick(v, gaps(u, s)))) },
        ],
        series: [{}, ...figure.series.map((s, i) => ({
          stroke: s.colour[theme.dark ? 1 : 0], width: 1.6, dash: s.dash, points: { show: false }, pxAlign: 0, show: visible[i], spanGaps: !same,
        }))],
        cursor: {
          drag: { x: true, y: true, uni: 24 }, points: { size: 8, width: 2, fill: theme.ground },
          sync: { key: "strutt-" + figure.x.text, filters: { pub: (type) => type === "mousemove" || type === "mouseleave" } },
          focus: { prox: 24 },
        },
        focus: { alpha: 0.45 },
        hooks: {
          drawClear: [behind], draw: [front],
          setCursor: [(u) => {
            const i = u.cursor.idx;
            shown(i == null ? null : data[0][i], data.slice(1).map((a) => (i == null ? null : a[i])));
            near(u);
          }],
          setScale: [(u, key) => { if (key === "x") spread(u); }],
        },
      };
      if (plot) plot.destroy();
      plot = new uPlot(options, [data[0], ...y], host);
      if (range) plot.setScale("x", range);
      timed.push({ plot, key: figure.x.text });
    }
    // the word of the event beside the cursor
    function near(u) {
      const { left } = u.cursor;
      const hit = left >= 0 && figure.strip.find(([from, to]) => {
        const [p, q] = [u.valToPos(from, "x"), u.valToPos(to, "x")];
        return left >= p - 5 && left <= q + 5;
      });
      tip.hidden = !hit;
      if (!hit) return;
      tip.textContent = `${hit[2]}: ${number(hit[0], 6)}`;
      tip.style.top = u.over.offsetTop + host.offsetTop + 6 + "px";
      const x = u.over.offsetLeft + left;
      // a long word never makes the page wider
      const beside = x > host.clientWidth / 2 ? x - tip.offsetWidth - 10 : x + 10;
      tip.style.left = Math.max(0, Math.min(host.clientWidth - tip.offsetWidth, beside)) + "px";
    }
    function spread(u) {
      const { min, max } = u.scales.x;
      if (min == null) return;
      range = { min, max };
      if (sharing) return;
      sharing = true;
      for (const other of timed) {
        if (other.plot !== u && other.key === figure.x.text && other.plot.root.isConnected) other.plot.setScale("x", { min, max });
      }
      // scales of the others are set in a later microtask: keep the guard until then
      setTimeout(() => { sharing = false; });
    }
    function move(i) {
      const n = data[0].length, k = Math.min(n - 1, Math.max(0, i));
      plot.setCursor({ left: plot.valToPos(data[0][k], "x"), top: plot.over.clientHeight / 2 }, true, true);
    }
    new ResizeObserver(() => { if (plot && host.clientWidth !== plot.width) plot.setSize({ width: host.clientWidth, height: 250 }); }).observe(host);
    build();
    return {
      draw() { for (let k = timed.length; k--;) if (timed[k].plot === plot) timed.splice(k, 1); build(); },
      reset() { range = null; const x = data[0]; plot.setScale("x", { min: x[0], max: x[x.length - 1] }); },
      toggle(i, on) { visible[i] = on; plot.setSeries(i + 1, { show: on }); },
      step(n) { move(plot.cursor.idx == null || plot.cursor.left < 0 ? 0 : plot.cursor.idx + n); },
      edge(end) { move(end ? data[0].length - 1 : 0); },
      log() { if (canLog) { log = !log; this.draw(); } return canLog ? log : null; },
      isLog: () => log,
    };
  }

  // ---- files and data
  function save(name, blob) {
    const a = element("a", { href: URL.createObjectURL(blob), download: name });
    document.body.append(a);
    a.click();
    a.remove();
    setTimeout(() => URL.revokeObjectURL(a.href), 10000);
  }
  const svgOf = (holder) => new XMLSerializer().serializeToString(holder.querySelector(".still svg"));
  function savePng(holder, name) {
    const svg = holder.querySelector(".still svg"), image = new Image();
    image.onload = () => {
      const canvas = element("canvas", { width: 2 * svg.getAttribute("width"), height: 2 * svg.getAttribute("height") });
      canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
      canvas.toBlob((blob) => save(name, blob), "image/png");
    };
    image.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(svgOf(holder));
  }
  const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  // curves of one length on shared abscissas side by side, others with an abscissa each
  function columns(figure) {
    const out = [];
    figure.series.forEach((s) => {
      if (s.x) out.push([figure.x.html, figure.x.text, s.x]);
      out.push([s.html + (s.unit ? ", " + s.unit : ""), s.name + (s.unit ? `, ${s.unit}` : ""), s.y]);
    });
    return out;
  }
  function saveCsv(figure) {
    const all = columns(figure), n = Math.max(...all.map((c) => c[2].length));
    const lines = [all.map((c) => quoted(c[1])).join(",")];
    for (let i = 0; i < n; i++) lines.push(all.map((c) => c[2][i] ?? "").join(","));
    save(figure.name + ".csv", new Blob([lines.join("\n") + "\n"], { type: "text/csv" }));
  }
  function table(figure) {
    const all = columns(figure), n = Math.max(...all.map((c) => c[2].length)), most = Math.min(n, 101);
    const body = element("tbody");
    for (let k = 0; k < most; k++) {
      const i = Math.round(k * (n - 1) / Math.max(1, most - 1));
      body.append(element("tr", {}, ...all.map((c) => element("td", { class: "n" }, number(c[2][i], 6)))));
    }
    const head = element("tr", {}, ...all.map((c) => element("th", { scope: "col", class: "n", html: c[0] })));
    return [
      element("div", { class: "table", tabindex: 0 }, element("table", {}, element("thead", {}, head), body)),
      element("p", { class: "lead" }, `${most} ${words.rows} ${n} `),
    ];
  }

  // ---- one instant everywhere: a cursor over time moves the dots in planes, a point in a plane moves the cursors over time
  const live = [], planes = [];
  let led = false;
  function follow(t, axis) {
    for (const p of planes) if (p.key === axis.text) p.chart.at(t);
    // moving pictures follow what is pointed at
    if (!led) document.dispatchEvent(new CustomEvent("strutt-instant", { detail: { clock: axis.name, t: t == null ? null : t * axis.size, from: "plot" } }));
  }
  document.addEventListener("strutt-instant", (e) => {
    if (e.detail.from === "plot") return;
    led = true;
    const axes = new Map();
    for (const l of live) for (const axis of [l.figure.x, l.figure.along]) if (axis && axis.name === e.detail.clock) axes.set(axis.text, axis);
    for (const [key, axis] of axes) {
      lead(e.detail.t / axis.size, key);
      for (const p of planes) if (p.key === key) p.chart.at(e.detail.t / axis.size);
    }
    led = false;
  });
  function lead(t, key) {
    for (const { plot, key: k } of timed) {
      if (k === key) plot.setCursor(t == null ? { left: -10, top: -10 } : { left: plot.valToPos(t, "x"), top: plot.over.clientHeight / 2 }, true, false);
    }
  }

  // what the curves are stands once: in the caption of a lone curve, at the first of figures side by side with the same curves
  const names = (figure) => figure.series.map((s) => s.name + "\u0000" + s.label).join("\u0001");
  function isTold(holder, figure) {
    const caption = holder.querySelector("figcaption").textContent.toLowerCase();
    if (figure.series.length === 1 && figure.series[0].label && caption.includes(figure.series[0].label.toLowerCase())) return true;
    const group = holder.closest(".figures"), all = group ? [...group.querySelectorAll("figure[data-figure]")] : [];
    return all.slice(0, all.indexOf(holder)).some((other) => names(page.figures[other.dataset.figure]) === names(figure));
  }

  // ---- one figure
  function bring(holder) {
    const figure = page.figures[holder.dataset.figure];
    if (!figure || !figure.series.some((s) => s.y.some((v) => v != null))) return;
    const host = holder.querySelector(".live"), tools = holder.querySelector(".tools"), data = holder.querySelector(".data");
    const where = element("li", { class: "where" }), outputs = [], buttons = [];
    const legend = element("ul", { class: "legend" });
    const stage = element("div"), tip = element("span", { class: "happening", hidden: "" });
    const brief = isTold(holder, figure);
    figure.series.forEach((s, i) => {
      const value = element("output");
      const button = element("button", { type: "button", "aria-pressed": "true" }, swatch(s), element("span", { html: s.html }), element("span", {}, s.label && !(brief && s.name) ? (s.name ? "– " : "") + s.label : ""), value);
      button.onclick = () => {
        const on = button.getAttribute("aria-pressed") === "false";
        button.setAttribute("aria-pressed", on);
        chart.toggle(i, on);
      };
      outputs.push(value); buttons.push(button);
      legend.append(element("li", {}, button));
    });
    legend.append(where);
    const unit = (axis) => (axis.unit ? (axis.unit === "°" ? "°" : "\u00a0" + axis.unit) : "");
    const summary = holder.querySelector(".summary");
    host.hidden = tools.hidden = data.hidden = false;
    holder.querySelector(".still").style.display = "none";
    host.tabIndex = 0;
    host.setAttribute("role", "group");
    host.setAttribute("aria-label", figure.title);
    host.setAttribute("aria-describedby", summary.id);
    host.title = words.help;
    host.append(legend, element("div", { class: "axis-y", html: figure.y.html }), stage, element("div", { class: "axis-x", html: figure.x.html }), tip);

    const chart = figure.plane
      ? Plane(stage, figure, look, format, (i, k) => {
          const s = figure.series[i];
          if (figure.along) lead(s ? s.t[k] : null, figure.along.text);
          const when = s && s.t ? `; ${figure.along.symbol} = ${number(s.t[k], 6)}${unit(figure.along)}` : "";
          where.innerHTML = s ? `(${number(s.x[k], 6)}${unit(figure.x)}; ${number(s.y[k], 6)}${unit(s)})${when}` : "";
          outputs.forEach((o, j) => { o.textContent = ""; buttons[j].style.fontWeight = s && j === i ? "bold" : ""; });
        })
      : Curves(stage, figure, (x, ys) => {
          follow(x, figure.x);
          where.innerHTML = x == null ? "" : `${figure.x.symbol} = ${number(x, 6)}${unit(figure.x)}`;
          outputs.forEach((o, i) => { o.textContent = ys[i] == null ? "" : "= " + number(ys[i], 6) + unit(figure.series[i]); });
        }, tip);

    if (figure.along) planes.push({ chart, key: figure.along.text });
    const tool = (name, action) => {
      const button = element("button", { type: "button" }, name);
      button.onclick = action;
      tools.append(button);
      return button;
    };
    tool(words.reset, () => chart.reset());
    const logButton = chart.log && tool(words.log, () => toLog());
    function toLog() {
      const on = chart.log();
      if (on === null) { logButton.disabled = true; logButton.title = words.noPositive; } else logButton.setAttribute("aria-pressed", on);
    }
    if (logButton) logButton.setAttribute("aria-pressed", chart.isLog());
    tool("SVG", () => save(figure.name + ".svg", new Blob([svgOf(holder)], { type: "image/svg+xml" })));
    tool("PNG", () => savePng(holder, figure.name + ".png"));
    tool("CSV", () => saveCsv(figure));
    data.addEventListener("toggle", () => { if (data.open && data.children.length === 1) data.append(...table(figure)); });
    host.addEventListener("keydown", (e) => {
      if (e.ctrlKey || e.altKey || e.metaKey || e.target.closest("button")) return;
      const step = e.shiftKey ? 10 : 1;
      const keys = {
        ArrowLeft: () => chart.step(-step), ArrowRight: () => chart.step(step), Home: () => chart.edge(false), End: () => chart.edge(true),
        Digit0: () => chart.reset(), Numpad0: () => chart.reset(), Escape: () => chart.reset(), KeyL: () => logButton && toLog(),
      };
      const act = keys[e.code] || keys[e.key];
      if (act) { e.preventDefault(); act(); }
    });
    host.addEventListener("dblclick", () => chart.reset());
    live.push({ chart, figure, repaint() { buttons.forEach((b, i) => b.querySelector("svg").replaceWith(swatch(figure.series[i]))); chart.draw(); } });
  }

  document.querySelectorAll("figure[data-figure]").forEach((holder) => {
    try { bring(holder); } catch (error) {
      // a picture that cannot be brought to life stays a picture
      console.error(error);
      holder.querySelector(".live").hidden = true;
      holder.querySelector(".still").style.display = "";
    }
  });

  // ---- dark and light
  const button = element("button", { type: "button", title: words.theme, "aria-label": words.theme }, "◐");
  button.onclick = () => {
    root.dataset.theme = isDark() ? "light" : "dark";
    live.forEach((l) => l.repaint());
  };
  // a work with a title page has no header
  document.querySelector("header, footer").append(button);
  dark.addEventListener("change", () => live.forEach((l) => l.repaint()));
})();
