// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether this machine draws by its processor, asked once of WebGL: by the name that its renderer gives itself.
let known: boolean | undefined;

/** Whether WebGL runs on the processor: then all is drawn simpler, from the start. */
export function drawsInSoftware(): boolean {
  known ??= askWhetherInSoftware();
  return known;
}

function askWhetherInSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const names = gl?.getExtension("WEBGL_debug_renderer_info");
  if (gl === null || names === null || names === undefined) return false;
  const name = String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}
