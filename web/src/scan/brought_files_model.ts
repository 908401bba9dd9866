// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which of the files that a person brings are the scan: the slices of a DICOM series, whatever they are
// called, or else one volume. Zip files are unpacked here, so that the host never reads one.
import type { BroughtFile } from "./new_case_client";

/** A file that may be part of the scan, not read yet. */
export interface Candidate {
  readonly name: string;
  readonly bytes: number;
  read(): Promise<Blob>;
}

export interface Brought {
  readonly files: AsyncIterable<BroughtFile>;
  readonly bytes: number;
  readonly count: number;
}

/** As the host has it. */
export const MOST_FILES = 5000;
export const MOST_BYTES = 2 ** 31;

const VOLUMES = ["nii.gz", "nii", "nrrd", "mha"] as const;
const DICOM_AT = 128;

/** "nii.gz" of a volume's name; undefined of others. */
export function volumeKind(name: string): string | undefined {
  const lower = name.toLowerCase();
  return VOLUMES.find((kind) => lower.endsWith(`.${kind}`));
}

/** What the system or an archive put beside a scan. */
export function isBeside(path: string): boolean {
  const name = path.split("/").at(-1) ?? "";
  return (
    name === "" ||
    name.startsWith(".") ||
    path.includes("__MACOSX/") ||
    name.toUpperCase() === "DICOMDIR" ||
    /\.(txt|json|xml|pdf|html?|jpe?g|png|exe|inf|csv|stl|ply)$/i.test(name)
  );
}

export async function isDicom(content: Blob): Promise<boolean> {
  return (await content.slice(DICOM_AT, DICOM_AT + 4).text()) === "DICM";
}

async function* slicesOf(all: readonly Candidate[]): AsyncGenerator<BroughtFile> {
  let count = 0;
  for (const one of all) {
    const content = await one.read();
    if (!(await isDicom(content))) continue;
    count += 1;
    yield { as: "dcm", content };
  }
  if (count === 0) {
    throw new Error(
      "None of this is a CT that is read here: DICOM slices, or a NIfTI, NRRD or MetaImage volume.",
    );
  }
}

async function* volumeOf(one: Candidate, as: string): AsyncGenerator<BroughtFile> {
  yield { as, content: await one.read() };
}

/** @throws Error  where it is no scan, or more than is taken */
export function scanAmong(all: readonly Candidate[]): Brought {
  const candidates = all.filter(({ name }) => !isBeside(name));
  const slices = candidates.filter(({ name }) => volumeKind(name) === undefined);
  const volumes = candidates.filter(({ name }) => volumeKind(name) !== undefined);
  const [volume] = volumes;
  if (slices.length === 0 && volume === undefined) throw new Error("There is no scan in it.");
  if (slices.length === 0 && volumes.length > 1) {
    throw new Error("There are several volumes in it; bring the one that is the CT.");
  }
  const taken = slices.length > 0 ? slices : volumes;
  const bytes = taken.reduce((sum, one) => sum + one.bytes, 0);
  if (taken.length > MOST_FILES || bytes > MOST_BYTES) {
    throw new Error(`At most ${MOST_FILES} files and 2 GB are taken at once.`);
  }
  const files =
    slices.length > 0 || volume === undefined
      ? slicesOf(slices)
      : volumeOf(volume, volumeKind(volume.name) ?? "nii");
  return { files, bytes, count: taken.length };
}
