// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Labels as they go to the host and come back: NIfTI, gzip.
import { niftiOf, parseNifti, type Volume } from "./nifti_model";

export function packedLabels(labels: Volume): Promise<Blob> {
  const packed = new Blob([niftiOf(labels)]).stream().pipeThrough(new CompressionStream("gzip"));
  return new Response(packed).blob();
}

/** @throws Error  where they are none */
export async function unpackedLabels(packed: Blob): Promise<Uint8Array> {
  const stream = packed.stream().pipeThrough(new DecompressionStream("gzip"));
  const { values } = parseNifti(await new Response(stream).arrayBuffer());
  if (!(values instanceof Uint8Array)) throw new Error("The host sent no labels.");
  return values;
}
