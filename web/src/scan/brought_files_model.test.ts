// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import {
  isBeside,
  MOST_BYTES,
  MOST_FILES,
  scanAmong,
  volumeKind,
  type Brought,
  type Candidate,
} from "./brought_files_model";

const DICOM = new Blob([new Uint8Array(128), "DICM", "the rest"]);

function file(name: string, content: Blob = DICOM, bytes = content.size): Candidate {
  return { name, bytes, read: () => Promise.resolve(content) };
}

async function kindsOf(brought: Brought): Promise<string[]> {
  const kinds: string[] = [];
  for await (const { as } of brought.files) kinds.push(as);
  return kinds;
}

describe("what a person brings", () => {
  it("is the slices, whatever they are called, and nothing that lies beside them", async () => {
    const brought = scanAmong([
      file("disc/DICOMDIR"),
      file("disc/IMG/IM0001"),
      file("disc/IMG/DOE^JANE.dcm"),
      file("disc/viewer.exe"),
      file("__MACOSX/disc/._IM0001"),
      file("disc/.DS_Store"),
      file("disc/IMG/notes", new Blob(["no slice"])),
    ]);
    expect(brought.count).toBe(3);
    // What is no DICOM is seen when it is read, and stays here; no name goes to the host.
    expect(await kindsOf(brought)).toEqual(["dcm", "dcm"]);
  });

  it("is one volume where there are no slices", async () => {
    const brought = scanAmong([file("a/Wrist.NII.GZ"), file("a/readme.txt")]);
    expect(await kindsOf(brought)).toEqual(["nii.gz"]);
    expect(volumeKind("x.nrrd")).toBe("nrrd");
    expect(volumeKind("x.dcm")).toBeUndefined();
  });

  it("is refused in words where it is no scan, or two", async () => {
    expect(() => scanAmong([])).toThrow("There is no scan in it.");
    expect(() => scanAmong([file("a.pdf"), file("b.jpg")])).toThrow("no scan");
    expect(() => scanAmong([file("a.nii"), file("b.mha")])).toThrow("several volumes");
    await expect(kindsOf(scanAmong([file("letter", new Blob(["Dear"]))]))).rejects.toThrow(
      "None of this is a CT",
    );
  });

  it("is refused before anything is read where the host would refuse it", () => {
    const many = Array.from({ length: MOST_FILES + 1 }, (_, i) => file(`IM${i}`));
    expect(() => scanAmong(many)).toThrow(`At most ${MOST_FILES} files`);
    expect(scanAmong(many.slice(1)).count).toBe(MOST_FILES);
    expect(() => scanAmong([file("a.nii", DICOM, MOST_BYTES + 1)])).toThrow("2 GB");
    expect(scanAmong([file("a.nii", DICOM, MOST_BYTES)]).bytes).toBe(MOST_BYTES);
  });

  it("knows what is put beside scans by its name alone", () => {
    for (const name of ["a/", ".x", "x/dicomdir", "a/REPORT.PDF", "autorun.inf", "__MACOSX/a"]) {
      expect(isBeside(name), name).toBe(true);
    }
    for (const name of ["IM0001", "a.b/c", "1.2.840.113", "x.dcm", "x.ima"]) {
      expect(isBeside(name), name).toBe(false);
    }
  });
});
