// The page: touches by mouse, finger and keyboard, and what is shown of them.

const element = (id) => document.getElementById(id);

class Page {
  constructor(model) {
    this.model = model;
    this.touches = [];          // {point, displacement or depth, force, error, pointer}
    this.pointers = new Map();  // of the pointers on the background: [x, y]
    this.readout = new Readout(model);
    this.canvas = element("view");
    try {
      this.view = new View(this.canvas, model);
    } catch (error) {
      element("notice").textContent = error.message;
      element("notice").hidden = false;
    }
    if (this.view) this.view.most = roundedUp(model.radius / 2);
    this.showDepth();
    this.listen();
    this.update();
  }

  listen() {
    const canvas = this.canvas;
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (event) => this.up(event));
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.changeView(() => this.view.zoomBy(Math.exp(-0.0015 * event.deltaY), ...this.pixelOf(event)));
    }, {passive: false});
    canvas.addEventListener("keydown", (event) => this.key(event));
    element("release").addEventListener("click", () => this.releaseAll());
    element("home").addEventListener("click", () => this.changeView(() => this.view.home()));
    element("depth").addEventListener("input", () => {
      this.showDepth();
      for (const touch of this.touches) if (touch.depth !== undefined) touch.depth = this.depth();
      this.update();
    });
    for (const radio of document.querySelectorAll("input[name=kind]")) radio.addEventListener("change", () => this.showDepth());
    window.addEventListener("resize", () => this.update());
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.update());
  }

  kind() {
    return document.querySelector("input[name=kind]:checked").value;
  }

  // mm, of a press: up to the radius of the touch.
  depth() {
    return element("depth").value * this.model.radius;
  }

  showDepth() {
    element("depthText").textContent = shortNumber(this.depth()) + " mm";
    element("depthRow").hidden = this.kind() !== "press";
    element("depthRow").style.display = this.kind() === "press" ? "" : "none";
  }

  // Pixels from the middle of the canvas, y upwards.
  pixelOf(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left - box.width / 2, box.top + box.height / 2 - event.clientY];
  }

  changeView(change) {
    if (!this.view) return;
    change();
    this.update();
  }

  // Begins a touch under a pixel; null beside the body and on supports.
  touchAt(x, y) {
    const found = this.view && this.view.pick(x, y, this.kind() === "press");
    if (!found) return null;
    if (!this.model.touchable[found.triangle]) {
      this.readout.say("A support holds the body here.");
      return null;
    }
    if (!element("hold").checked) this.touches = this.touches.filter((touch) => touch.pointer !== null);
    const point = this.model.prepare(found);
    const touch = {point, pointer: null, force: [0, 0, 0], error: 0};
    if (this.kind() === "press") {
      touch.depth = this.depth();
    } else {
      touch.start = this.model.displacementAt(point, this.touches);
      touch.displacement = touch.start;
    }
    this.touches.push(touch);
    return touch;
  }

  down(event) {
    this.canvas.classList.add("pointed");  // no frame around what is touched by mouse or finger
    this.canvas.focus({preventScroll: true});
    this.canvas.setPointerCapture(event.pointerId);
    const pixel = this.pixelOf(event);
    const touch = event.button === 0 && this.pointers.size === 0 ? this.touchAt(...pixel) : null;
    if (touch) {
      touch.pointer = event.pointerId;
      touch.from = pixel;
      this.update();
    } else {
      this.pointers.set(event.pointerId, pixel);
    }
    event.preventDefault();
  }

  move(event) {
    const pixel = this.pixelOf(event);
    const touch = this.touches.find((each) => each.pointer === event.pointerId);
    if (touch) {
      this.moveTouch(touch, pixel);
      this.update();
    } else if (this.pointers.has(event.pointerId)) {
      this.moveView(event.pointerId, pixel, event.shiftKey || (event.buttons & 4) !== 0);
    }
  }

  moveTouch(touch, pixel) {
    if (touch.depth === undefined) {
      const [right, top] = this.view.axes(), scale = 1 / this.view.pixelsPerLength();
      const by = add(times(right, (pixel[0] - touch.from[0]) * scale), times(top, (pixel[1] - touch.from[1]) * scale));
      touch.displacement = add(touch.start, by);
    } else {
      const found = this.view.pick(...pixel, true);
      if (found && this.model.touchable[found.triangle]) touch.point = this.model.prepare(found);
    }
  }

  // One pointer turns (with Shift: shifts) the view, two zoom and shift it.
  moveView(pointer, pixel, shifts) {
    const before = this.pointers.get(pointer);
    const other = [...this.pointers].find(([id]) => id !== pointer);
    this.pointers.set(pointer, pixel);
    this.changeView(() => {
      const [dx, dy] = [pixel[0] - before[0], pixel[1] - before[1]];
      if (other) {
        const to = other[1], distance = (a) => Math.max(10, Math.hypot(a[0] - to[0], a[1] - to[1]));
        this.view.zoomBy(distance(pixel) / distance(before), to[0], to[1]);
        this.view.shift = add([...this.view.shift, 0], [dx / 2, dy / 2, 0]).slice(0, 2);
      } else if (shifts) {
        this.view.shift = [this.view.shift[0] + dx, this.view.shift[1] + dy];
      } else {
        this.view.turnBy(dx, dy);
      }
    });
  }

  up(event) {
    this.pointers.delete(event.pointerId);
    const touch = this.touches.find((each) => each.pointer === event.pointerId);
    if (!touch) return;
    touch.pointer = null;
    if (!element("hold").checked) this.touches = this.touches.filter((each) => each !== touch);
    this.update();
  }

  releaseAll() {
    this.touches = [];
    this.keyTouch = null;
    this.update();
    this.readout.say("All touches are released.");
  }

  key(event) {
    this.canvas.classList.remove("pointed");
    if (!this.view || event.ctrlKey || event.altKey || event.metaKey) return;
    const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    const touch = this.touches.includes(this.keyTouch) ? this.keyTouch : null;
    if (arrows[event.key]) {
      const [x, y] = arrows[event.key];
      if (touch) this.moveByKey(touch, x, y, 0);
      else this.view.turnBy(10 * x, 10 * y);
    } else if (touch && (event.key === "PageDown" || event.key === "PageUp")) {
      this.moveByKey(touch, 0, 0, event.key === "PageDown" ? 1 : -1);
    } else if (event.key === "Enter" || event.key === " ") {
      this.touchByKey();
    } else if (event.key === "Escape") {
      this.releaseAll();
    } else if (event.key === "+" || event.key === "=" || event.key === "-") {
      this.view.zoomBy(event.key === "-" ? 1 / 1.15 : 1.15);
    } else if (event.key === "Home") {
      this.view.home();
    } else {
      return;
    }
    event.preventDefault();
    this.update();
  }

  touchByKey() {
    this.keyTouch = this.touchAt(0, 0);
    if (!this.keyTouch) this.readout.say("The middle of the view is beside the body or on a support.");
  }

  // Steps of a grab: a twentieth of the radius along the window, or along the normal into the body. A press goes to
  // another place, a fifth of the radius away, or deeper.
  moveByKey(touch, x, y, inwards) {
    const step = this.model.radius / 20, [right, top] = this.view.axes();
    const along = add(times(right, x), times(top, y));
    if (touch.depth === undefined) {
      touch.displacement = add(touch.displacement, add(times(along, step), times(touch.point.normal, -inwards * step)));
    } else if (inwards !== 0) {
      touch.depth = Math.min(this.model.radius, Math.max(0, touch.depth + inwards * step));
    } else {
      const found = this.model.nearest(add(touch.point.position, times(along, 4 * step)));
      if (found) touch.point = this.model.prepare(found);
    }
  }

  // Computes and draws once before the next frame.
  update() {
    if (this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => {
      this.isWaiting = false;
      this.compute();
      this.readout.show(this.touches, this.view ? this.view.most : 0);
      // The plot moves on while there is a force in it.
      if (this.readout.history.some((each) => each[1] > 0)) this.update();
    });
  }

  compute() {
    this.model.solve(this.touches);
    const u = this.model.deform(this.touches);
    if (!this.view) return;
    this.view.setShape(u);
    // The colours keep their range while the displacements fit and at rest, and grow with them.
    const {largest, most} = this.view;
    if (largest > most || (largest > 0 && largest < most / 6)) this.view.most = roundedUp(Math.max(this.model.radius / 100, largest));
    this.view.draw();
  }
}

const page = new Page(new Model(JSON.parse(element("data").textContent), element("bytes").textContent));
if (location.hash.startsWith("#selftest=")) selfTest(page, decodeURIComponent(location.hash.slice(10)));
