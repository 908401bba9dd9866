// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Files, folders and zip files as a person drops or chooses them, each as what it holds.
import type { Candidate } from "./brought_files_model";

/** More entries than this are no scan. */
const MOST_ENTRIES = 20_000;

function ofFile(file: File, path: string): Candidate {
  return { name: path, bytes: file.size, read: () => Promise.resolve(file) };
}

function cannotUnpack(file: File, error: unknown): Error {
  const why = error instanceof Error ? error.message : String(error);
  return new Error(`${file.name} cannot be unpacked: ${why}.`);
}

async function unpacked(file: File): Promise<Candidate[]> {
  const { BlobReader, BlobWriter, ZipReader, configure } = await import("@zip.js/zip.js");
  configure({ useWebWorkers: false });
  const reader = new ZipReader(new BlobReader(file));
  const found: Candidate[] = [];
  try {
    for await (const entry of reader.getEntriesGenerator()) {
      if (found.length >= MOST_ENTRIES) throw new Error("too many files");
      if (entry.directory) continue;
      if (entry.encrypted) throw new Error("it is enciphered; unpack it first");
      found.push({
        name: entry.filename,
        bytes: entry.uncompressedSize,
        // The library ends where more comes out than the archive says.
        read: () =>
          entry.getData(new BlobWriter(), { checkSignature: true }).catch((error: unknown) => {
            throw cannotUnpack(file, error);
          }),
      });
    }
  } catch (error) {
    throw cannotUnpack(file, error);
  }
  return found;
}

async function candidatesOf(file: File, path: string): Promise<Candidate[]> {
  return /\.zip$/i.test(file.name) ? unpacked(file) : [ofFile(file, path)];
}

export async function fromFiles(files: readonly File[]): Promise<Candidate[]> {
  const found = await Promise.all(
    files.map((file) =>
      candidatesOf(file, file.webkitRelativePath === "" ? file.name : file.webkitRelativePath),
    ),
  );
  return found.flat();
}

function fileOf(entry: FileSystemFileEntry): Promise<File> {
  return new Promise((done, fail) => {
    entry.file(done, fail);
  });
}

async function entriesIn(folder: FileSystemDirectoryEntry): Promise<FileSystemEntry[]> {
  const reader = folder.createReader();
  const all: FileSystemEntry[] = [];
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((done, fail) => {
      reader.readEntries(done, fail);
    });
    if (some.length === 0) return all;
    all.push(...some);
    if (all.length > MOST_ENTRIES) throw new Error("There are too many files in the folder.");
  }
}

async function fromEntry(entry: FileSystemEntry): Promise<Candidate[]> {
  if (entry.isFile) {
    return candidatesOf(await fileOf(entry as FileSystemFileEntry), entry.fullPath);
  }
  const found: Candidate[] = [];
  for (const inside of await entriesIn(entry as FileSystemDirectoryEntry)) {
    found.push(...(await fromEntry(inside)));
  }
  return found;
}

/** Called while the drop is handled: afterwards the browser has forgotten what was dropped. */
export async function fromDrop(drop: DataTransfer): Promise<Candidate[]> {
  const entries = [...drop.items].map((item) => item.webkitGetAsEntry());
  const files = [...drop.files];
  if (entries.every((entry) => entry === null)) return fromFiles(files);
  const found: Candidate[] = [];
  for (const entry of entries) if (entry !== null) found.push(...(await fromEntry(entry)));
  return found;
}
