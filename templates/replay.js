// Draws the film packed by src/report/replay.rs: orbit with the pointer, zoom with the wheel, play. WebGL2 alone, no library.
"use strict";
(async () => {
  const box = document.getElementById("replay");
  const canvas = box.querySelector("canvas");
  const gl = canvas.getContext("webgl2", { antialias: true, alpha: false, preserveDrawingBuffer: true });
  if (!gl || typeof DecompressionStream === "undefined") return;

  // ---- unpack ----
  const head = JSON.parse(document.getElementById("replay-head").textContent);
  const packed = Uint8Array.from(atob(document.getElementById("replay-data").textContent.trim()), c => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const F = head.times.length, G = head.grains, N = head.nodes, R = head.ropes.length;
  let at = 0;
  const wide = count => {
    const size = F * count, values = new Uint16Array(size);
    for (let i = 0; i < size; i++) {
      const before = i >= count ? values[i - count] : 0, earlier = i >= 2 * count ? values[i - 2 * count] : 0;
      values[i] = bytes[at + i] + 256 * bytes[at + size + i] + 2 * before - earlier;
    }
    at += 2 * size;
    return values;
  };
  const narrow = count => {
    const size = F * count, values = new Uint8Array(size);
    for (let i = 0; i < size; i++) values[i] = bytes[at + i] + (i >= count ? values[i - count] : 0);
    at += size;
    return values;
  };
  const place = [wide(G), wide(G), wide(G)], node = [wide(N), wide(N), wide(N)];
  const axis = [narrow(G), narrow(G), narrow(G)], speed = narrow(G), force = narrow(G), tension = narrow(R);
  const metres = (value, k) => head.origin[k] + value / 65534 * head.extent;
  const signed = value => (value > 127 ? value - 256 : value) / 127;

  // ---- shaders ----
  const program = (vertex, fragment) => {
    const made = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, "#version 300 es\nprecision highp float;\n" + text);
      gl.compileShader(shader);
      gl.attachShader(made, shader);
    }
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
    return { made, place: name => gl.getUniformLocation(made, name) };
  };
  // Colours run from dark blue over green to yellow, evenly in lightness, so that they survive grey printing.
  const ramp = "vec3 ramp(float x) { return mix(mix(vec3(.16,.22,.45), vec3(.12,.56,.55), min(x*2.,1.)), vec3(.99,.85,.25), max(x*2.-1.,0.)); }\n";
  const balls = program(`uniform mat4 view, lens; uniform float tall;
    in vec4 ball; in float value; out vec3 centre; out float radius, tint;
    void main() { vec4 seen = view * vec4(ball.xyz, 1.); centre = seen.xyz; radius = ball.w; tint = value;
      gl_Position = lens * seen; gl_PointSize = ball.w * lens[1][1] * tall / gl_Position.w * 1.02; }`,
  ramp + `uniform mat4 lens; in vec3 centre; in float radius, tint; out vec4 colour;
    void main() { vec2 at = gl_PointCoord * 2. - 1.; at.y = -at.y; float inside = 1. - dot(at, at);
      if (inside < 0.) discard;
      vec3 normal = vec3(at, sqrt(inside)); vec4 hit = lens * vec4(centre + normal * radius, 1.);
      gl_FragDepth = .5 * hit.z / hit.w + .5;
      colour = vec4(ramp(tint) * (.45 + .55 * max(dot(normal, normalize(vec3(.4,.7,.6))), 0.)), 1.); }`);
  const ropes = program(`uniform mat4 view, lens; uniform vec2 screen;
    in vec3 from, to; in vec2 rope; out float tint;
    void main() { vec4 a = lens * view * vec4(from, 1.), b = lens * view * vec4(to, 1.);
      vec2 way = normalize((b.xy / b.w - a.xy / a.w) * screen + 1e-6);
      bool end = (gl_VertexID & 1) == 1; float side = (gl_VertexID & 2) == 2 ? 1. : -1.; vec4 here = end ? b : a;
      here.xy += vec2(-way.y, way.x) * side * rope.y / screen * here.w; tint = rope.x; gl_Position = here; }`,
  ramp + `in float tint; out vec4 colour; void main() { colour = vec4(mix(vec3(.1), mix(vec3(.85,.3,.1), vec3(1.,.1,.35), tint), min(tint * 3., 1.)), 1.); }`);
  const planes = program(`uniform mat4 view, lens; in vec3 corner; void main() { gl_Position = lens * view * vec4(corner, 1.); }`,
    `uniform vec4 paint; out vec4 colour; void main() { colour = paint; }`);

  // ---- buffers ----
  const paired = head.looks.map(look => look[1] > 0 ? 2 : 1), B = paired.reduce((sum, one) => sum + one, 0);
  const ballData = new Float32Array(B * 5), ropeData = new Float32Array(R * 8);
  const attach = (of, stride, parts, divisor) => {
    const array = gl.createVertexArray(), buffer = gl.createBuffer();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    let offset = 0;
    for (const [name, size] of parts) {
      const index = gl.getAttribLocation(of.made, name);
      gl.enableVertexAttribArray(index);
      gl.vertexAttribPointer(index, size, gl.FLOAT, false, stride * 4, offset * 4);
      gl.vertexAttribDivisor(index, divisor);
      offset += size;
    }
    return { array, buffer };
  };
  const ballArray = attach(balls, 5, [["ball", 4], ["value", 1]], 0);
  const ropeArray = attach(ropes, 8, [["from", 3], ["to", 3], ["rope", 2]], 1);
  const w = head.width, back = head.origin[0], front = head.origin[0] + head.extent;
  const h = head.wall[1] || 0.08 * head.extent;
  const quad = (a, b, c, d) => [...a, ...b, ...c, ...a, ...c, ...d];
  const bed = quad([back, 0, 0], [front, 0, 0], [front, w, 0], [back, w, 0]);
  // Flat pieces of the ground, each as triangles about its first corner, with how level it is.
  const ground = head.ground.map(piece => {
    const [a, b, c] = piece, u = b.map((p, i) => p - a[i]), v = c.map((p, i) => p - a[i]);
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    return { corners: piece.slice(2).flatMap((p, i) => [...a, ...piece[i + 1], ...p]), level: Math.abs(n[2]) / Math.hypot(...n) };
  });
  const groundFirst = 24, groundCount = ground.reduce((sum, piece) => sum + piece.corners.length / 3, 0);
  const top = head.wall[0];
  const [right, left] = head.wall_ends;
  const wall = quad([0, right, 0], [0, left, 0], [top, left, h], [top, right, h]);
  const sides = [0, w].flatMap(y => quad([back, y, 0], [front, y, 0], [front, y, h], [back, y, h]));
  const planeArray = attach(planes, 3, [["corner", 3]], 0);
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([...bed, ...sides, ...wall, ...ground.flatMap(piece => piece.corners)]), gl.STATIC_DRAW);

  // ---- the moment shown ----
  const colourBy = box.querySelector("select"), slider = box.querySelector("input"), clock = box.querySelector("output");
  const key = box.querySelector(".key");
  const show = moment => {
    const x = moment * (F - 1), f = Math.min(Math.floor(x), F - 2), t = x - f;
    const p = f * G, q = p + G, values = colourBy.value === "force" ? force : speed;
    let o = 0;
    for (let g = 0; g < G; g++) {
      const gone = place[0][p + g] === 65535 || place[0][q + g] === 65535;
      const [radius, offset] = head.looks[g];
      for (let s = 0; s < paired[g]; s++) {
        const side = paired[g] === 1 ? 0 : (s ? 1 : -1) * offset / 1000;
        for (let k = 0; k < 3; k++) {
          const a = metres(place[k][p + g], k) + side * signed(axis[k][p + g]);
          ballData[o + k] = a + t * (metres(place[k][q + g], k) + side * signed(axis[k][q + g]) - a);
        }
        ballData[o + 3] = gone ? 0 : radius / 1000;
        const level = (values[p + g] + t * (values[q + g] - values[p + g])) / 255;
        ballData[o + 4] = colourBy.value === "force" ? Math.sqrt(level) : level;
        o += 5;
      }
    }
    head.ropes.forEach(([a, b, kind], r) => {
      const n = f * N, m = n + N;
      for (let k = 0; k < 3; k++) {
        const from = metres(node[k][n + a], k), to = metres(node[k][n + b], k);
        ropeData[8 * r + k] = from + t * (metres(node[k][m + a], k) - from);
        ropeData[8 * r + 3 + k] = to + t * (metres(node[k][m + b], k) - to);
      }
      ropeData[8 * r + 6] = (tension[f * R + r] + t * (tension[(f + 1) * R + r] - tension[f * R + r])) / 255;
      ropeData[8 * r + 7] = head.widths[kind];
    });
    const time = head.times[f] + t * (head.times[f + 1] - head.times[f]);
    clock.textContent = time.toFixed(2) + " s";
    slider.value = Math.round(1000 * moment);
    draw();
  };
  const most = () => {
    const round = value => Number(value.toPrecision(2)).toString();
    const [value, unit] = colourBy.value === "force" ? [head.force / 1000, "kN"] : [head.speed, "m/s"];
    key.textContent = `grains: dark 0, light ${round(value)} ${unit}`
      + (R ? `; ropes: black slack, red ${round(head.tension / 1000)} kN` : "");
  };

  // ---- camera ----
  const eye = { turn: -0.9, rise: 0.45, far: Math.min(0.75 * head.extent, 1.9 * w), at: [-0.1 * w, w / 2, 0.15 * w] };
  const times = (a, b) => {
    const c = new Float32Array(16);
    for (let i = 0; i < 4; i++) for (let j = 0; j < 4; j++) for (let k = 0; k < 4; k++) c[4 * i + j] += a[4 * k + j] * b[4 * i + k];
    return c;
  };
  const draw = () => {
    const dense = window.devicePixelRatio || 1, wide = Math.round(canvas.clientWidth * dense), tall = Math.round(canvas.clientHeight * dense);
    if (canvas.width !== wide || canvas.height !== tall) { canvas.width = wide; canvas.height = tall; }
    gl.viewport(0, 0, wide, tall);
    gl.clearColor(0.96, 0.97, 0.98, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    // The scene stands on its slope: turned about the channel's y axis, then seen from around.
    const cs = Math.cos(head.slope), sn = Math.sin(head.slope), [x0, y0, z0] = eye.at;
    const slope = new Float32Array([cs, 0, -sn, 0, 0, 1, 0, 0, sn, 0, cs, 0, -cs * x0 - sn * z0, -y0, sn * x0 - cs * z0, 1]);
    const ct = Math.cos(eye.turn), st = Math.sin(eye.turn), cr = Math.cos(eye.rise), sr = Math.sin(eye.rise);
    const look = new Float32Array([-st, -ct * sr, ct * cr, 0, ct, -st * sr, st * cr, 0, 0, cr, sr, 0, 0, 0, -eye.far, 1]);
    const view = times(look, slope), close = 0.02 * eye.far, distant = eye.far + 3 * head.extent, zoom = 1.9;
    const lens = new Float32Array([zoom * tall / wide, 0, 0, 0, 0, zoom, 0, 0, 0, 0, -(distant + close) / (distant - close), -1, 0, 0, -2 * distant * close / (distant - close), 0]);
    const use = of => { gl.useProgram(of.made); gl.uniformMatrix4fv(of.place("view"), false, view); gl.uniformMatrix4fv(of.place("lens"), false, lens); };
    use(planes);
    gl.bindVertexArray(planeArray.array);
    gl.uniform4f(planes.place("paint"), 0.82, 0.80, 0.76, 1);
    if (!ground.length) gl.drawArrays(gl.TRIANGLES, 0, 6);
    // Seen from below, the ground is but a veil: it would hide the flow.
    gl.enable(gl.CULL_FACE);
    ground.reduce((first, { corners, level }) => {
      // The steeper a piece, the darker.
      const shade = 0.7 + 0.3 * level;
      gl.uniform4f(planes.place("paint"), 0.82 * shade, 0.80 * shade, 0.76 * shade, 1);
      gl.drawArrays(gl.TRIANGLES, first, corners.length / 3);
      return first + corners.length / 3;
    }, groundFirst);
    gl.disable(gl.CULL_FACE);
    if (head.wall[1]) { gl.uniform4f(planes.place("paint"), 0.55, 0.57, 0.6, 1); gl.drawArrays(gl.TRIANGLES, 18, 6); }
    use(balls);
    gl.uniform1f(balls.place("tall"), tall);
    gl.bindVertexArray(ballArray.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, ballArray.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, ballData, gl.DYNAMIC_DRAW);
    gl.drawArrays(gl.POINTS, 0, B);
    if (R) {
      use(ropes);
      gl.uniform2f(ropes.place("screen"), wide / 2, tall / 2);
      gl.bindVertexArray(ropeArray.array);
      gl.bindBuffer(gl.ARRAY_BUFFER, ropeArray.buffer);
      gl.bufferData(gl.ARRAY_BUFFER, ropeData, gl.DYNAMIC_DRAW);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, R);
    }
    use(planes);
    gl.bindVertexArray(planeArray.array);
    gl.enable(gl.BLEND); gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA); gl.depthMask(false);
    gl.uniform4f(planes.place("paint"), 0.4, 0.45, 0.5, 0.12);
    if (ground.length) gl.drawArrays(gl.TRIANGLES, groundFirst, groundCount);
    else gl.drawArrays(gl.TRIANGLES, 6, 12);
    gl.depthMask(true); gl.disable(gl.BLEND);
  };

  // ---- controls ----
  const button = box.querySelector("button");
  let moment = 0, playing = false, last = 0;
  const length = (head.times[F - 1] - head.times[0]) * 1000;
  const tick = now => {
    if (!playing) return;
    moment += (now - last) / length;
    last = now;
    if (moment >= 1) { moment = 1; stop(); }
    show(moment);
    requestAnimationFrame(tick);
  };
  const stop = () => { playing = false; button.textContent = "Play"; };
  button.onclick = () => {
    if (playing) return stop();
    if (moment >= 1) moment = 0;
    playing = true; last = performance.now(); button.textContent = "Pause";
    requestAnimationFrame(tick);
  };
  slider.oninput = () => { stop(); moment = slider.value / 1000; show(moment); };
  colourBy.onchange = () => { most(); show(moment); };
  canvas.onpointerdown = event => canvas.setPointerCapture(event.pointerId);
  canvas.onpointermove = event => {
    if (!event.buttons) return;
    eye.turn -= event.movementX * 0.008;
    eye.rise = Math.max(-0.2, Math.min(1.5, eye.rise + event.movementY * 0.008));
    draw();
  };
  canvas.addEventListener("wheel", event => { event.preventDefault(); eye.far *= Math.exp(event.deltaY * 0.001); draw(); }, { passive: false });
  canvas.onkeydown = event => {
    const turns = { ArrowLeft: ["turn", 0.1], ArrowRight: ["turn", -0.1], ArrowUp: ["rise", 0.1], ArrowDown: ["rise", -0.1] };
    if (turns[event.key]) { eye[turns[event.key][0]] += turns[event.key][1]; draw(); event.preventDefault(); }
    if (event.key === " ") { button.click(); event.preventDefault(); }
  };
  new ResizeObserver(draw).observe(canvas);
  box.hidden = false;
  most();
  // The moment of the largest force says most of a page that nobody plays.
  moment = 0.5;
  show(moment);
})();
