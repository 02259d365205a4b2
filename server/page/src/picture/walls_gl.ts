// Walls as quads of their true thickness with round ends, one instance per element. The edge is smoothed by the
// distance to the middle line, so no multisampling is needed.
import type { Camera } from "./camera";
import { colourTable, kShades, rigidColour } from "./colours";
import { kRigid, kSegmentFloats, type Segments } from "./segments";
import { kThinnest, type Walls } from "./walls";

const kVertex = `#version 300 es
in vec4 ends; in vec2 wall;
uniform vec2 centre; uniform vec2 size; uniform float scale; uniform float thinnest;
out vec2 place; flat out float span; flat out float radius; flat out float share;
void main() {
  vec2 a = (ends.xy - centre) * scale, b = (ends.zw - centre) * scale;
  vec2 along = b - a; span = length(along);
  along = span > 1e-6 ? along / span : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  radius = 0.5 * max(wall.x * scale, thinnest); share = wall.y;
  float edge = radius + 1.0;
  place = vec2((gl_VertexID & 1) == 0 ? -edge : span + edge, (gl_VertexID & 2) == 0 ? -edge : edge);
  gl_Position = vec4((a + along * place.x + across * place.y) / (0.5 * size), 0.0, 1.0);
}`;

const kFragment = `#version 300 es
precision highp float;
in vec2 place; flat in float span; flat in float radius; flat in float share;
uniform sampler2D colours; uniform vec3 rigid; out vec4 colour;
void main() {
  float beyond = max(max(-place.x, place.x - span), 0.0);
  // An end is half a pixel smaller, or the soft edges of two elements would add up to a knot.
  float edge = beyond > 0.0 ? radius : radius + 0.5;
  float cover = clamp(edge - length(vec2(beyond, place.y)), 0.0, 1.0);
  if (cover <= 0.0) discard;
  vec4 bare = texture(colours, vec2((clamp(share, 0.0, 1.0) * ${kShades - 1}.0 + 0.5) / ${kShades}.0, 0.5));
  colour = (share == ${kRigid}.0 ? vec4(rigid, 1.0) : bare) * cover;
}`;

function compile(gl: WebGL2RenderingContext, type: number, text: string): WebGLShader {
  const shader = gl.createShader(type)!;
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  return shader;
}

export class GlWalls implements Walls {
  private program!: WebGLProgram;
  private buffer!: WebGLBuffer;
  private segments: Segments | undefined;
  private dark = false;
  private isStale = true;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly gl: WebGL2RenderingContext) {
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => this.build());
    this.build();
  }

  private build(): void {
    const { gl } = this;
    this.program = gl.createProgram()!;
    gl.attachShader(this.program, compile(gl, gl.VERTEX_SHADER, kVertex));
    gl.attachShader(this.program, compile(gl, gl.FRAGMENT_SHADER, kFragment));
    gl.linkProgram(this.program);
    gl.useProgram(this.program);
    this.buffer = gl.createBuffer()!;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    const stride = 4 * kSegmentFloats;
    const attributes: [string, number, number][] = [["ends", 4, 0], ["wall", 2, 16]];
    for (const [name, size, offset] of attributes) {
      const place = gl.getAttribLocation(this.program, name);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, size, gl.FLOAT, false, stride, offset);
      gl.vertexAttribDivisor(place, 1);
    }
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    for (const parameter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
      gl.texParameteri(gl.TEXTURE_2D, parameter, gl.LINEAR);
    }
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.setDark(this.dark);
    this.isStale = true;
  }

  setDark(dark: boolean): void {
    const { gl } = this;
    this.dark = dark;
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, kShades, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, colourTable(dark));
  }

  setSegments(segments: Segments): void {
    this.segments = segments;
    this.isStale = true;
  }

  draw(camera: Camera, ratio: number): void {
    const { gl, program, segments } = this;
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    if (!segments) return;
    if (this.isStale) gl.bufferData(gl.ARRAY_BUFFER, segments.values, gl.DYNAMIC_DRAW);
    this.isStale = false;
    const uniform = (name: string): WebGLUniformLocation | null => gl.getUniformLocation(program, name);
    gl.uniform2f(uniform("centre"), camera.x, camera.y);
    gl.uniform2f(uniform("size"), this.canvas.width, this.canvas.height);
    gl.uniform1f(uniform("scale"), camera.scale * ratio);
    gl.uniform1f(uniform("thinnest"), kThinnest * ratio);
    gl.uniform3fv(uniform("rigid"), rigidColour(this.dark).map((value) => value / 255));
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, segments.count);
  }

  destroy(): void {
    this.gl.getExtension("WEBGL_lose_context")?.loseContext();
  }
}
