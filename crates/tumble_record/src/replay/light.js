// Triangles in light and shadow, by WebGL 2.

const SHADOW_POINTS = 2048;

const SOLID_VERTEX = `#version 300 es
in vec3 position; in vec3 normal; in float shade;
uniform mat4 camera; uniform mat4 sun; uniform vec3 place; uniform vec4 turn;
out vec3 world; out vec3 outward; out float bright; out vec3 onMap;
vec3 turned(vec3 v) { return v + 2. * cross(turn.xyz, cross(turn.xyz, v) + turn.w * v); }
void main() {
  world = place + turned(position);
  outward = turned(normal);
  bright = shade;
  onMap = (sun * vec4(world, 1.)).xyz * .5 + .5;
  gl_Position = camera * vec4(world, 1.);
}`;

const SOLID_FRAGMENT = `#version 300 es
precision highp float; precision highp sampler2DShadow;
in vec3 world; in vec3 outward; in float bright; in vec3 onMap;
uniform vec3 eye; uniform vec3 up; uniform vec3 toSun; uniform vec3 color; uniform float opacity;
uniform vec3 haze; uniform float size; uniform float ground; uniform float glow; uniform sampler2DShadow shadows;
out vec4 result;
float open(float slack) {
  if (any(lessThan(onMap.xy, vec2(0.))) || any(greaterThan(onMap.xy, vec2(1.)))) return 1.;
  float sum = 0.;
  for (int i = -2; i <= 2; i++) for (int j = -2; j <= 2; j++)
    sum += texture(shadows, vec3(onMap.xy + vec2(i, j) * 1.1 / ${SHADOW_POINTS}., onMap.z - slack));
  return sum / 25.;
}
void main() {
  vec3 towards = normalize(eye - world), n = normalize(outward);
  if (dot(n, towards) < 0.) n = -n;
  float slope = dot(n, toSun);
  float lit = slope > 0. ? open(.0012 + .0025 * (1. - slope)) : 0.;
  float direct = max(slope, 0.) * lit, around = .5 + .5 * dot(n, up);
  vec3 base = color * bright;
  float fog = 0., gloss = 0.;
  if (ground > .5) {
    // A faint board, to tell distances by; far away its fields run together.
    vec3 right = normalize(abs(n.x) < .9 ? vec3(1, 0, 0) - n * n.x : vec3(0, 1, 0) - n * n.y);
    vec2 at = vec2(dot(world, right), dot(world, cross(right, n))) * 10. / size;
    vec2 wave = fract(at * .5) - .5, width = max(fwidth(at), vec2(1e-4));
    vec2 side = clamp(wave / width * 2., -1., 1.) * clamp((.5 - abs(wave)) / width * 2., 0., 1.);
    base *= 1. - .022 * (1. + side.x * side.y * exp(-2. * max(width.x, width.y)));
    fog = clamp((length(world) / size - 1.) / 4., 0., 1.);
  } else {
    gloss = .14 * pow(max(dot(n, normalize(towards + toSun)), 0.), 28.) * lit;
  }
  vec3 linear = base * base * (.26 + .22 * around + .72 * direct) + gloss + glow * .25;
  result = vec4(mix(sqrt(linear), haze, fog), 1.) * opacity;
}`;

const SHADOW_FRAGMENT = `#version 300 es
precision mediump float; out vec4 result; void main() { result = vec4(1.); }`;

// Marks are discs that face the eye, a little nearer to it than what they mark, so that surfaces do not swallow them.
const MARK_VERTEX = `#version 300 es
in vec3 position;
uniform mat4 camera; uniform vec3 eye; uniform float size; uniform float pixels;
void main() {
  gl_Position = camera * vec4(position + normalize(eye - position) * .004 * size, 1.);
  gl_PointSize = pixels;
}`;

const MARK_FRAGMENT = `#version 300 es
precision mediump float;
uniform vec3 color; uniform vec3 rim; uniform float opacity;
out vec4 result;
void main() {
  float out_of_middle = 2. * length(gl_PointCoord - .5);
  if (out_of_middle > 1.) discard;
  result = vec4(out_of_middle > .7 ? rim : color, 1.) * opacity;
}`;

/** Draws meshes with one sun. */
class Light {
  /** A canvas below another one; without WebGL `works` is false. */
  constructor(above) {
    this.canvas = document.createElement("canvas");
    this.canvas.id = "light";
    above.before(this.canvas);
    const gl = this.gl = this.canvas.getContext("webgl2", { antialias: true, alpha: true, premultipliedAlpha: true });
    this.works = Boolean(gl);
    if (!gl) return;
    this.solid = this.program(SOLID_VERTEX, SOLID_FRAGMENT);
    this.shadow = this.program(SOLID_VERTEX, SHADOW_FRAGMENT);
    this.mark = this.program(MARK_VERTEX, MARK_FRAGMENT);
    this.marks = gl.createVertexArray();
    gl.bindVertexArray(this.marks);
    this.markPlaces = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.markPlaces);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    this.meshes = recording.stage.meshes.map((mesh) => this.upload(mesh));
    this.map = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.map);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, SHADOW_POINTS, SHADOW_POINTS);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.LINEAR);
    for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
    this.target = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.target);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, this.map, 0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.enable(gl.DEPTH_TEST);
  }

  program(vertex, fragment) {
    const { gl } = this, program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    ["position", "normal", "shade"].forEach((name, index) => gl.bindAttribLocation(program, index, name));
    gl.linkProgram(program);
    const places = new Map();
    const place = (name) => places.get(name) ?? (places.set(name, gl.getUniformLocation(program, name)), places.get(name));
    return { program, place };
  }

  upload({ corners, triangles, ground }) {
    const { gl } = this, array = gl.createVertexArray();
    gl.bindVertexArray(array);
    for (const [kind, data] of [[gl.ARRAY_BUFFER, corners], [gl.ELEMENT_ARRAY_BUFFER, triangles]]) {
      gl.bindBuffer(kind, gl.createBuffer());
      gl.bufferData(kind, data, gl.STATIC_DRAW);
    }
    [[3, 0], [3, 12], [1, 24]].forEach(([size, offset], index) => {
      gl.enableVertexAttribArray(index);
      gl.vertexAttribPointer(index, size, gl.FLOAT, false, 28, offset);
    });
    return { array, count: triangles.length, ground };
  }

  /** Draws items { mesh, place, turn, color, sensor, glow } and marks as a camera sees them. */
  draw(items, marks, { camera, eye, sun, toSun, up, size, haze }) {
    const { gl, canvas } = this, ratio = window.devicePixelRatio || 1;
    const width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const pass = ({ program, place }, matrix, chosen) => {
      gl.useProgram(program);
      gl.uniformMatrix4fv(place("camera"), false, matrix);
      gl.uniformMatrix4fv(place("sun"), false, sun);
      for (const [name, value] of Object.entries({ eye, up, toSun, haze })) gl.uniform3fv(place(name), value);
      gl.uniform1f(place("size"), size);
      for (const item of chosen) {
        const { array, count, ground } = this.meshes[item.mesh];
        gl.uniform3fv(place("place"), item.place);
        gl.uniform4fv(place("turn"), item.turn);
        gl.uniform3fv(place("color"), item.color);
        gl.uniform1f(place("opacity"), item.sensor ? .22 : 1);
        gl.uniform1f(place("glow"), item.glow ? 1 : 0);
        gl.uniform1f(place("ground"), ground ? 1 : 0);
        gl.bindVertexArray(array);
        gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 0);
      }
    };
    const solids = items.filter(({ sensor }) => !sensor);
    gl.bindTexture(gl.TEXTURE_2D, null);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.target);
    gl.viewport(0, 0, SHADOW_POINTS, SHADOW_POINTS);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    pass(this.shadow, sun, solids.filter(({ mesh }) => !this.meshes[mesh].ground));
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.bindTexture(gl.TEXTURE_2D, this.map);
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    pass(this.solid, camera, solids);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    pass(this.solid, camera, items.filter(({ sensor }) => sensor));
    this.drawMarks(marks, { camera, eye, size, pixels: 7 * ratio });
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  }

  /** Draws marks { places, color, rim }: those behind solids faintly. */
  drawMarks({ places, color, rim }, { camera, eye, size, pixels }) {
    if (places.length === 0) return;
    const { gl } = this, { program, place } = this.mark;
    gl.useProgram(program);
    gl.uniformMatrix4fv(place("camera"), false, camera);
    for (const [name, value] of Object.entries({ eye, color, rim })) gl.uniform3fv(place(name), value);
    for (const [name, value] of Object.entries({ size, pixels })) gl.uniform1f(place(name), value);
    gl.bindVertexArray(this.marks);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.markPlaces);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(places.flat()), gl.STREAM_DRAW);
    for (const [test, opacity] of [[gl.GREATER, .25], [gl.LEQUAL, 1]]) {
      gl.depthFunc(test);
      gl.uniform1f(place("opacity"), opacity);
      gl.drawArrays(gl.POINTS, 0, places.length);
    }
    gl.depthFunc(gl.LESS);
  }
}

