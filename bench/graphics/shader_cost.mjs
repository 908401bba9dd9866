// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// WebGL's shaders brought to a compiler of graphics hardware that need not be there: glslang makes SPIR-V of them, Mesa's
// RADV machine code.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

/** Whose code is compiled: the graphics of AMD's Ryzen 4000 (GFX9, "Vega"). */
const FAMILY = "RENOIR";

/**
 * As if each place had all that the shader can draw: a loop of one turn or none is taken, and as many lesions as given lie everywhere.
 * A compiler that knows no count of turns guesses one.
 */
export function withAll(source, lesions) {
  const loops = source.replace(/for \(int i = ifAny\([^;]*\); i > 0; --i\)/g, "for (int i = 1; i > 0; --i)");
  const all = loops.replace(/^uniform int lesionCount;/m, `const int lesionCount = ${lesions};`);
  const missed = /^.*(= ifAny|uniform int ).*$/m.exec(all);
  if (missed !== null) throw new Error(`turns that nothing here knows, the compiler would guess them: ${missed[0].trim()}`);
  return all;
}

function driverFile() {
  const folder = "/usr/share/vulkan/icd.d";
  let files = [];
  try {
    files = readdirSync(folder);
  } catch {
    // told below
  }
  const file = files.find((one) => one.startsWith("radeon_icd"));
  if (file === undefined) throw new Error("Mesa's Vulkan driver is missing: tools/install graphics");
  return join(folder, file);
}

/** @param program  path of carpus-shader-cost @returns cost(vertex, fragment): { device, stages } */
export function costOf(program) {
  const driver = process.env.VK_ICD_FILENAMES ?? driverFile();
  return (vertex, fragment) => {
    const folder = mkdtempSync(join(tmpdir(), "carpus-shaders-"));
    try {
      for (const [name, source] of [["vert", vertex], ["frag", fragment]])
        writeFileSync(join(folder, `shader.${name}`), source.replace("#version 300 es", "#version 310 es"));
      execFileSync(
        "glslangValidator",
        // Uniforms outside of blocks as WebGL has them, what goes from stage to stage matched by name.
        ["-V", "-R", "--auto-map-bindings", "--auto-map-locations", "-l", "shader.vert", "shader.frag"],
        { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] },
      );
      const told = execFileSync(program, [join(folder, "vert.spv"), join(folder, "frag.spv")], {
        encoding: "utf8",
        env: { ...process.env, RADV_FORCE_FAMILY: FAMILY, VK_ICD_FILENAMES: driver },
      });
      return JSON.parse(told);
    } catch (error) {
      throw new Error(`a shader was not compiled: ${error.stdout ?? ""}${error.stderr ?? ""}${error.message}`);
    } finally {
      rmSync(folder, { recursive: true, force: true });
    }
  };
}
