"use strict";
// Curves in a plane on a canvas: box zoom, reset, nearest point under the cursor. uPlot asks for a growing x, so this is our own.
// api: at(t) shows the instant t as a dot on each curve; draw(), reset(), step(n), edge(end), destroy(); calls `shown(i_series, i_point)` when the cursor moves.
function Plane(host, figure, look, format, shown) {
  const canvas = document.createElement("canvas");
  const box = document.createElement("div");
  canvas.className = "plane";
  box.className = "u-select";
  box.style.cssText = "position:absolute;pointer-events:none;display:none";
  host.append(canvas, box);
  const pad = { left: 64, right: 18, top: 8, bottom: 30 };
  const visible = figure.series.map(() => true);
  let width = 0, height = 0, view = null, spot = null, drag = null, moments = null;

  function whole() {
    let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
    for (const s of figure.series) for (let i = 0; i < s.y.length; i++) {
      if (s.x[i] == null || s.y[i] == null) continue;
      x0 = Math.min(x0, s.x[i]); x1 = Math.max(x1, s.x[i]);
      y0 = Math.min(y0, s.y[i]); y1 = Math.max(y1, s.y[i]);
    }
    if (x0 > x1) [x0, x1, y0, y1] = [0, 1, 0, 1];
    [x0, x1] = room(x0, x1); [y0, y1] = room(y0, y1);
    return { x0, x1, y0, y1 };
  }
  function room(a, b) {
    const extra = b > a ? 0.06 * (b - a) : 0.1 * Math.abs(a) || 1;
    return [a - extra, b + extra];
  }
  // one unit equally long in both directions
  function fitted(v) {
    if (!figure.equal) return v;
    const aspect = (width - pad.left - pad.right) / (height - pad.top - pad.bottom);
    const dx = v.x1 - v.x0, dy = v.y1 - v.y0;
    const grow = (a, b, span) => [(a + b - span) / 2, (a + b + span) / 2];
    if (dx < dy * aspect) { const [x0, x1] = grow(v.x0, v.x1, dy * aspect); return { ...v, x0, x1 }; }
    const [y0, y1] = grow(v.y0, v.y1, dx / aspect);
    return { ...v, y0, y1 };
  }
  const px = (x) => pad.left + (x - view.x0) / (view.x1 - view.x0) * (width - pad.left - pad.right);
  const py = (y) => height - pad.bottom - (y - view.y0) / (view.y1 - view.y0) * (height - pad.top - pad.bottom);
  const ux = (p) => view.x0 + (p - pad.left) / (width - pad.left - pad.right) * (view.x1 - view.x0);
  const uy = (p) => view.y0 + (height - pad.bottom - p) / (height - pad.top - pad.bottom) * (view.y1 - view.y0);

  function ticks(a, b, wanted) {
    const raw = (b - a) / wanted, base = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map((m) => m * base).find((s) => s >= raw * 0.999);
    const out = [];
    for (let k = Math.ceil(a / step - 1e-9); k * step <= b + 1e-9 * step && out.length < 50; k++) out.push(k * step);
    return [out, step];
  }

  function draw() {
    const ratio = window.devicePixelRatio || 1;
    width = host.clientWidth;
    height = Math.min(440, Math.max(300, width * 0.62));
    canvas.width = width * ratio; canvas.height = height * ratio;
    canvas.style.width = width + "px"; canvas.style.height = height + "px";
    if (!view) view = fitted(whole());
    const c = canvas.getContext("2d"), theme = look();
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.font = "12px 'DejaVu Sans', Verdana, 'Segoe UI', Arial, sans-serif";
    const [left, right, top, bottom] = [pad.left, width - pad.right, pad.top, height - pad.bottom];
    c.lineWidth = 1;
    c.fillStyle = theme.ink;
    const [xs, dx] = ticks(view.x0, view.x1, 7), [ys, dy] = ticks(view.y0, view.y1, 6);
    c.strokeStyle = theme.faint;
    c.beginPath();
    c.textAlign = "center"; c.textBaseline = "top";
    for (const x of xs) { c.moveTo(px(x), top); c.lineTo(px(x), bottom); c.fillText(format.tick(x, dx), px(x), bottom + 7); }
    c.textAlign = "right"; c.textBaseline = "middle";
    for (const y of ys) { c.moveTo(left, py(y)); c.lineTo(right, py(y)); c.fillText(format.tick(y, dy), left - 8, py(y)); }
    c.stroke();
    c.strokeStyle = theme.ink;
    c.strokeRect(left, top, right - left, bottom - top);
    c.save();
    c.beginPath(); c.rect(left, top, right - left, bottom - top); c.clip();
    c.lineJoin = "round"; c.lineWidth = 1.6;
    figure.series.forEach((s, i) => {
      if (!visible[i]) return;
      c.strokeStyle = c.fillStyle = s.colour[theme.dark ? 1 : 0];
      if (s.dots) {
        const radius = s.y.length > 200 ? 1.6 : 3;
        for (let k = 0; k < s.y.length; k++) if (s.x[k] != null && s.y[k] != null) { c.beginPath(); c.arc(px(s.x[k]), py(s.y[k]), radius, 0, 7); c.fill(); }
        return;
      }
      c.setLineDash(s.dash);
      c.beginPath();
      let pen = false;
      for (let k = 0; k < s.y.length; k++) {
        if (s.x[k] == null || s.y[k] == null) { pen = false; continue; }
        pen ? c.lineTo(px(s.x[k]), py(s.y[k])) : c.moveTo(px(s.x[k]), py(s.y[k]));
        pen = true;
      }
      c.stroke();
    });
    c.setLineDash([]);
    c.fillStyle = theme.ink;
    c.textBaseline = "bottom";
    for (const [x, y, words] of figure.marks) {
      if (x == null || y == null) {
        c.strokeStyle = theme.soft; c.setLineDash([3, 3]); c.beginPath();
        x == null ? (c.moveTo(left, py(y)), c.lineTo(right, py(y))) : (c.moveTo(px(x), top), c.lineTo(px(x), bottom));
        c.stroke(); c.setLineDash([]);
      } else { c.beginPath(); c.arc(px(x), py(y), 3.5, 0, 7); c.fill(); }
      // words stay inside: left of a point in the right half
      const at = x == null ? left : px(x), end = at > (left + right) / 2;
      c.textAlign = end ? "right" : "left";
      c.fillText(words, at + (end ? -6 : 6), (y == null ? top + 18 : py(y)) - 4);
    }
    if (moments) moments.forEach((k, i) => {
      const s = figure.series[i];
      if (!visible[i] || s.x[k] == null || s.y[k] == null) return;
      c.beginPath(); c.arc(px(s.x[k]), py(s.y[k]), 5, 0, 7);
      c.fillStyle = s.colour[theme.dark ? 1 : 0]; c.fill();
      c.strokeStyle = theme.ground; c.lineWidth = 1.5; c.stroke();
    });
    if (spot) {
      const s = figure.series[spot[0]];
      c.beginPath(); c.arc(px(s.x[spot[1]]), py(s.y[spot[1]]), 4.5, 0, 7);
      c.fillStyle = theme.ground; c.fill();
      c.strokeStyle = s.colour[theme.dark ? 1 : 0]; c.lineWidth = 2; c.stroke();
    }
    c.restore();
  }
  function point(to) { spot = to; draw(); shown(...(to || [-1, -1])); }
  function at(t) {
    moments = t == null ? null : figure.series.map((s) => {
      let a = 0, b = s.t.length - 1;
      while (b - a > 1) { const m = (a + b) >> 1; s.t[m] <= t ? (a = m) : (b = m); }
      return t - s.t[a] < s.t[b] - t ? a : b;
    });
    draw();
  }
  function nearest(mx, my) {
    let best = null, least = Infinity;
    figure.series.forEach((s, i) => {
      if (!visible[i]) return;
      for (let k = 0; k < s.y.length; k++) {
        if (s.x[k] == null || s.y[k] == null) continue;
        const d = (px(s.x[k]) - mx) ** 2 + (py(s.y[k]) - my) ** 2;
        if (d < least) { least = d; best = [i, k]; }
      }
    });
    return best;
  }
  function reset() { view = null; draw(); }
  function place(e) { const r = canvas.getBoundingClientRect(); return [e.clientX - r.left, e.clientY - r.top]; }

  canvas.addEventListener("pointerdown", (e) => { if (e.button === 0) { drag = place(e); canvas.setPointerCapture(e.pointerId); } });
  canvas.addEventListener("pointermove", (e) => {
    const [mx, my] = place(e);
    if (!drag) return point(nearest(mx, my));
    const [l, t] = [Math.min(mx, drag[0]), Math.min(my, drag[1])];
    box.style.display = "block";
    box.style.left = canvas.offsetLeft + l + "px"; box.style.top = canvas.offsetTop + t + "px";
    box.style.width = Math.abs(mx - drag[0]) + "px"; box.style.height = Math.abs(my - drag[1]) + "px";
  });
  canvas.addEventListener("pointerup", (e) => {
    if (!drag) return;
    const [mx, my] = place(e), [ax, ay] = drag;
    drag = null; box.style.display = "none";
    if (Math.abs(mx - ax) < 6 || Math.abs(my - ay) < 6) return;
    const [x0, x1] = [ux(Math.min(ax, mx)), ux(Math.max(ax, mx))], [y0, y1] = [uy(Math.max(ay, my)), uy(Math.min(ay, my))];
    view = fitted({ x0, x1, y0, y1 });
    draw();
  });
  canvas.addEventListener("pointercancel", () => { drag = null; box.style.display = "none"; });
  canvas.addEventListener("pointerleave", () => { if (!drag) point(null); });
  canvas.addEventListener("dblclick", reset);
  const watch = new ResizeObserver(() => { if (host.clientWidth !== width) reset(); });
  watch.observe(host);
  draw();
  return {
    draw, reset, at,
    toggle(i, on) { visible[i] = on; if (spot && !visible[spot[0]]) spot = null; draw(); },
    step(n) {
      const s = Math.max(0, spot ? spot[0] : visible.indexOf(true)), count = figure.series[s].y.length;
      let k = Math.min(count - 1, Math.max(0, spot ? spot[1] + n : 0));
      while (k > 0 && k < count - 1 && (figure.series[s].x[k] == null || figure.series[s].y[k] == null)) k += Math.sign(n) || 1;
      point([s, k]);
    },
    edge(end) { point([0, end ? figure.series[0].y.length - 1 : 0]); },
  };
}
