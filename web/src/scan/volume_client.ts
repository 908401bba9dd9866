// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The parts of a case's scan from the host, unpacked here.
import { parseNifti, type Volume } from "./nifti_model";
import { parseScannedCase, withTrust, type ScannedCase } from "./scan_case_model";

/** A packed volume that unpacks to more is none of ours: 2^30 voxels of two bytes. */
const MOST_BYTES = 2 ** 31 + 2 ** 20;

export function scanAddress(id: string, file: string): string {
  return `/api/cases/${encodeURIComponent(id)}/scan/${file}`;
}

async function get(id: string, file: string, signal: AbortSignal): Promise<Response> {
  let answer: Response;
  try {
    answer = await fetch(scanAddress(id, file), { signal });
  } catch (error) {
    if (signal.aborted) throw error;
    throw new Error("The host does not answer. Is `carpus serve` running?");
  }
  // The host says why, for people.
  if (!answer.ok) throw new Error((await answer.text()).trim());
  return answer;
}

export async function fetchScannedCase(id: string, signal: AbortSignal): Promise<ScannedCase> {
  const scanned = parseScannedCase(await (await get(id, "case.json", signal)).text());
  // A case of an older program does not tell how sure its bones are.
  const trust = await fetch(scanAddress(id, "trust.json"), { signal });
  return trust.ok ? withTrust(scanned, await trust.text()) : scanned;
}

/** @param told  how much of the packed file has come, 0 to 1 */
export async function fetchVolume(
  id: string,
  file: string,
  signal: AbortSignal,
  told: (part: number) => void = () => undefined,
): Promise<Volume> {
  const answer = await get(id, file, signal);
  if (answer.body === null) throw new Error(`The host sent no ${file}.`);
  const whole = Number(answer.headers.get("Content-Length") ?? 0);
  let come = 0;
  const counted = new TransformStream<Uint8Array<ArrayBuffer>, Uint8Array<ArrayBuffer>>({
    transform(piece, controller) {
      come += piece.byteLength;
      if (whole > 0) told(Math.min(1, come / whole));
      controller.enqueue(piece);
    },
  });
  const unpacked = answer.body.pipeThrough(counted).pipeThrough(new DecompressionStream("gzip"));
  return parseNifti(await joined(unpacked));
}

async function joined(stream: ReadableStream<Uint8Array<ArrayBuffer>>): Promise<ArrayBuffer> {
  const pieces: Uint8Array[] = [];
  let length = 0;
  const reader = stream.getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    length += value.byteLength;
    if (length > MOST_BYTES) {
      await reader.cancel();
      throw new Error("The volume is too large to be shown.");
    }
    pieces.push(value);
  }
  const all = new Uint8Array(length);
  let at = 0;
  for (const piece of pieces) {
    all.set(piece, at);
    at += piece.byteLength;
  }
  return all.buffer;
}
