// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the host made of painted bones, checked; and labels that it changed laid into those of the page.
export interface MendedBone {
  /** "scaphoid_proximal" */
  readonly name: string;
  readonly label: number;
  /** 0 where it has no voxels any more */
  readonly volumeMm3: number;
}

type Json = Readonly<Record<string, unknown>>;

/** @throws Error  where it is no mended.json */
export function parseMended(text: string): readonly MendedBone[] {
  const json = JSON.parse(text) as Json;
  const bones: unknown = json["bones"];
  if (json["format"] !== "carpus mended bones" || !Array.isArray(bones)) {
    throw new Error("The host sent no mended bones.");
  }
  return bones.map((each): MendedBone => {
    const { name, label, volume_mm3: volumeMm3 } = each as Json;
    if (typeof name !== "string" || typeof label !== "number" || typeof volumeMm3 !== "number") {
      throw new Error("The host sent a bone without a name, a label or a volume.");
    }
    return { name, label, volumeMm3 };
  });
}

/**
 * Where the host changed a label and the page has not since.
 * @return the indices, and what they are to hold
 */
export function changesToTake(
  sent: Uint8Array,
  grown: Uint8Array,
  now: Uint8Array,
): { readonly indices: Uint32Array; readonly labels: Uint8Array } {
  if (sent.length !== grown.length || sent.length !== now.length) {
    throw new Error("The host sent labels of another size.");
  }
  const indices: number[] = [];
  for (let i = 0; i < sent.length; ++i) {
    if (sent[i] !== grown[i] && now[i] === sent[i]) indices.push(i);
  }
  return {
    indices: Uint32Array.from(indices),
    labels: Uint8Array.from(indices, (i) => grown[i] ?? 0),
  };
}
