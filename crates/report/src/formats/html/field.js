"use strict";
// Places of filled planes: a click shows the values there and copies a command line with them. Arrow keys move the place once it is chosen.
(() => {
  const digits = 7;
  for (const figure of document.querySelectorAll("figure[data-field]")) {
    const data = JSON.parse(figure.dataset.field);
    const [left, top, right, bottom, width, height] = data.area;
    const picture = figure.querySelector(".still svg"), said = figure.querySelector(".picked"), help = figure.querySelector(".pick");
    if (!picture || !said) continue;
    help.hidden = false;
    picture.style.cursor = "crosshair";
    picture.tabIndex = 0;
    const mark = document.createElementNS("http://www.w3.org/2000/svg", "path");
    mark.setAttribute("fill", "none");
    mark.setAttribute("stroke", "#000");
    mark.setAttribute("stroke-width", "1.5");
    let place = null;
    const number = (v) => String(+v.toPrecision(digits));
    function show(copying) {
      const value = (k, share) => number(data.ends[k][0] + share * (data.ends[k][1] - data.ends[k][0]));
      const values = [value(0, place[0]), value(1, place[1])];
      const written = values.map((v, k) => `${data.names[k]}=${v}${data.units[k] ? " " + data.units[k] : ""}`);
      const x = left + place[0] * (right - left), y = bottom - place[1] * (bottom - top);
      mark.setAttribute("d", `M${x - 7} ${y}H${x + 7}M${x} ${y - 7}V${y + 7}`);
      picture.append(mark);
      const command = data.command && `${data.command} ${written.map((text) => `--set "${text}"`).join(" ")}`;
      said.hidden = false;
      said.textContent = command || written.join(", ");
      if (copying && command) copy(command);
    }
    function copy(text) {
      const done = () => { said.textContent = `${text}  (${data.copied})`; };
      const old = () => {
        // files opened from a disk may have no clipboard of the newer kind
        const area = document.createElement("textarea");
        area.value = text;
        document.body.append(area);
        area.select();
        const copied = document.execCommand("copy");
        area.remove();
        if (copied) done();
      };
      navigator.clipboard ? navigator.clipboard.writeText(text).then(done, old) : old();
    }
    const inside = (share) => Math.min(1, Math.max(0, share));
    picture.addEventListener("click", (event) => {
      const box = picture.getBoundingClientRect();
      const x = ((event.clientX - box.left) / box.width) * width, y = ((event.clientY - box.top) / box.height) * height;
      if (x < left - 2 || x > right + 2 || y < top - 2 || y > bottom + 2) return;
      place = [inside((x - left) / (right - left)), inside((bottom - y) / (bottom - top))];
      show(true);
    });
    picture.addEventListener("keydown", (event) => {
      const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!steps && event.key !== "Enter") return;
      place = place || [0.5, 0.5];
      if (steps) place = place.map((share, k) => inside(share + steps[k] / 200));
      show(event.key === "Enter");
      event.preventDefault();
    });
  }
})();
