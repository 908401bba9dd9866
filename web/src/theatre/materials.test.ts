// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is put into three.js' shaders finds its place there: a replacement that finds none says nothing.
import * as THREE from "three";
import { describe, expect, it } from "vitest";
import { boneMaterial, glassBoneMaterial, tunnelMaterial, withTracks } from "./materials";
import { makeTrackUniforms, setTrackUniforms, type TrackUniforms } from "./track_shader";
import { MAX_TRACKS } from "./tunnel_model";

interface Compiled {
  readonly vertex: string;
  readonly fragment: string;
  readonly uniforms: Readonly<Record<string, THREE.IUniform>>;
}

function compiled(material: THREE.Material): Compiled {
  const source = material instanceof THREE.ShaderMaterial ? material : THREE.ShaderLib.standard;
  const shader = {
    vertexShader: source.vertexShader,
    fragmentShader: source.fragmentShader,
    uniforms: { ...source.uniforms },
  };
  material.onBeforeCompile(
    shader as THREE.WebGLProgramParametersWithUniforms,
    undefined as unknown as THREE.WebGLRenderer,
  );
  return {
    vertex: shader.vertexShader,
    fragment: shader.fragmentShader,
    uniforms: shader.uniforms,
  };
}

function times(text: string, part: string): number {
  return text.split(part).length - 1;
}

describe("bone", () => {
  it("has grain in colour and gloss, in its own mm", () => {
    const { fragment, vertex } = compiled(boneMaterial());
    expect(vertex).toContain("vBoneMm = position;");
    expect(fragment).toContain("diffuseColor.rgb *= mix(vec3(0.90");
    expect(fragment).toContain("roughnessFactor = clamp(");
    expect(fragment).not.toContain("discard;");
  });
});

describe("drilled bone", () => {
  const tracks = makeTrackUniforms();

  it.each([
    ["matt", boneMaterial()],
    ["glass", glassBoneMaterial()],
  ])("of %s leaves out what lies within a track, asked once", (_, material) => {
    withTracks(material, tracks);
    const { fragment, uniforms, vertex } = compiled(material);
    expect(vertex).toContain("varying vec3 vBoneMm;");
    expect(times(fragment, "float outsideTracks(vec3 p)")).toBe(1);
    expect(times(fragment, "varying vec3 vBoneMm;")).toBe(1);
    expect(times(fragment, "if (boneAway < -0.5 * bonePixel) discard;")).toBe(1);
    expect(fragment.indexOf("outsideTracks(vec3 p)")).toBeLessThan(fragment.indexOf("void main()"));
    expect(uniforms["trackStart"]).toBe(tracks.trackStart);
  });

  it("shows the fresh cut at the rim of matt bone", () => {
    const material = boneMaterial();
    withTracks(material, tracks);
    expect(compiled(material).fragment).toContain("outgoingLight *= mix(");
  });

  it("has a wall that is gone within other tracks and coloured by its depth", () => {
    const { fragment, vertex } = compiled(tunnelMaterial(tracks));
    expect(vertex).toContain("vDepths = depths;");
    expect(fragment).toContain("if (outsideTracks(vBoneMm) < -0.020) discard;");
    expect(fragment).toContain("diffuseColor.rgb = mix(cortex, spongy, within)");
  });
});

describe("track uniforms", () => {
  const many = (count: number): TrackUniforms => {
    const uniforms = makeTrackUniforms();
    const track = {
      body: "scaphoid",
      from_mm: [1, 2, 3],
      to_mm: [4, 5, 6],
      from_radius_mm: 0.5,
      to_radius_mm: 0.7,
    } as const;
    setTrackUniforms(
      uniforms,
      Array.from({ length: count }, () => track),
    );
    return uniforms;
  };

  it("carry ends and radii", () => {
    const { trackCount, trackEnd, trackStart } = many(2);
    expect(trackCount.value).toBe(2);
    expect(trackStart.value[1]?.toArray()).toEqual([1, 2, 3, 0.5]);
    expect(trackEnd.value[1]?.toArray()).toEqual([4, 5, 6, 0.7]);
  });

  it("hold at most as many as the shader's array", () => {
    const { trackCount, trackStart } = many(MAX_TRACKS + 3);
    expect(trackCount.value).toBe(MAX_TRACKS);
    expect(trackStart.value.length).toBe(MAX_TRACKS);
  });
});
