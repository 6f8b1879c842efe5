// What is shown of the touches: the force, a table, a plot over time, the project and the errors.

class Readout {
  constructor(model) {
    this.model = model;
    this.history = [];  // [seconds, force]
    this.describe();
  }

  describe() {
    const {data} = this.model, errors = data.errors;
    element("name").textContent = data.name || "A body to touch";
    document.title = (data.name || "A body") + " – Palpa";
    const facts = {
      "Material": `${data.material.name}: E ${shortNumber(data.material.youngs_modulus_MPa)} MPa, ν ${data.material.poisson_ratio}`,
      "Mesh": `${data.model.nodes} nodes, ${data.model.triangles} triangles; drawn with ${this.model.vertexCount} vertices`,
      "Touch": `radius ${shortNumber(data.radius_mm)} mm, ${this.model.placeCount} places with their displacements`,
      "Error of the model": `${percent(errors.typical_model)} of a force at most places, ${percent(errors.model)} at the worst (estimates)`,
      "Error of this page": `${percent(errors.typical_force)} of the force of one touch at most places, ${percent(errors.force)} at ` +
          `the worst. Of the displacement that one touch causes at another, over its own: ${percent(errors.coupling[0])} nearer than two ` +
          `radii, ${percent(errors.coupling[1])} nearer than four, ${percent(errors.coupling[2])} beyond. Of drawn displacements at ` +
          `their worst vertex ${percent(errors.typical_field)}, beside supports ${percent(errors.field)}. One and a half times the ` +
          `largest of ${errors.samples} random places, against full solutions`,
      "Deformation": "true to scale; linear elasticity, small strain",
      "Written by": data.program
    };
    for (const [name, words] of Object.entries(facts)) {
      const dt = document.createElement("dt"), dd = document.createElement("dd");
      dt.textContent = name;
      dd.textContent = words;
      element("facts").append(dt, dd);
    }
  }

  // `most`: largest displacement of the colours, mm.
  show(touches, most) {
    const forces = touches.map((touch) => lengthOf(touch.force));
    const first = touches[touches.length - 1];
    element("total").textContent = first ? `${withError(lengthOf(first.force), first.error)} N` : "touch the body";
    this.remember(forces.length ? forces[forces.length - 1] : 0);
    this.showTable(touches);
    element("most").textContent = shortNumber(most) + " mm";
    this.plot();
    if (first) this.sayLater(element("total").textContent.replace("±", "plus or minus").replace(" N", " newtons"));
  }

  showTable(touches) {
    const table = element("touches"), body = table.tBodies[0];
    table.hidden = touches.length === 0;
    while (body.rows.length > touches.length) body.deleteRow(-1);
    while (body.rows.length < touches.length) {
      const row = body.insertRow();
      for (let k = 0; k < 4; ++k) row.insertCell();
    }
    touches.forEach((touch, k) => {
      const size = lengthOf(touch.force), decimals = decimalsFor(size, touch.error);
      const moved = lengthOf(this.model.displacementAt(touch.point, touches));
      const cells = [String(k + 1), withError(size, touch.error), touch.force.map((x) => withDecimals(x, decimals)).join(", "), shortNumber(moved)];
      cells.forEach((words, c) => { body.rows[k].cells[c].textContent = words; });
    });
  }

  remember(force) {
    const now = performance.now() / 1000;
    this.history.push([now, force]);
    while (this.history.length && this.history[0][0] < now - 10) this.history.shift();
  }

  plot() {
    const canvas = element("plot"), dense = window.devicePixelRatio || 1;
    const width = canvas.clientWidth, height = canvas.clientHeight;
    canvas.width = width * dense;
    canvas.height = height * dense;
    const pen = canvas.getContext("2d"), style = getComputedStyle(document.documentElement);
    const colour = (name) => style.getPropertyValue(name);
    pen.scale(dense, dense);
    const most = roundedUp(Math.max(1e-9, ...this.history.map((each) => each[1])));
    const left = 4, bottom = height - 16, top = 14;
    pen.strokeStyle = colour("--line");
    pen.strokeRect(left + 0.5, top + 0.5, width - left - 5, bottom - top);
    pen.fillStyle = colour("--faint");
    pen.font = "12px system-ui, sans-serif";
    pen.fillText(most > 1e-9 ? shortNumber(most) + " N" : "N", left, 11);
    pen.fillText("10 s ago", left, height - 3);
    pen.textAlign = "right";
    pen.fillText("now", width - 5, height - 3);
    const now = performance.now() / 1000;
    pen.strokeStyle = colour("--accent");
    pen.lineWidth = 2;
    pen.beginPath();
    for (const [time, force] of this.history)
      pen.lineTo(width - 5 - (width - left - 5) * (now - time) / 10, bottom - (bottom - top) * force / most);
    pen.stroke();
  }

  say(words) {
    clearTimeout(this.speech);
    this.speech = null;
    element("spoken").textContent = words;
  }

  // For screen readers: the force when it has been the same for a second.
  sayLater(words) {
    if (words === this.toSay) return;
    this.toSay = words;
    clearTimeout(this.speech);
    this.speech = setTimeout(() => { element("spoken").textContent = words; }, 1000);
  }
}

// Smallest 1, 2 or 5 times a power of ten that is not below a number.
function roundedUp(least) {
  if (!(least > 0)) return 0;
  const power = Math.pow(10, Math.floor(Math.log10(least)));
  return [1, 2, 5, 10].find((factor) => factor * power >= least * (1 - 1e-9)) * power;
}
