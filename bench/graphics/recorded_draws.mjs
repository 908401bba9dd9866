// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What one picture of the scope asks of graphics hardware: each of its draw calls with its shaders, its uniforms and the
// pixels that pass its depth test, counted by drawing it a second time into a picture that adds up.

/** Runs in the page, before anything of it. Then `window.drawsOf(sidePx)` promises the draws of the next picture. */
export function recordDraws() {
  const gl2 = WebGL2RenderingContext.prototype;
  const own = Object.fromEntries(
    ["drawElements", "drawArrays", "drawElementsInstanced", "drawArraysInstanced"].map((name) => [name, gl2[name]]),
  );
  // The page draws otherwise where a processor does it, as here.
  const { getParameter } = gl2;
  gl2.getParameter = function (name) {
    const isRenderer = name === this.getExtension("WEBGL_debug_renderer_info")?.UNMASKED_RENDERER_WEBGL;
    return isRenderer ? "graphics hardware, so the page is told" : getParameter.call(this, name);
  };
  let wanted = null; // { sidePx, draws, resolve }
  const counters = new Map(); // by program

  const setUniform = (gl, at, type, value) => {
    const set = {
      [gl.FLOAT]: () => gl.uniform1f(at, value),
      [gl.FLOAT_VEC2]: () => gl.uniform2fv(at, value),
      [gl.FLOAT_VEC3]: () => gl.uniform3fv(at, value),
      [gl.FLOAT_VEC4]: () => gl.uniform4fv(at, value),
      [gl.FLOAT_MAT3]: () => gl.uniformMatrix3fv(at, false, value),
      [gl.FLOAT_MAT4]: () => gl.uniformMatrix4fv(at, false, value),
      [gl.INT]: () => gl.uniform1i(at, value),
      [gl.BOOL]: () => gl.uniform1i(at, value ? 1 : 0),
    }[type];
    if (set === undefined) throw new Error(`no way to copy a uniform of type ${type}`);
    set();
  };

  /** The same shaders, what they discard too, but each pixel is a 255th. */
  const counterOf = (gl, program, { vertex, fragment }) => {
    if (counters.has(program)) return counters.get(program);
    const counter = gl.createProgram();
    const counting = fragment.replace(/void main\(\s*\)/, "void drawn()") + "\nvoid main() { drawn(); pc_fragColor = vec4(1.0 / 255.0); }\n";
    for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, counting]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(counter, shader);
    }
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_ATTRIBUTES); ++i) {
      const { name } = gl.getActiveAttrib(program, i);
      const at = gl.getAttribLocation(program, name);
      if (at >= 0) gl.bindAttribLocation(counter, at, name);
    }
    gl.linkProgram(counter);
    if (!gl.getProgramParameter(counter, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(counter));
    counters.set(program, counter);
    return counter;
  };

  /** Adds up, in a size of its own, and has its own depth. */
  const targetOf = (gl, sidePx) => {
    const into = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, into);
    for (const [format, attachment] of [[gl.RGBA8, gl.COLOR_ATTACHMENT0], [gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]]) {
      const buffer = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
      gl.renderbufferStorage(gl.RENDERBUFFER, format, sidePx, sidePx);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, buffer);
    }
    gl.bindRenderbuffer(gl.RENDERBUFFER, null);
    return into;
  };

  const shadersOf = (gl, program) => {
    const all = gl.getAttachedShaders(program);
    const source = (type) => gl.getShaderSource(all.find((one) => gl.getShaderParameter(one, gl.SHADER_TYPE) === type));
    return { vertex: source(gl.VERTEX_SHADER), fragment: source(gl.FRAGMENT_SHADER) };
  };

  const countPixels = (gl, kind, call, program, shaders) => {
    const kept = {
      frame: gl.getParameter(gl.DRAW_FRAMEBUFFER_BINDING),
      read: gl.getParameter(gl.READ_FRAMEBUFFER_BINDING),
      viewport: gl.getParameter(gl.VIEWPORT),
      blends: gl.isEnabled(gl.BLEND),
      blend: [gl.BLEND_SRC_RGB, gl.BLEND_DST_RGB, gl.BLEND_SRC_ALPHA, gl.BLEND_DST_ALPHA].map((one) => gl.getParameter(one)),
      clear: gl.getParameter(gl.COLOR_CLEAR_VALUE),
      mask: gl.getParameter(gl.COLOR_WRITEMASK),
    };
    const { sidePx } = wanted;
    const isFirst = wanted.into === undefined;
    wanted.into ??= targetOf(gl, sidePx);
    gl.bindFramebuffer(gl.FRAMEBUFFER, wanted.into);
    gl.viewport(0, 0, sidePx, sidePx);
    gl.colorMask(true, true, true, true);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | (isFirst ? gl.DEPTH_BUFFER_BIT : 0));
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    const counter = counterOf(gl, program, shaders);
    const values = [];
    for (let i = 0; i < gl.getProgramParameter(counter, gl.ACTIVE_UNIFORMS); ++i) {
      const { name, type, size } = gl.getActiveUniform(counter, i);
      for (let k = 0; k < size; ++k) {
        const element = size === 1 ? name : name.replace("[0]", `[${k}]`);
        values.push([element, type, gl.getUniform(program, gl.getUniformLocation(program, element))]);
      }
    }
    gl.useProgram(counter);
    for (const [name, type, value] of values) setUniform(gl, gl.getUniformLocation(counter, name), type, value);
    own[kind].apply(gl, call);
    const sums = new Uint8Array(4 * sidePx * sidePx);
    gl.readPixels(0, 0, sidePx, sidePx, gl.RGBA, gl.UNSIGNED_BYTE, sums);
    let pixels = 0;
    for (let i = 0; i < sums.length; i += 4) pixels += sums[i];
    gl.useProgram(program);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, kept.frame);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, kept.read);
    gl.viewport(...kept.viewport);
    if (!kept.blends) gl.disable(gl.BLEND);
    gl.blendFuncSeparate(...kept.blend);
    gl.clearColor(...kept.clear);
    gl.colorMask(...kept.mask);
    return pixels;
  };

  const record = (gl, kind, call) => {
    const program = gl.getParameter(gl.CURRENT_PROGRAM);
    const shaders = shadersOf(gl, program);
    const { fragment } = shaders;
    const [, , wide] = gl.getParameter(gl.VIEWPORT);
    const isScene = gl.isEnabled(gl.DEPTH_TEST); // what covers the picture with one triangle asks for no depth
    const isIndexed = kind.startsWith("drawElements");
    wanted.draws.push({
      name: /#define SHADER_NAME (.+)/.exec(fragment)?.[1] ?? "?",
      vertices: (isIndexed ? call[1] : call[2]) * (kind.endsWith("Instanced") ? call[isIndexed ? 4 : 3] : 1),
      widePx: wide,
      pixels: isScene ? countPixels(gl, kind, call, program, shaders) : null,
      ...shaders,
    });
    if (gl.getParameter(gl.DRAW_FRAMEBUFFER_BINDING) !== null) return; // more of this picture comes
    const { draws, resolve } = wanted;
    wanted = null;
    resolve(draws);
  };

  for (const kind of Object.keys(own)) {
    gl2[kind] = function (...call) {
      if (wanted !== null && this.canvas.className === "scope-picture") {
        // A picture begins with what has depth.
        if (wanted.draws.length > 0 || this.isEnabled(this.DEPTH_TEST)) record(this, kind, call);
      }
      return own[kind].apply(this, call);
    };
  }
  window.drawsOf = (sidePx) => new Promise((resolve) => (wanted = { sidePx, draws: [], resolve }));
}
