// For tests: page.html#selftest=JSON computes lists of simultaneous touches [{"at": [x, y, z], "displacement": [x, y, z]}]
// and writes the forces into an element; "frames" in the list also draws so many frames and measures them.
function selfTest(page, text) {
  const model = page.model;
  const request = JSON.parse(text);
  const results = request.touches.map((touches) => {
    const all = touches.map(({at, displacement}) => ({point: model.prepare(model.nearest(at)), displacement}));
    model.solve(all);
    return all.map(({point, force, error, pageError}) => ({at: point.position, force_N: force, error_N: error, page_error_N: pageError}));
  });
  const answer = {webgl: Boolean(page.view), results};
  if (request.frames && page.view) {
    page.canvas.style.height = page.canvas.clientHeight + "px";
    const from = performance.now();
    for (let k = 0; k < request.frames; ++k) {
      const angle = 0.1 * k, r = model.size;
      const at = add(model.middle, [r * Math.cos(angle), r * Math.sin(angle), 0.3 * r]);
      page.touches = [{point: model.prepare(model.nearest(at)), depth: model.radius / 2, pointer: 0}];
      page.compute();
      page.readout.show(page.touches, page.view.most);
      page.view.gl.readPixels(0, 0, 1, 1, page.view.gl.RGBA, page.view.gl.UNSIGNED_BYTE, new Uint8Array(4));
    }
    answer.frame_ms = (performance.now() - from) / request.frames;
    answer.canvas = [page.canvas.width, page.canvas.height];
  }
  const out = document.createElement("pre");
  out.id = "selftest";
  out.textContent = JSON.stringify(answer);
  document.body.append(out);
}
