// Draws a picture and its overlay: for every pixel of the screen the equations of sphere.js, in a fragment shader.

const VERTEX = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }`;

const FRAGMENT = `#version 300 es
precision highp float;
precision highp int;
uniform vec2 screen;       // device pixels
uniform mat3 toC;          // columns: axes of the screen in C
uniform float focal;       // device pixels; 0 = flat
uniform vec3 flatPlace;    // the picture's point in the middle of the screen, device pixels of one of its pixels
uniform vec2 size;         // of the picture
uniform bool wraps, hasColor, hasOverlay;
uniform sampler2D color, overlay;
out vec4 pixel;
const float PI = 3.14159265358979;
vec2 pointAt(vec2 at) {
  if (focal == 0.0) return flatPlace.xy + at / flatPlace.z;
  vec3 d = toC * vec3(at / focal, 1.0);
  // Some drivers' atan(y, x) is wrong for y = 0.
  float theta = d.x == 0.0 ? (d.z < 0.0 ? -PI : 0.0) : atan(d.x, d.z);
  float phi = d.y == 0.0 ? 0.0 : atan(-d.y, length(d.xz));
  return size * vec2(theta / (2.0 * PI) + 0.5, 0.5 - phi / PI);
}
void main() {
  vec2 at = vec2(gl_FragCoord.x, screen.y - gl_FragCoord.y) - 0.5 * screen;
  vec2 p = pointAt(at);
  pixel = vec4(0.07, 0.08, 0.1, 1);
  if (focal == 0.0 && (p.y < 0.0 || p.y >= size.y || (!wraps && (p.x < 0.0 || p.x >= size.x)))) return;
  vec3 seen = hasColor ? textureLod(color, p / size, 0.0).rgb : vec3(0);
  if (hasOverlay) {
    ivec2 whole = ivec2(size);
    ivec2 cell = ivec2(floor(p));
    cell.x = ((cell.x % whole.x) + whole.x) % whole.x;
    cell.y = clamp(cell.y, 0, whole.y - 1);
    vec4 over = texelFetch(overlay, cell, 0);
    seen = mix(seen, over.rgb, over.a);
  }
  pixel = vec4(seen, 1);
}`;

function compile(gl, kind, text) {
  const shader = gl.createShader(kind);
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
  return shader;
}

export class Painter {
  /// Error where the browser has no WebGL 2.
  constructor(canvas) {
    this.canvas = canvas;
    const gl = this.gl = canvas.getContext("webgl2", {alpha: false, antialias: false});
    if (!gl) throw new Error("this browser has no WebGL 2: switch hardware acceleration on, or use another browser");
    this.program = gl.createProgram();
    gl.attachShader(this.program, compile(gl, gl.VERTEX_SHADER, VERTEX));
    gl.attachShader(this.program, compile(gl, gl.FRAGMENT_SHADER, FRAGMENT));
    gl.linkProgram(this.program);
    gl.useProgram(this.program);
    this.at = name => gl.getUniformLocation(this.program, name);
    gl.bindVertexArray(gl.createVertexArray());
    gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
    this.color = this.texture(0, gl.LINEAR);
    this.overlay = this.texture(1, gl.NEAREST);
    gl.uniform1i(this.at("color"), 0);
    gl.uniform1i(this.at("overlay"), 1);
    this.hasColor = this.hasOverlay = false;
    this.size = [2, 1];
    this.mostSide = gl.getParameter(gl.MAX_TEXTURE_SIZE);
  }
  texture(unit, filter) {
    const gl = this.gl, texture = gl.createTexture();
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, filter);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, filter);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.REPEAT);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    return texture;
  }
  setColor(bitmap) {
    const gl = this.gl;
    this.hasColor = Boolean(bitmap);
    if (!bitmap) return;
    if (Math.max(bitmap.width, bitmap.height) > this.mostSide) throw new Error(`this browser draws pictures of at most ${this.mostSide} pixels a side`);
    this.size = [bitmap.width, bitmap.height];
    gl.activeTexture(gl.TEXTURE0);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
  }
  setOverlay(overlay) {
    const gl = this.gl;
    this.hasOverlay = Boolean(overlay);
    if (!overlay) return;
    if (!this.hasColor) this.size = [overlay.width, overlay.height];
    gl.activeTexture(gl.TEXTURE1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, overlay.width, overlay.height, 0, gl.RGBA, gl.UNSIGNED_BYTE, overlay.pixels);
  }
  draw(look, wraps) {
    const gl = this.gl, ratio = this.canvas.width / look.width, [w, h] = this.size;
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.uniform2f(this.at("screen"), this.canvas.width, this.canvas.height);
    gl.uniformMatrix3fv(this.at("toC"), true, look.matrix());
    gl.uniform1f(this.at("focal"), look.flat ? 0 : look.focal() * ratio);
    gl.uniform3f(this.at("flatPlace"), ...look.middle(w, h), look.scale(w, h) * ratio);
    gl.uniform2f(this.at("size"), w, h);
    gl.uniform1i(this.at("wraps"), wraps);
    gl.uniform1i(this.at("hasColor"), this.hasColor);
    gl.uniform1i(this.at("hasOverlay"), this.hasOverlay);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}
